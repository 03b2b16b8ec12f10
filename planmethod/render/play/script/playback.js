// What a played construction shows: the state after each key, and how long a step is read. No document is needed here.

/** @typedef {{ at: number, hidden: boolean, ask: boolean }} State  step, whether its answer is hidden, whether it asks first */

/** @type {(state: State, count: number) => State} */
export function next(state, count) {  // the answer of a hidden step, else the next step
  if (state.hidden) return { ...state, hidden: false };
  return state.at >= count - 1 ? state : { ...state, at: state.at + 1, hidden: state.ask };
}

/** @type {(state: State) => State} */
export const previous = state => ({ ...state, at: Math.max(0, state.at - 1), hidden: false });

/** @type {(state: State, at: number, count: number) => State} */
export const jump = (state, at, count) =>
  ({ ...state, at: Math.min(Math.max(at, 0), count - 1), hidden: false });

/** @type {(state: State, ask: boolean) => State} */
export const asking = (state, ask) => ({ ...state, ask, hidden: ask && state.hidden });

/** @type {(state: State) => number} */
export const shown = state => state.hidden ? state.at - 1 : state.at;  // the last step whose strokes are seen

/** @type {(step: number, last: number) => "done" | "now" | "later"} */
export const phase = (step, last) => step < last ? "done" : step === last ? "now" : "later";

const KEYS = {
  ArrowRight: "next", PageDown: "next", " ": "next", ArrowDown: "next",
  ArrowLeft: "previous", PageUp: "previous", ArrowUp: "previous",
  Home: "first", End: "last", p: "play", f: "screen", q: "ask", "[": "section back", "]": "section on",
};
// The same keys of a Russian keyboard.
const RUSSIAN = { з: "p", а: "f", й: "q", х: "[", ъ: "]" };

/** @type {(key: string) => string | undefined} */
export function act(key) {  // what a key of the keyboard or of a presenter does
  const small = key.length === 1 ? key.toLowerCase() : key;
  return KEYS[RUSSIAN[small] ?? small];
}

const LEAST = 1800, WORD = 260;  // milliseconds: of a step, and to read a word

/** @type {(words: number, speed: number) => number} */
export const time = (words, speed) => (LEAST + WORD * words) / speed;

/** @type {(sections: number[], at: number, sense: number) => number} */
export function sectionFrom(sections, at, sense) {  // first step of the section before or after; `sections` has that of each step
  const own = sections[at];
  if (sense > 0) {
    const found = sections.findIndex((section, k) => k > at && section !== own);
    return found < 0 ? sections.length - 1 : found;
  }
  const start = sections.indexOf(own);
  return start < at || start === 0 ? start : sections.indexOf(sections[start - 1]);
}

/** @type {(steps: { strokes: boolean }[]) => number[]} */
export const frames = steps => {  // the steps that are printed: those with strokes, and the last
  const found = steps.flatMap((step, k) => step.strokes ? [k] : []);
  return found.length ? found : [steps.length - 1];
};
