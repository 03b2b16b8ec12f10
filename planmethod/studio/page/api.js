// What the page asks for, and how it tells what becomes of it.
import { ask, show as shown } from "./transport.js";

export const D = JSON.parse(document.getElementById("data").textContent);
export const W = D.words;
/** @type {(id: string) => any} */
export const byId = id => document.getElementById(id);
export const say = (key, facts = {}) => W[key].replace(/\{(\w+)\}/g, (_, name) => facts[name]);
/** @type {(parent: Element, tag: string, text?: string | number, more?: Record<string, any>) => any} */
export const made = (parent, tag, text = "", more = {}) => {
  const node = parent.appendChild(document.createElement(tag));
  node.textContent = String(text);
  for (const [key, value] of Object.entries(more)) node.setAttribute(key, value);
  return node;
};

export function linked() {  // what the address asks for behind its #; once, so that nothing typed since is replaced
  const asked = new URLSearchParams(location.hash.slice(1));
  if (["task", "token", "text"].some(key => asked.has(key))) history.replaceState(null, "", location.pathname + location.search);
  return asked;
}
export const first = linked();
const token = first.get("token") || sessionStorage.getItem("token") || "";
if (token) sessionStorage.setItem("token", token);
let session = null, count = 0;
export const sessions = () => count;  // so far: a new one has nothing of those before

export function enter() {
  session ??= ask("api/session", { method: "POST", body: JSON.stringify({ token }) }).then(async answer => {
    if (!answer.ok) throw new Error(await answer.text());
    count++;
    return answer.json();
  }).catch(error => { session = null; throw error; });
  return session;
}

export async function call(path, options = {}) {  // with the key of the session; a new one where it has ended
  for (let turn = 0; ; turn++) {
    const { key } = await enter();
    const mark = path.includes("?") ? "&" : "?";
    const answer = await ask(`${path}${mark}lang=${D.lang}`,
      { ...options, headers: { ...options.headers, "x-studio": key } });
    if (answer.status !== 401 || turn) return answer;
    session = null;
    note(W.session_gone);
  }
}

const PATIENCE = [1000, 2000, 4000, 8000];  // ms: what is typed is asked again until it is answered

const SILENCE = 3000;  // ms: then it is said that nobody answers

function lost(is) {
  const told = is ? W.gone : "";
  if (byId("gone").textContent === told) return;
  byId("gone").textContent = told;
  byId("gone").hidden = !is;
}

/** @type {(act: string, body: any, how?: { signal?: AbortSignal, told?: (one: any) => void, tries?: number }) => Promise<any>} */
export async function compute(act, body, { signal, told = () => {}, tries = 0 } = {}) {
  for (let turn = 0; ; turn++) {
    const late = setTimeout(() => lost(true), SILENCE);
    let answer;
    try {
      answer = await call(`api/do/${act}`, { method: "POST", body: JSON.stringify(body), signal });
      lost(false);
    } catch (error) {
      if (signal?.aborted) throw error;
      lost(true);
      if (turn >= tries) throw error;
      answer = null;
    } finally {
      clearTimeout(late);
    }
    if (answer?.ok) {
      const found = await lines(answer, told);
      if (found) return found;
      if (turn >= tries) throw new Error(W.gone);
    } else if (turn >= tries || (answer && ![429, 502, 503].includes(answer.status))) {
      throw new Error(answer ? await answer.text() : W.gone);
    }
    await new Promise(done => setTimeout(done, PATIENCE[Math.min(turn, PATIENCE.length - 1)]));
  }
}

async function lines(answer, told) {
  const reader = answer.body.pipeThrough(new TextDecoderStream()).getReader();
  let left = "", found = null;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) return found;
    left += value;
    const parts = left.split("\n");
    left = parts.pop();
    for (const part of parts) {
      const one = JSON.parse(part);
      if (one.found) found = one.found; else told(one);
    }
  }
}

// What was made for a task is forgotten when another one is taken, all of it here -----------------

let task = 0;
const forgetting = [];
export const forgets = act => { forgetting.push(act); };  // what a module knows of a task beside what it shows

export function forget() {
  task++;
  stopping?.abort();
  empty(document);
  for (const told of document.querySelectorAll(".told, #done")) told.textContent = "";
  for (const act of forgetting) act();
}

export function empty(box) {  // of all that results are put into
  for (const made of box.querySelectorAll("[data-made]")) made.replaceChildren();
}

let asked = 0;
export const latest = () => { const own = ++asked; return () => own === asked; };  // whether no other text was asked for since
export const current = () => { const own = task; return () => own === task; };  // whether it is still the same task

// One long computation at a time, with its place, its share and a way to stop it ------------------

let stopping = null;
byId("stop").addEventListener("click", () => stopping?.abort("stop"));

export async function long(act, body, told) {  // null where it is refused, which is said in told; undefined where it is stopped
  stopping?.abort();
  const own = stopping = new AbortController();
  const status = byId("status"), share = byId("share");
  const show = one => {
    status.hidden = false;
    byId("told").textContent = one.place ? say("waiting", one) : W.working;
    if (one.share === undefined) share.removeAttribute("value"); else share.value = one.share;
  };
  told.textContent = byId("done").textContent = "";
  show({});
  try {
    const found = await compute(act, body, { signal: own.signal, told: show });
    if (own.signal.aborted) return undefined;  // too late: something else is shown
    const faults = (found.faults || []).map(one => faultText(one));
    told.textContent = [found.refused, found.errors, ...faults].filter(Boolean).join("\n");
    if (!told.textContent) byId("done").textContent = W.done;  // for who hears the page
    return found.refused || faults.length ? null : found;
  } catch (error) {
    if (own.signal.aborted) return undefined;
    told.textContent = error.message === "Failed to fetch" ? W.gone : error.message;
    return null;
  } finally {
    if (stopping === own) { stopping = null; status.hidden = true; }
  }
}

export const faultText = one => [one.path && `${one.path}: `, one.message, one.hint && `. ${one.hint}`].filter(Boolean).join("");

const READ = 10_000;  // ms: what asks nothing goes by itself
let reading = 0;

export function note(text, doing = {}, stays = Object.keys(doing).length > 0) {  // tells something, with what can be done about it
  clearTimeout(reading);
  byId("note").hidden = !text;
  byId("said").textContent = text;
  byId("said-do").replaceChildren();
  for (const [label, act] of Object.entries(doing)) {
    made(byId("said-do"), "button", label).addEventListener("click", () => { note(""); act(); });
  }
  if (text && !stays) reading = setTimeout(() => note(""), READ);
}
byId("said-off").addEventListener("click", () => note(""));

/** @type {(list: any, found: any) => void} */
export function fileList(list, found) {  // what was made, to download
  list.replaceChildren();
  if (found.files.length > 1) made(made(list, "li"), "a", W.zip, { href: `${found.files_at}all.zip`, download: "" });
  for (const one of found.files) {
    const item = made(list, "li");
    made(item, "a", one.name, { href: `${found.files_at}${encodeURI(one.name)}?download`, download: one.name.split("/").pop() });
    item.append(` ${Math.max(1, Math.round(one.bytes / 1024))} КБ`.replace("КБ", D.lang === "ru" ? "КБ" : "kB"));
  }
}

export function pdfOf(found, page) {  // the address of the same page for paper
  const name = page.name.replace(/html$/, "pdf");
  return found.files.some(one => one.name === name) ? found.files_at + encodeURI(name) : "";
}

export function framed(box, address, title, { live = false, pdf = "" } = {}) {  // a page that was made, kept apart from this one
  const frame = document.createElement("iframe");
  frame.title = title;
  frame.setAttribute("sandbox", live ? "allow-scripts" : "");
  shown(frame, address, live);
  box.replaceChildren(frame);
  const own = made(box, "p", "", { class: "own" });
  made(own, "a", W.own_tab, { href: address, target: "_blank", rel: "noopener" });
  if (pdf) { own.append(" · "); made(own, "a", "PDF", { href: pdf, target: "_blank", rel: "noopener" }); }
}

export function lettered(node, text) {  // with its indices: v_B3, aᵏ_B3B2, a^τ_B3C, a^τ, M_ур
  const tags = [, , "sup", "sub", "sub"];
  for (const [k, part] of text.split(/(?<!\p{L})(\p{L}\p{Lm}?)(?:\^(\p{L})(?:_([\p{L}\d]+))?|_([\p{L}\d]+))/u).entries()) {
    if (part && tags[k % 5]) made(node, tags[k % 5], part); else if (part) node.append(part);
  }
  return node;
}

export function download(name, text, type) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([text], { type }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

export function picture(image, svg) {
  const old = image.src;
  image.src = URL.createObjectURL(new Blob([svg], { type: "image/svg+xml" }));
  if (old.startsWith("blob:")) URL.revokeObjectURL(old);
}

export function tabs(list, shown) {  // by click and by arrows
  const all = [...list.querySelectorAll("[role=tab]")];
  const open = name => {
    for (const tab of all) {
      const panel = tab.getAttribute("aria-controls"), is = panel === name;
      tab.setAttribute("aria-selected", is);
      tab.tabIndex = is ? 0 : -1;
      byId(panel).hidden = !is;
    }
    shown(name);
  };
  for (const tab of all) {
    tab.addEventListener("click", () => open(tab.getAttribute("aria-controls")));
    tab.addEventListener("keydown", event => {
      const seen = all.filter(one => !one.hidden), here = seen.indexOf(tab);
      const next = { ArrowRight: here + 1, ArrowLeft: here - 1, Home: 0, End: -1 }[event.key];
      if (next === undefined) return;
      event.preventDefault();
      const other = seen.at(next % seen.length);
      other.focus();
      open(other.getAttribute("aria-controls"));
    });
  }
  return open;
}
