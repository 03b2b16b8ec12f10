// The page: rooms, the text and where it is kept, the scheme redrawn while one types.
import { D, W, byId, call, compute, current, download, empty, enter, faultText, fileList, first, forget, forgets, framed, latest, linked, long, made, note,
  picture, say, tabs } from "./api.js";
import { ask, handIn, judge } from "./answers.js";
import { bank, start } from "./bank.js";
import { drawing } from "./draw.js";
import { editor } from "./editor.js";
import { unshared } from "./edits.js";
import * as group from "./group.js";
import * as sheets from "./sheets.js";
import { splitting } from "./split.js";
import { starting } from "./transport.js";

const PAUSE = 250, REST = 900;  // ms without a letter: the scheme; what moves
const HOME = "planmethod.text";
const kept = JSON.parse(localStorage.getItem(HOME) || "null") || { name: "problem", text: "", variant: "", file: "", mark: "" };
kept.task ??= kept.name;  // under which it was taken, whatever its file is called since
if (!D.files.includes(kept.file)) kept.file = kept.mark = "";  // of another folder, by another studio at this address
const problem = () => ({ name: kept.name, text: kept.text, variant: kept.variant, file: kept.file, layout: layout(), colour: byId("colour").checked, task: kept.task });
let view = "scheme", stale = new Set();

function keep() {
  try { localStorage.setItem(HOME, JSON.stringify(kept)); } catch (error) { note(String(error)); }
}

// Rooms -------------------------------------------------------------------------------------------

document.documentElement.dataset.theme = localStorage.getItem("planmethod.theme") || "";
if (!document.documentElement.dataset.theme) delete document.documentElement.dataset.theme;
byId("theme").addEventListener("click", () => {
  const dark = document.documentElement.dataset.theme ? document.documentElement.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
  document.documentElement.dataset.theme = dark ? "light" : "dark";
  localStorage.setItem("planmethod.theme", document.documentElement.dataset.theme);
});
for (const lang of D.langs) made(byId("lang"), "option", lang === "ru" ? "Русский" : "English", { value: lang });
byId("lang").value = D.lang;
byId("lang").addEventListener("change", event => { location.assign(D.pages?.[event.target.value] ?? `?lang=${event.target.value}`); });

const room = tabs(byId("rooms"), name => {
  if (name === "group") byId("works-of").textContent = say("works_of", { title: kept.name });
  byId("go-on").hidden = !kept.text.trim();
  byId("gone-on").textContent = kept.name;
});
const INNER = ["tables", "protocol", "structure", "assemblies", "files"];
let inner = INNER[0];  // the one that was looked at last
const outer = tabs(byId("views"), name => {
  if (name === "more") { within(inner); return; }
  for (const one of INNER) byId(one).hidden = true;
  view = name;
  refresh();
});
const within = tabs(byId("more-views"), name => {
  inner = view = name;
  if (byId("more").hidden) outer("more"); else refresh();
});
const turnTo = name => (INNER.includes(name) ? within : outer)(name);

const ABSENT = { live: ["to-motion"], structure: ["to-structure"], assemblies: ["to-assemblies", "to-drawing"], questions: ["to-answers"] };
function hide(lacks) {  // what this kind of problem does not have
  for (const [what, tabs] of Object.entries(ABSENT)) for (const tab of tabs) byId(tab).hidden = lacks.includes(what);
  for (const what of ["project", "form"]) byId("makes").querySelector(`[data-what=${what}]`).hidden = lacks.includes(what);
  if (byId(`to-${view}`).hidden) turnTo("scheme");
}

for (const button of document.querySelectorAll("[data-start]")) {
  button.addEventListener("click", () => {
    if (button.dataset.start === "draw") { byId("new-drawing").click(); return; }
    room("task");
    const head = byId(button.dataset.start);
    head.scrollIntoView({ block: "start" });
    head.tabIndex = -1;  // where one reads on, no control
    head.focus({ preventScroll: true });
    head.addEventListener("blur", () => head.removeAttribute("tabindex"), { once: true });
  });
}
byId("resume").addEventListener("click", () => room("work"));

// The text ----------------------------------------------------------------------------------------

const typed = editor(byId("editor"), kept.text, text => {
  kept.text = text;
  keep();
  unsaved();
  soon();
  board?.changed(text);
});
const board = drawing(typed, problem, found => { if (view === "drawing") show(found); });
forgets(board.forget);

/** @type {(name: string, text: string, more?: any) => void} */
function take(name, text, { file = "", mark = "", saved = null, task, variant = "", state } = {}) {  // another text; the one before can be had back
  const before = { ...kept, saved: savedText, state: typed.view.state }, plain = name.replace(/\.toml$/, "");
  Object.assign(kept, { name: plain, task: task ?? plain, variant, file, mark, text });
  savedText = saved;
  typed.open(text, state);
  keep();
  forget();
  byId("sketch").removeAttribute("src");
  byId("sketch").alt = "";
  byId("variant-of").hidden = true;
  byId("variant").replaceChildren();
  byId("name").value = kept.name;
  byId("save").hidden = !kept.file;
  group.open(kept.task);
  room("work");
  turnTo("scheme");
  unsaved();
  soon(0);
  if (before.text.trim() && before.text !== text) {
    note(say("replaced", { name: before.name }), { [W.back]: () => take(before.name, before.text, before) }, false);
  }
}

byId("name").value = kept.name;
byId("name").addEventListener("input", event => { kept.name = event.target.value.trim() || "problem"; keep(); });
byId("fetch").addEventListener("click", () => download(`${kept.name}.toml`, kept.text, "application/toml"));
byId("open").addEventListener("click", () => byId("opened").click());
byId("opened").addEventListener("change", async event => {
  const [file] = event.target.files;
  const isLast = latest(), text = file && await file.text();
  if (file && isLast()) take(file.name, text);
  event.target.value = "";
});
byId("variant").addEventListener("change", event => { kept.variant = event.target.value; keep(); forget(); soon(0); });

// A file of this machine: saved on demand, and what another editor does to it is told ---------------

let savedText = null;  // as the file has it
const unsaved = () => { byId("saved").textContent = kept.file ? kept.text === savedText ? W.saved : W.unsaved : W.kept; };

async function openFile(name) {
  const isLast = latest(), answer = await call(`api/file/${encodeURIComponent(name)}`);
  if (!answer.ok) { if (isLast()) note(await answer.text()); return; }
  const { text, mark } = await answer.json();
  if (!isLast()) return;
  if (kept.file === name && kept.text.trim() && kept.text !== text) {  // typed here, not saved yet
    savedText = text;
    byId("save").hidden = false;
    room("work");
    if (kept.mark === mark) { unsaved(); soon(0); } else conflict(name, text, mark);
    return;
  }
  take(name, text, { file: name, mark, saved: text });
}

function conflict(file, text, mark) {  // of the text that is here and that of a file: asked while it is here
  const isOf = current(), own = file === kept.file;
  const ask = act => () => { if (isOf()) act(); };
  note(own ? W.conflict : say("file_there", { file }), {
    [W.keep_mine]: ask(() => write(file, mark)),
    [W.take_theirs]: ask(() => take(file, text, { file, mark, saved: text })),
  });
}

function save() {
  const named = `${kept.name}.toml`, { file, mark } = kept;
  if (!file) return;
  if (named === file) { write(file, mark); return; }
  const isOf = current(), ask = act => () => { if (isOf()) act(); };
  note(say("other_name", { name: named, file }), {
    [say("save_to", { name: file })]: ask(() => write(file, mark)),
    ...(D.one ? {} : { [say("save_to", { name: named })]: ask(() => write(named, "")) }),
  });
}

async function write(file, mark) {  // if it is there as this mark says it was seen
  const isOf = current(), { text } = kept;
  const answer = await call(`api/file/${encodeURIComponent(file)}`, { method: "POST", body: JSON.stringify({ text, mark }) });
  const told = answer.headers.get("content-type")?.includes("json") ? await answer.json() : { said: await answer.text() };
  if (!isOf()) return;
  if (answer.ok) {
    Object.assign(kept, { file, mark: told.mark, name: file.replace(/\.toml$/, "") });
    byId("name").value = kept.name;
    savedText = text;
    keep();
    unsaved();
  } else if (told.mark) conflict(file, told.text, told.mark);
  else note(told.said);
}
byId("save").addEventListener("click", save);
addEventListener("keydown", event => {  // whatever letters its key has
  if ((event.ctrlKey || event.metaKey) && (event.code === "KeyS" || event.key === "s") && kept.file) { event.preventDefault(); save(); }
});
setInterval(async () => {
  if (!kept.file || document.hidden || !byId("note").hidden) return;
  const isOf = current(), { file } = kept;
  const answer = await call(`api/file/${encodeURIComponent(file)}?mark`).catch(() => null);
  if (!answer?.ok || (await answer.json()).mark === kept.mark) return;
  const { text, mark } = await (await call(`api/file/${encodeURIComponent(file)}`)).json();
  if (isOf() && mark !== kept.mark) conflict(file, text, mark);
}, 3000);

// The scheme --------------------------------------------------------------------------------------

let pause = 0, rest = 0, asking = null, again = false;
forgets(() => { asking = null; again = false; });  // what is asked yet comes too late

function soon(wait = PAUSE) {
  for (const name of ["motion", "sheets", "tables", "protocol", "structure", "assemblies"]) stale.add(name);
  byId("scheme").classList.add("old");
  clearTimeout(pause);
  clearTimeout(rest);
  if (view !== "drawing") pause = setTimeout(sketch, wait);  // the board asks by itself what is wrong with the text
  if (["motion", "tables", "structure", "protocol", "assemblies"].includes(view)) rest = setTimeout(refresh, REST);
}

async function sketch() {  // one at work at a time; where it waits yet, what was typed since takes its place
  if (asking && !asking.waits) { again = true; return; }
  byId("blank").hidden = Boolean(kept.text.trim());
  if (!kept.text.trim()) { show({ faults: [] }); byId("sketch").removeAttribute("src"); return; }
  const text = kept.text, began = performance.now(), own = asking = { waits: false };
  try {
    const found = await compute("sketched", problem(), { tries: 5, told: one => {
      own.waits = one.place > 0;
      if (own.waits && again) { again = false; sketch(); }
    } });
    if (asking !== own) return;
    again ||= found.superseded;
    if (found.refused) note(found.refused);
    byId("scheme").dataset.ms = Math.round(performance.now() - began);
    if (found.svg || (kept.text === text && !found.superseded)) show(found);
    if (found.svg && kept.text === text && !again) byId("scheme").classList.remove("old");
  } catch (error) {
    if (asking !== own) return;
    note(error.message === "Failed to fetch" ? W.gone : error.message, { [W.again]: () => soon(0) });
  }
  asking = null;
  if (again || kept.text !== text) { again = false; soon(0); }
}

function show(found) {
  if (found.svg) { picture(byId("sketch"), found.svg); byId("sketch").alt = `${W.scheme}: ${found.title || kept.name}`; }
  typed.faults(found.faults || []);
  const list = byId("faults");
  list.replaceChildren();
  for (const one of found.faults || []) {
    const item = made(list, "li");
    const tells = /\s/.test(one.path);  // line 23, column 11
    if (one.line) made(item, "button", tells ? one.path : say("line", one)).addEventListener("click", () => typed.go(one.line, one.column));
    item.append(` ${faultText(tells && one.line ? { ...one, path: "" } : one)}`);
  }
  byId("faults-head").hidden = list.hidden = !kept.text.trim();
  if (!list.children.length) made(list, "li", W.no_faults, { class: "good" });
  const variant = byId("variant"), names = found.variants || [];
  if (found.lacks) hide(found.lacks);
  if (found.variants && (names.length || !(found.faults || []).length)) {
    byId("variant-of").hidden = !names.length;
    variant.replaceChildren();
    made(variant, "option", W.main_part, { value: "" });
    for (const name of names) made(variant, "option", name, { value: name });
    if (!names.includes(kept.variant)) kept.variant = "";
    variant.value = kept.variant;
  }
  if (found.ways > 1 && view === "scheme") { stale.add("assemblies"); turnTo("assemblies"); }
}

// What is beside it -------------------------------------------------------------------------------

const layout = () => document.querySelector("select.layout").value || null;
for (const select of document.querySelectorAll("select.layout")) {
  made(select, "option", W.usual, { value: "" });
  for (const name of D.layouts) made(select, "option", name, { value: name });
  select.addEventListener("change", () => {
    for (const other of document.querySelectorAll("select.layout")) other.value = select.value;
    if (view === "sheets") sheets.draw(problem());
  });
}
byId("colour").addEventListener("change", () => {
  stale.add("motion");
  sheets.draw(problem());
});
byId("draw").addEventListener("click", () => sheets.draw(problem()));

async function refresh() {
  if (view === "drawing") { board.open(); return; }
  if (view === "scheme") { if (byId("scheme").classList.contains("old")) soon(0); return; }
  if (!kept.text.trim() || !stale.has(view)) return;
  stale.delete(view);
  const shown = view, panel = byId(shown), told = panel.querySelector(".told");
  let found = null;
  if (shown === "sheets") found = await sheets.draw(problem());
  if (shown === "assemblies") found = await ways(panel, told);
  if (shown === "motion") {
    found = await long("command", { ...problem(), what: "live" }, told);
    const page = found?.files.find(one => one.name.endsWith(".html"));
    if (page) framed(byId("moving"), found.files_at + encodeURI(page.name), W.motion, { live: true });
    else if (found !== undefined) empty(panel);
  }
  if (["tables", "protocol", "structure"].includes(shown)) {
    found = await long("command", { ...problem(), what: shown }, told);
    if (found !== undefined) panel.querySelector("pre").textContent = found?.output || "";
  }
  if (shown === "protocol" && found) await film(told);
  if (found === undefined) stale.add(shown);  // stopped by something else: it is asked again when it is turned to
}

async function film(told) {  // the same construction, played above its text
  const found = await long("command", { ...problem(), what: "play" }, told);
  const page = found?.files.find(one => one.name.endsWith(".html"));
  if (page) framed(byId("playing"), found.files_at + encodeURI(page.name), W.protocol, { live: true });
  else byId("playing").replaceChildren();
  if (found === undefined) stale.add("protocol");
}

async function ways(panel, told) {
  const box = byId("ways"), found = await long("assemblies", problem(), told);
  if (found === undefined) return found;
  empty(panel);
  if (found) byId("ways-told").textContent = found.ways.length > 1 ? W.choose_way : W.one_way;
  for (const way of found?.ways || []) {
    const rules = Object.entries(way.rules).map(([point, rule]) => `${point} = "${rule}"`);
    const button = made(box, "button", "", { "aria-label": say("way", { rules: rules.join("; ") }) });
    picture(made(button, "img", "", { alt: "" }), way.svg);
    made(button, "code", rules.join("; "));
    button.addEventListener("click", () => { typed.put(ruled(kept.text, way.rules)); turnTo("scheme"); });
  }
  return found;
}

export function ruled(text, rules) {  // the text with these rules in [assembly]
  const lines = text.split("\n");
  let head = lines.findIndex(line => /^\s*\[\s*assembly\s*\]/.test(line));
  if (head < 0) { lines.push("", "[assembly]"); head = lines.length - 1; }
  let end = lines.findIndex((line, k) => k > head && /^\s*\[/.test(line));
  if (end < 0) end = lines.length;
  for (const [point, rule] of Object.entries(rules)) {
    const at = lines.findIndex((line, k) => k > head && k < end && line.split("=")[0].trim().replace(/"/g, "") === point);
    if (at > 0) lines[at] = `${point} = "${rule}"`;
    else { lines.splice(head + 1, 0, `${point} = "${rule}"`); end++; }
  }
  return `${lines.join("\n").replace(/\n+$/, "")}\n`;
}

for (const button of document.querySelectorAll("[data-what]")) {
  button.addEventListener("click", async () => {
    const panel = button.closest("[role=tabpanel]"), list = panel.querySelector(".made");
    const found = await long("command", { ...problem(), what: button.dataset.what }, panel.querySelector(".told"));
    if (found) fileList(list, found);
    if (found?.files.length === 1) list.querySelector("a").click();  // it is downloaded at once
  });
}

byId("ask").addEventListener("click", () => ask(problem()));
byId("judge").addEventListener("click", () => judge(problem()));
byId("work-file").addEventListener("click", () => handIn(problem()));
byId("answering").addEventListener("submit", event => event.preventDefault());

splitting();

// The beginning -----------------------------------------------------------------------------------

globalThis.studio = { board, put: text => typed.put(text), text: () => kept.text, typed };
starting((key, facts) => note(key && say(key, facts), key && key !== "loading" ? { [W.again]: () => location.reload() } : {}, true));
byId("save").hidden = !kept.file;
unsaved();
room(kept.text.trim() ? "work" : "task");
turnTo("scheme");
if (D.files.length) {
  byId("folder-of").hidden = false;
  made(byId("folder"), "option", "", { value: "" });
  for (const name of D.files) made(byId("folder"), "option", name, { value: name });
  byId("folder").addEventListener("change", event => { if (event.target.value) openFile(event.target.value); });
}
byId("new-drawing").addEventListener("click", () => {
  take(say("new_name"), "");
  turnTo("drawing");
});
async function follow(link) {  // #task=NAME, and of it &variant=NAME, &view=sheets
  if (link.has("text")) {
    const text = await unshared(link.get("text")).catch(() => null);
    if (text === null) { note(W.bad_link); return; }
    take(link.get("name") || "problem", text);
    turnTo("drawing");
    return;
  }
  await start(link.get("task"), link.get("variant") || "", take);
  if (document.getElementById(`to-${link.get("view")}`)?.closest("#views, #more-views")) turnTo(link.get("view"));
}
addEventListener("hashchange", () => { const link = linked(); if (link.has("task") || link.has("text")) follow(link); });
enter().then(() => {
  if (first.has("task") || first.has("text")) follow(first);
  else if (D.one) openFile(D.files[0]);
  else soon(0);
  group.begin(problem);
}, error => note(error.message));
bank(take);
