// What there is to start from: the tasks of the textbooks, templates, files.
import { D, W, byId, latest, made, note, say } from "./api.js";
import { ask } from "./transport.js";

const STEP = 24, FIRST = 8;  // tasks shown at once; templates
const of = (...groups) => task => task.kind === "linkage" && task.groups.join() === groups.join();
const CHIPS = {
  chip_four_bar: of("RRR"), chip_slider_crank: of("RRP"),
  chip_slotted: task => task.groups.some(one => ["RPR", "RPP", "PRP"].includes(one)),
  chip_six_link: task => task.groups.length === 2,
  chip_gears: task => ["gears", "meshing"].includes(task.kind), chip_cams: task => ["cam", "cams"].includes(task.kind),
  chip_point: task => task.kind === "point",
};
let found = [], tasks = [], shown = 0, asked = 0, chip = "";

export async function bank(take) {
  const families = Object.entries(D.families);
  const offer = some => some.forEach(([name, meaning]) => {
    const item = card(byId("families"), name, meaning, "", () => start(name, "", take));
    made(made(item, "div", "", { class: "row" }), "button", W.take, { "aria-label": `${W.take}: ${meaning}` }).addEventListener("click", () => start(name, "", take));
  });
  offer(families.slice(0, FIRST));
  byId("more-families").addEventListener("click", () => { byId("more-families").hidden = true; offer(families.slice(FIRST)); });
  byId("more-tasks").addEventListener("click", () => more(take));
  for (const name of Object.keys(CHIPS)) {
    made(byId("chips"), "button", W[name], { "aria-pressed": false, "data-chip": name }).addEventListener("click", () => {
      chip = chip === name ? "" : name;
      for (const one of byId("chips").children) one.setAttribute("aria-pressed", String(one.dataset.chip === chip));
      listed(take);
    });
  }
  let pause = 0;
  byId("search").addEventListener("input", () => { clearTimeout(pause); pause = setTimeout(() => find(take), 200); });
  await find(take);
}

async function find(take) {
  const own = ++asked, words = byId("search").value;
  const answer = await ask(`api/tasks?search=${encodeURIComponent(words)}&lang=${D.lang}`);
  if (own !== asked || !answer.ok) return;
  found = await answer.json();
  listed(take);
}

function listed(take) {
  tasks = chip ? found.filter(CHIPS[chip]) : found;
  shown = 0;
  byId("tasks").replaceChildren();
  byId("count").textContent = say("found", { count: tasks.length });
  more(take);
}

function card(list, name, title, more, taken) {  // a picture with its title, both to click
  const item = made(list, "li");
  made(item, "img", "", { src: `picture/${encodeURIComponent(name)}.svg?lang=${D.lang}`, loading: "lazy", alt: say("shown_as", { name }) })
    .addEventListener("click", taken);
  made(item, "b", title);
  if (more) made(item, "span", more, { class: "hint" });
  return item;
}

function more(take) {
  for (const task of tasks.slice(shown, shown + STEP)) {
    const taken = () => start(task.name, choice?.value || "", take), own = D.lang === "ru";
    const structure = `${task.name}${task.groups.length ? ` · ${task.groups.join("+")}` : ""}`;
    const item = card(byId("tasks"), task.name, own ? task.title : task.about, structure, taken);
    for (const told of own ? [task.source] : [task.title, task.source]) made(item, "span", told, { class: "hint", lang: "ru" });
    const row = made(item, "div", "", { class: "row" });
    let choice = null;
    if (task.variants.length) {
      choice = made(row, "select", "", { "aria-label": `${W.variant}: ${task.name}` });
      made(choice, "option", W.main_part, { value: "" });
      for (const name of task.variants) made(choice, "option", name, { value: name });
    }
    made(row, "button", W.take, { "aria-label": `${W.take}: ${task.name}` }).addEventListener("click", taken);
  }
  shown = Math.min(tasks.length, shown + STEP);
  byId("more-tasks").hidden = shown === tasks.length;
}

export async function start(name, variant, take) {
  const isLast = latest();
  const answer = await ask(`api/start/${encodeURIComponent(name)}?lang=${D.lang}&variant=${encodeURIComponent(variant)}`);
  if (!answer.ok) { note(say("no_task", { name })); return; }
  const found = await answer.json();
  if (!isLast()) return;
  take(variant ? `${found.name}-${variant}` : found.name, found.text);
}
