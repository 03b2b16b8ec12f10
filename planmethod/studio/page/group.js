// The instructor: works dropped on the page, their marks, what is set by hand, variants and questions.
import { D, W, byId, call, current, enter, fileList, forgets, framed, lettered, long, made, note, pdfOf, say, sessions } from "./api.js";
import * as works from "./works.js";

let found = null, byHand = [], task = "", there = "";  // there: whose works the session has
const told = byId("group").querySelector(".told");

export async function open(name) {  // its works and points, which were kept
  const isOf = current();
  task = name;
  byHand = works.byHand(task);
  list([]);
  try {
    const names = await works.names(task);
    if (isOf()) list(names);
  } catch (error) { note(String(error)); }
}

forgets(() => {
  found = null;
  byId("results").hidden = byId("varied").hidden = true;
  byId("by-hand").reset();
});

export async function begin(problem) {
  const { trusted } = await enter();
  byId("no-token").hidden = trusted;
  byId("desk").hidden = !trusted;
  byId("works-of").textContent = say("works_of", { title: problem().name });
  open(problem().task);
  byId("choose").addEventListener("click", () => byId("chosen").click());
  byId("chosen").addEventListener("change", event => { take([...event.target.files]); event.target.value = ""; });
  const drop = byId("drop");
  for (const [name, is] of [["dragover", true], ["dragleave", false], ["drop", false]]) {
    drop.addEventListener(name, event => { event.preventDefault(); drop.classList.toggle("over", is); });
  }
  drop.addEventListener("drop", event => take([...event.dataTransfer.files]));
  byId("forget").addEventListener("click", async () => { there = ""; await works.clear(task); list(await works.names(task)); });
  byId("check").addEventListener("click", () => check(problem()));
  byId("who").addEventListener("change", student);
  byId("by-hand").addEventListener("submit", event => {
    event.preventDefault();
    const [who, which, points, remark] = ["who", "which", "points", "remark"].map(id => byId(id).value.trim());
    set(problem(), { student: who, id: which, points, remark });
  });
  byId("vary").addEventListener("submit", event => { event.preventDefault(); vary(problem()); });
  byId("key").addEventListener("click", async () => show(await long("command", { ...problem(), what: "key" }, told)));
}

const send = (name, file) => call(`api/works/${encodeURIComponent(name)}`, { method: "PUT", body: file });
const here = () => `${sessions()} ${task}`;

async function take(files) {
  const isOf = current(), own = task;
  await sent();
  for (const file of files) {
    const answer = isOf() && await send(file.name, file);
    if (!isOf()) { there = ""; return; }
    if (!answer.ok) { note(await answer.text()); continue; }
    await works.add(own, file.name, file);
    const names = await works.names(own);
    if (isOf()) list(names);
  }
}

async function sent() {  // the session has the works of this task and no others
  if (there === here() && !D.alone) return;  // a Python of the browser that was stopped has none
  await call("api/works/all", { method: "DELETE" });
  for (const name of await works.names(task)) {
    const answer = await send(name, await works.read(task, name));
    if (!answer.ok) note(await answer.text());
  }
  there = here();
}

function list(names) {
  byId("works").replaceChildren();
  for (const name of names) made(byId("works"), "li", name);
}

async function check(problem) {
  let answer, own;
  do {  // a session that has ended while one was away has left its works behind
    await sent();
    own = here();
    answer = await long("checked", { ...problem, by_hand: byHand }, told);
  } while (answer !== undefined && own !== here());
  if (answer === undefined) return;
  byId("results").hidden = !answer?.marks?.length;
  if (!answer?.marks?.length) return;
  found = answer;
  const table = byId("marks"), [head, ...rows] = found.marks;
  table.replaceChildren();
  const top = made(made(table, "thead"), "tr"), body = made(table, "tbody");
  for (const text of head) made(top, "th", text, { scope: "col" });
  const chosen = byId("who").value;
  byId("who").replaceChildren();
  const names = [...new Set(found.answers.slice(1).map(row => row[0]))];
  for (const row of rows) {
    const line = made(body, "tr", "", { "data-who": row[0] });
    for (const [k, text] of row.entries()) {
      const told = D.lang === "ru" ? text.replace(/^(\d+)\.(\d+)$/, "$1,$2") : text;
      if (!k) made(made(line, "th", "", { scope: "row" }), "button", text).addEventListener("click", () => turn(text));
      else if (k === POINTS) pointed(made(line, "td"), row[0], told, problem);
      else lettered(made(line, "td"), told);
    }
    line.addEventListener("click", event => { if (!event.target.closest("button, input")) turn(row[0]); });
  }
  for (const name of names) made(byId("who"), "option", name, { value: name });
  if (names.includes(chosen)) byId("who").value = chosen;
  fileList(byId("results").querySelector(".made"), found);
  byId("entered").replaceChildren();
  for (const one of byHand) {
    const item = made(byId("entered"), "li", `${one.student} · ${one.id || W.whole_work} · ${one.points} ${one.remark} `);
    made(item, "button", "✕", { "aria-label": W.forget }).addEventListener("click", () => {
      byHand = byHand.filter(other => other !== one);
      works.keepByHand(task, byHand);
      check(problem);
    });
  }
  framed(byId("statistics"), found.files_at + "group.html", W.statistics);
  student();
}

const POINTS = 2;  // the column of the gradebook

function pointed(cell, who, told, problem) {  // points of a whole work, changed where they stand
  const input = made(cell, "input", "", { inputmode: "decimal", value: told, "aria-label": `${W.points}: ${who}` });
  input.addEventListener("change", () => set(problem, { student: who, id: "", points: input.value.trim(), remark: "" }));
}

function set(problem, one) {
  byHand = byHand.filter(other => other.student !== one.student || other.id !== one.id);
  if (one.points || one.remark) byHand.push(one);
  works.keepByHand(task, byHand);
  check(problem);
}

function turn(who) {  // the work of a row
  byId("who").value = who;
  student();
  byId("page-of").scrollIntoView({ block: "nearest" });
}

function student() {
  for (const line of byId("marks").querySelectorAll("tbody tr")) line.toggleAttribute("data-shown", line.dataset.who === byId("who").value);
  const who = byId("who").value, which = byId("which"), chosen = which.value;
  which.replaceChildren();
  made(which, "option", W.whole_work, { value: "" });
  for (const row of found.answers.slice(1)) if (row[0] === who) made(which, "option", row[3] || row[2], { value: row[2] });
  which.value = [...which.options].some(one => one.value === chosen) ? chosen : "";
  const page = found.files.find(one => one.name === found.pages[who]);
  if (page) framed(byId("page"), found.files_at + encodeURI(page.name), who, { pdf: pdfOf(found, page) });
  else byId("page").replaceChildren();
}

async function vary(problem) {
  show(await long("varied", { ...problem, count: +byId("how-many").value, seed: +byId("seed").value,
    moodle: byId("moodle").checked }, told));
}

function show(answer) {
  if (!answer) return;
  const lists = byId("desk").querySelectorAll(".made");
  byId("varied").hidden = !answer.output;
  byId("varied").textContent = answer.output;
  fileList(lists[lists.length - 1], answer);
}
