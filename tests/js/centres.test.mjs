import assert from "node:assert/strict";
import { test } from "node:test";
import { chord } from "../../planmethod/render/live/script/centres.js";

const BOX = [0, 0, 10, 5];

test("the chord of two points ends on the sides of the box", () => {
  const ends = chord([1, 1, 1], [2, 2, 1], BOX).map(end => end.map(v => Math.round(v * 1e9) / 1e9 + 0));
  assert.deepEqual(ends.sort(), [[0, 0], [5, 5]]);
});

test("a centre at infinity gives the direction of the chord", () => {
  const ends = chord([4, 6, 2], [0, 1, 0], BOX).map(end => end.map(v => v + 0)).sort((a, b) => a[1] - b[1]);
  assert.deepEqual(ends, [[2, 0], [2, 5]]);
});

test("a line beside the box, and two centres in one place, have no chord", () => {
  assert.equal(chord([0, 9, 1], [10, 9, 1], BOX), null);
  assert.equal(chord([3, 3, 1], [6, 6, 2], BOX), null);
});
