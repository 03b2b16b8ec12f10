// The instructor: works dropped on the page, their marks, what is set by hand, variants and questions.
import { D, W, byId, call, enter, fileList, framed, lettered, long, made, note, pdfOf, say } from "./api.js";

let found = null, byHand = [];
const told = byId("group").querySelector(".told");

export async function group(problem) {
  const { trusted } = await enter();
  byId("no-token").hidden = trusted;
  byId("desk").hidden = !trusted;
  byId("works-of").textContent = say("works_of", { title: problem().name });
  byId("choose").addEventListener("click", () => byId("chosen").click());
  byId("chosen").addEventListener("change", event => take([...event.target.files]));
  const drop = byId("drop");
  for (const [name, is] of [["dragover", true], ["dragleave", false], ["drop", false]]) {
    drop.addEventListener(name, event => { event.preventDefault(); drop.classList.toggle("over", is); });
  }
  drop.addEventListener("drop", event => take([...event.dataTransfer.files]));
  byId("forget").addEventListener("click", async () => list(await (await call("api/works/all", { method: "DELETE" })).json()));
  byId("check").addEventListener("click", () => check(problem()));
  byId("who").addEventListener("change", student);
  byId("by-hand").addEventListener("submit", event => {
    event.preventDefault();
    const [who, which, points, remark] = ["who", "which", "points", "remark"].map(id => byId(id).value.trim());
    byHand = byHand.filter(one => one.student !== who || one.id !== which);
    if (points || remark) byHand.push({ student: who, id: which, points, remark });
    check(problem());
  });
  byId("vary").addEventListener("submit", event => { event.preventDefault(); vary(problem()); });
  byId("key").addEventListener("click", async () => show(await long("command", { ...problem(), what: "key" }, told)));
}

async function take(files) {
  for (const file of files) {
    const answer = await call(`api/works/${encodeURIComponent(file.name)}`, { method: "PUT", body: file });
    if (answer.ok) list(await answer.json()); else note(await answer.text());
  }
}

function list(names) {
  byId("works").replaceChildren();
  for (const name of names) made(byId("works"), "li", name);
}

async function check(problem) {
  const answer = await long("checked", { ...problem, by_hand: byHand }, told);
  if (!answer?.marks?.length) return;
  found = answer;
  byId("results").hidden = false;
  const table = byId("marks"), [head, ...rows] = found.marks;
  table.replaceChildren();
  const top = made(made(table, "thead"), "tr"), body = made(table, "tbody");
  for (const text of head) made(top, "th", text, { scope: "col" });
  const chosen = byId("who").value;
  byId("who").replaceChildren();
  const names = [...new Set(found.answers.slice(1).map(row => row[0]))];
  for (const row of rows) {
    const line = made(body, "tr");
    for (const text of row) lettered(made(line, "td"), D.lang === "ru" ? text.replace(/^(\d+)\.(\d+)$/, "$1,$2") : text);
  }
  for (const name of names) made(byId("who"), "option", name, { value: name });
  if (names.includes(chosen)) byId("who").value = chosen;
  fileList(byId("results").querySelector(".made"), found);
  byId("entered").replaceChildren();
  for (const one of byHand) {
    const item = made(byId("entered"), "li", `${one.student} · ${one.id || W.whole_work} · ${one.points} ${one.remark} `);
    made(item, "button", "✕", { "aria-label": W.forget }).addEventListener("click", () => {
      byHand = byHand.filter(other => other !== one);
      check(problem);
    });
  }
  framed(byId("statistics"), found.files_at + "group.html", W.statistics);
  student();
}

function student() {
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
