import assert from "node:assert/strict";
import { test } from "node:test";
import { act, asking, frames, jump, next, phase, previous, sectionFrom, shown, time } from "../../planmethod/render/play/script/playback.js";

const START = { at: 0, hidden: false, ask: false };

test("the keys of a presenter go to the next and the previous step, and stop at both ends", () => {
  let state = START;
  for (let k = 0; k < 5; k++) state = next(state, 4);
  assert.equal(state.at, 3);
  for (let k = 0; k < 5; k++) state = previous(state);
  assert.deepEqual(state, START);
  assert.deepEqual(["PageDown", "PageUp", " ", "Home", "End", "F", "з", "x"].map(act),
    ["next", "previous", "next", "first", "last", "screen", "play", undefined]);
});

test("a question hides the stroke and the sentence of a step until the next key", () => {
  let state = next(asking(START, true), 3);
  assert.deepEqual([state.at, state.hidden, shown(state)], [1, true, 0]);
  assert.equal(phase(1, shown(state)), "later");
  state = next(state, 3);
  assert.deepEqual([state.at, state.hidden, shown(state)], [1, false, 1]);
  state = next(state, 3);
  assert.deepEqual([state.at, state.hidden], [2, true]);
  state = next(state, 3);
  assert.deepEqual(next(state, 3), state);  // the last answer is shown once
  assert.equal(asking({ ...state, hidden: true }, false).hidden, false);
});

test("a place in the list is within the steps", () => {
  assert.deepEqual([-3, 0, 7, 99].map(at => jump(START, at, 8).at), [0, 0, 7, 7]);
});

test("sections are left forwards and backwards", () => {
  const sections = [0, 0, 1, 1, 1, 2];
  assert.deepEqual([0, 1, 2, 5].map(at => sectionFrom(sections, at, 1)), [2, 2, 5, 5]);
  assert.deepEqual([0, 1, 2, 4, 5].map(at => sectionFrom(sections, at, -1)), [0, 0, 0, 2, 2]);
});

test("a longer sentence is shown longer, and a higher speed shortens it", () => {
  assert.ok(time(20, 1) > time(5, 1));
  assert.equal(time(10, 2), time(10, 1) / 2);
});

test("the steps with strokes are printed; if there are none, the last one is", () => {
  assert.deepEqual(frames([{ strokes: true }, { strokes: false }, { strokes: true }]), [0, 2]);
  assert.deepEqual(frames([{ strokes: false }, { strokes: false }]), [1]);
});
