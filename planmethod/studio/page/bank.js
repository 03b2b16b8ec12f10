// What there is to start from: the tasks of the textbooks, templates, files.
import { D, W, byId, latest, made, note, say } from "./api.js";
import { ask } from "./transport.js";

const STEP = 24;
let tasks = [], shown = 0, asked = 0;

export async function bank(take) {
  for (const [name, meaning] of Object.entries(D.families)) made(byId("families"), "option", `${meaning} (${name})`, { value: name });
  byId("family").addEventListener("click", () => start(byId("families").value, "", take));
  byId("more").addEventListener("click", () => more(take));
  let pause = 0;
  byId("search").addEventListener("input", () => { clearTimeout(pause); pause = setTimeout(() => find(take), 200); });
  await find(take);
}

async function find(take) {
  const own = ++asked, words = byId("search").value;
  const answer = await ask(`api/tasks?search=${encodeURIComponent(words)}`);
  if (own !== asked || !answer.ok) return;
  tasks = await answer.json();
  shown = 0;
  byId("tasks").replaceChildren();
  byId("count").textContent = say("found", { count: tasks.length });
  more(take);
}

function more(take) {
  for (const task of tasks.slice(shown, shown + STEP)) {
    const item = made(byId("tasks"), "li");
    made(item, "img", "", { src: `picture/${encodeURIComponent(task.name)}.svg?lang=${D.lang}`, loading: "lazy",
      alt: say("shown_as", { name: task.name }) });
    made(item, "b", task.title);
    made(item, "span", `${task.name}${task.groups.length ? ` · ${task.groups.join("+")}` : ""}`, { class: "hint" });
    made(item, "span", task.source, { class: "hint" });
    const row = made(item, "div", "", { class: "row" });
    let choice = null;
    if (task.variants.length) {
      choice = made(row, "select", "", { "aria-label": `${W.variant}: ${task.name}` });
      made(choice, "option", W.main_part, { value: "" });
      for (const name of task.variants) made(choice, "option", name, { value: name });
    }
    const taken = () => start(task.name, choice?.value || "", take);
    made(row, "button", W.take, { "aria-label": `${W.take}: ${task.name}` }).addEventListener("click", taken);
    item.firstChild.addEventListener("click", taken);
  }
  shown = Math.min(tasks.length, shown + STEP);
  byId("more").hidden = shown === tasks.length;
}

export async function start(name, variant, take) {
  const isLast = latest();
  const answer = await ask(`api/start/${encodeURIComponent(name)}?lang=${D.lang}&variant=${encodeURIComponent(variant)}`);
  if (!answer.ok) { note(say("no_task", { name })); return; }
  const found = await answer.json();
  if (!isLast()) return;
  take(variant ? `${found.name}-${variant}` : found.name, found.text);
}
