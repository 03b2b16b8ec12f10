// The page that plays a construction: strokes appear by classes of their groups, sentences by templates.
import { act, asking, frames, jump, next, phase, previous, sectionFrom, shown, time } from "./playback.js";

/** @type {(id: string) => any} */
const byId = id => document.getElementById(id);
const D = JSON.parse(byId("scene").textContent);
const COUNT = D.steps.length, SECTIONS = D.steps.map(step => step.section);
const groups = [...document.querySelectorAll("#boards [data-step]")];
const terms = [...document.querySelectorAll("#words [data-drawn]")];

let state = { at: 0, hidden: false, ask: false }, timer = 0;

/** @type {(number: number) => DocumentFragment} */
const sentence = number => byId(`said-${number}`).content.cloneNode(true);

/** @type {(figures: Element[], step: { board: string, source: string }) => void} */
function arrange(figures, { board, source }) {  // the board that is drawn on, and beside a plan the scheme
  for (const figure of figures) {
    const own = figure.getAttribute("data-board");
    figure.toggleAttribute("hidden", own !== board && own !== source);
    figure.classList.toggle("current", own === board);
  }
}

/** @type {(parts: Element[], last: number) => void} */
function paint(parts, last) {
  for (const part of parts) part.setAttribute("data-phase", phase(Number(part.getAttribute("data-step")), last));
}

function show() {
  const step = D.steps[state.at], last = shown(state);
  arrange([...document.querySelectorAll("#boards figure")], step);
  paint(groups, last);
  for (const term of terms) term.setAttribute("data-phase", phase(Number(term.getAttribute("data-drawn")), last));
  for (const box of document.querySelectorAll("#words [data-section]"))
    box.toggleAttribute("hidden", Number(box.getAttribute("data-section")) !== step.section);
  byId("section").value = String(step.section);
  byId("count").textContent = `${state.at + 1} / ${COUNT}`;
  byId("place").value = String(state.at);
  byId("place").setAttribute("aria-valuetext", `${state.at + 1} / ${COUNT}`);
  byId("said").classList.toggle("asks", state.hidden);
  if (state.hidden) byId("said").textContent = D.words.ask;
  else byId("said").replaceChildren(sentence(state.at));
  byId("back").disabled = state.at === 0;
  byId("on").disabled = state.at === COUNT - 1 && !state.hidden;
}

/** @type {(state: { at: number, hidden: boolean, ask: boolean }) => void} */
function turn(to) {
  state = to;
  show();
}

function wait() {  // for the next step, while it plays
  clearTimeout(timer);
  if (!playing()) return;
  const words = state.hidden ? 12 : D.steps[state.at].words;
  timer = setTimeout(() => {
    turn(next(state, COUNT));
    if (state.at === COUNT - 1 && !state.hidden) stop();
    else wait();
  }, time(words, Number(byId("speed").value)));
}

const playing = () => byId("play").getAttribute("aria-pressed") === "true";

function stop() {
  clearTimeout(timer);
  byId("play").setAttribute("aria-pressed", "false");
  byId("play").textContent = "▶";
  byId("play").setAttribute("aria-label", D.words.play);
}

function play() {
  if (playing()) return stop();
  if (state.at === COUNT - 1) turn(jump(state, 0, COUNT));
  byId("play").setAttribute("aria-pressed", "true");
  byId("play").textContent = "❚❚";
  byId("play").setAttribute("aria-label", D.words.pause);
  wait();
}

function screen() {
  if (document.fullscreenElement) document.exitFullscreen();
  else byId("stage").requestFullscreen?.().catch(() => {});
}

/** @type {Record<string, () => void>} */
const ACTS = {
  next: () => turn(next(state, COUNT)),
  previous: () => turn(previous(state)),
  first: () => turn(jump(state, 0, COUNT)),
  last: () => turn(jump(state, COUNT - 1, COUNT)),
  "section back": () => turn(jump(state, sectionFrom(SECTIONS, state.at, -1), COUNT)),
  "section on": () => turn(jump(state, sectionFrom(SECTIONS, state.at, 1), COUNT)),
  play, screen,
  ask: () => { byId("ask").checked = !byId("ask").checked; turn(asking(state, byId("ask").checked)); },
};

/** @type {(name: string) => void} */
function perform(name) {
  ACTS[name]();
  if (name !== "play") wait();
}

document.addEventListener("keydown", event => {
  const name = act(event.key), on = event.target instanceof Element ? event.target : document.body;
  if (!name || event.ctrlKey || event.altKey || event.metaKey) return;
  if (on.matches("select, input[type=range]") && event.key !== "PageDown" && event.key !== "PageUp") return;
  if (event.key === " " && on.matches("button, input")) return;  // it presses them
  event.preventDefault();
  perform(name);
});
for (const [id, name] of [["back", "previous"], ["on", "next"], ["begin", "first"], ["end", "last"], ["play", "play"], ["full", "screen"]])
  byId(id).addEventListener("click", () => perform(name));
byId("boards").addEventListener("click", () => perform("next"));
byId("ask").addEventListener("change", () => turn(asking(state, byId("ask").checked)));
byId("speed").addEventListener("change", wait);
byId("section").addEventListener("change", () => {
  turn(jump(state, SECTIONS.indexOf(Number(byId("section").value)), COUNT));
  wait();
});
byId("place").addEventListener("input", () => turn(jump(state, Number(byId("place").value), COUNT)));
byId("full").hidden = !document.fullscreenEnabled;

// Print -------------------------------------------------------------------------------------------

function print() {  // each frame is a copy of its board, as it is after the step
  const boards = Object.fromEntries([...document.querySelectorAll("#boards figure")].map(one => [one.getAttribute("data-board"), one]));
  byId("frames").replaceChildren(...frames(D.steps).map(number => {
    const frame = document.createElement("article");
    const figure = /** @type {Element} */ (boards[D.steps[number].board].cloneNode(true));
    figure.removeAttribute("hidden");
    for (const part of figure.querySelectorAll("[data-step]"))
      if (Number(part.getAttribute("data-step")) > number) part.remove();
    paint([...figure.querySelectorAll("[data-step]")], number);
    const text = document.createElement("div");
    text.append(sentence(number));
    frame.append(figure, text);
    return frame;
  }));
}
addEventListener("beforeprint", print);
addEventListener("afterprint", () => byId("frames").replaceChildren());
byId("print").addEventListener("click", () => window.print());
byId("pages").addEventListener("change", () => byId("frames").setAttribute("data-pages", byId("pages").value));

const asked = Number(location.hash.slice(1));  // #12 opens step 12
turn(jump(state, Number.isInteger(asked) && asked > 0 ? asked - 1 : 0, COUNT));
