// The form of the answers: mm × μ beside the value while one types, the verdicts, the work as JSON.
import { D, W, byId, download, forgets, framed, lettered, long, made, pdfOf } from "./api.js";

const AGREE = 0.01;  // as in the form for spreadsheets
const RIGHT = ["ok", "near", "inherited"];
let rows = [], scales = {}, home = "";

const read = text => { const value = Number(text.trim().replace("−", "-").replace(",", ".")); return text.trim() && Number.isFinite(value) ? value : null; };
const said = value => Number(value.toPrecision(4)).toLocaleString(D.lang, { maximumSignificantDigits: 4 });

export async function ask(problem) {
  const told = byId("answers").querySelector(".told");
  const found = await long("questions", problem, told);
  if (found === undefined) return;
  byId("answering").hidden = !found?.rows?.length;
  if (!found?.rows?.length) { told.textContent ||= W.nothing_asked; return; }
  home = `planmethod.answers.${problem.task}.${problem.variant || ""}`;
  const kept = JSON.parse(localStorage.getItem(home) || "{}");
  const box = byId("scales");
  bare(box);
  scales = Object.fromEntries(Object.entries(found.scales).map(([name, label]) => {
    const input = made(lettered(made(box, "label"), `${label} `), "input", "", { inputmode: "decimal", size: 7 });
    return [name, input];
  }));
  byId("rows").replaceChildren();
  rows = found.rows.map((row, k) => {
    const line = made(byId("rows"), "tr", "", { role: "row" }), cell = label => made(line, "td", "", { role: "cell", "data-label": label });
    const name = [row.words, row.letters].filter(Boolean).join(", ");
    const head = lettered(made(line, "th", "", { scope: "row", role: "rowheader" }), row.position ? `${name} (${row.position})` : name);
    const input = label => made(cell(label), "input", "", { inputmode: "decimal", "aria-label": `${row.letters}: ${label}` });
    const choice = (label, options) => {
      const select = made(cell(label), "select", "", { "aria-label": `${row.letters}: ${label}` });
      for (const [value, text] of options) made(select, "option", text, { value });
      return select;
    };
    const mm = row.mm ? input(W.mm) : (cell(""), null), product = cell(W.mm_mu), value = input(W.value);
    const unit = choice(W.unit, Object.keys(row.units).map(one => [one, one]));
    const senses = Object.entries(row.senses);
    const sense = senses.length ? choice(W.sense, [["", ""], ...senses]) : (cell(""), null);
    unit.value = row.unit;
    const verdict = made(line, "td", "", { role: "cell", "aria-live": "polite", class: "verdict" });
    return { row, head, mm, product, value, unit, sense, verdict, k };
  });
  const fields = every();
  for (const [key, field] of fields) {
    if (kept[key] !== undefined) field.value = kept[key];
    field.addEventListener("input", () => { keep(); compare(); });
  }
  byId("student").value ||= kept.student || "";
  compare();
}

const bare = box => box.replaceChildren(box.querySelector("legend"));
forgets(() => {
  byId("answering").hidden = true;
  bare(byId("scales"));
  rows = [];
  scales = {};
  home = "";
});

const every = () => [
  ...Object.entries(scales),
  ...rows.flatMap(one => ["mm", "value", "unit", "sense"].filter(key => one[key]).map(key => [`${one.k}.${key}`, one[key]])),
];
const keep = () => localStorage.setItem(home, JSON.stringify(
  { student: byId("student").value, ...Object.fromEntries(every().map(([key, field]) => [key, field.value])) }));
byId("student").addEventListener("input", () => { if (home) keep(); });

function compare() {
  for (const one of rows) {
    const scale = scales[one.row.scale], mu = scale ? read(scale.value) : null;
    const mm = one.mm ? read(one.mm.value) : null, value = read(one.value.value);
    const factor = one.row.units[one.unit.value] || 1;
    one.product.textContent = mm !== null && mu !== null ? said(mm * mu / factor) : "";
    one.verdict.textContent = "";
    one.verdict.className = "verdict";
    if (mm === null || mu === null || value === null) continue;
    const fits = Math.abs(Math.abs(mm * mu) - Math.abs(value * factor)) <= AGREE * Math.abs(value * factor);
    one.verdict.textContent = fits ? W.agrees : W.differs;
    one.verdict.className = `verdict ${fits ? "good" : "bad"}`;
  }
}

function work(problem) {  // as planmethod check reads it: docs/reference/works-formats.md
  const filled = Object.entries(scales).filter(([, field]) => field.value.trim());
  const answers = rows.filter(one => one.value.value.trim() || one.mm?.value.trim()).map(one => ({
    id: one.row.id, value: one.value.value.trim() || null, unit: one.unit.value,
    ...(one.mm?.value.trim() ? { mm: one.mm.value.trim() } : {}), ...(one.sense?.value ? { sense: one.sense.value } : {}),
    ...(one.row.position ? { position: one.row.position } : {}),
  }));
  return { schema: 1, student: byId("student").value.trim() || W.student, problem: problem.name,
    ...(problem.variant ? { variant: problem.variant } : {}),
    scales: Object.fromEntries(filled.map(([name, field]) => [name, field.value.trim()])), answers };
}

export function handIn(problem) {
  const own = work(problem);
  download(`${own.student.replace(/[^\p{L}\p{N}]+/gu, "-")}-${problem.name}.json`, JSON.stringify(own, null, 1), "application/json");
}

export async function judge(problem) {
  const own = work(problem), told = byId("answers").querySelector(".told");
  if (!own.answers.length) { told.textContent = W.nothing_filled; return; }
  const found = await long("verdicts", { ...problem, work: own }, told);
  const judged = new Map((found?.judged || []).map(one => [one.id, one]));
  for (const one of rows) {
    const told = judged.get(one.row.id);
    if (!told || told.verdict === "blank") continue;
    one.verdict.textContent = told.words;
    one.verdict.className = `verdict ${RIGHT.includes(told.verdict) ? "good" : "bad"}`;
  }
  const page = found?.files.find(one => one.name.startsWith("pages/") && one.name.endsWith(".html"));
  if (page) framed(byId("verdicts"), found.files_at + encodeURI(page.name), W.judge, { pdf: pdfOf(found, page) });
}
