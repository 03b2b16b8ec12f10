import assert from "node:assert/strict";
import { test } from "node:test";
import { difference } from "../../planmethod/render/live/script/compare.js";
import { tolerance, typed, verdict } from "../../planmethod/render/live/script/guess.js";
import { legible } from "../../planmethod/render/live/script/marks.js";
import { sizing } from "../../planmethod/render/live/script/sizes.js";

const TOLD = { at: [0, 10, 20], sigma: { 3: [1, 2, null], 4: [null, null, null] }, times: 2, share: 0.01 };

test("a tolerance is interpolated between positions, and is a share of a large value", () => {
  assert.equal(tolerance(TOLD, 3, 5, 10), 3);
  assert.equal(tolerance(TOLD, 3, 15, 10), 4);  // the nearest one that is known
  assert.equal(tolerance(TOLD, 3, -5, 10), 2);
  assert.equal(tolerance(TOLD, 3, 0, -1000), 10);
  assert.ok(Number.isNaN(tolerance(TOLD, 4, 5, 10)));
  assert.ok(Number.isNaN(tolerance(TOLD, 7, 5, 10)));
});

test("a verdict tells the sign from the size", () => {
  assert.equal(verdict(5.1, 5, 0.2, false), "right");
  assert.equal(verdict(-5.1, 5, 0.2, false), "sense");
  assert.equal(verdict(-5.1, 5, 0.2, true), "wrong");
  assert.equal(verdict(5.3, 5, 0.2, true), "near");
  assert.equal(verdict(6, 5, 0.2, true), "wrong");
});

test("numbers are read as people type them, and nothing else is", () => {
  assert.deepEqual([" 3,92", "−5", "+.5", "1.2·10^3", "2e-2"].map(typed), [3.92, -5, 0.5, 1200, 0.02]);
  for (const text of ["", "x", "3,9,2", "1 000", "--2", "Infinity"]) assert.ok(Number.isNaN(typed(text)), text);
});

test("numbers of a slider that would cover one another are left out", () => {
  assert.deepEqual(legible([0, 10, 30, 31, 60]), [true, false, true, false, true]);
});

test("angles differ by at most half a turn", () => {
  assert.equal(difference({ angle: true }, 170, -170), -20);
  assert.equal(difference({ angle: false }, 170, -170), 340);
});

test("a side of a triangle moves the third point, and inputs follow their slopes", () => {
  const side = (name, p, q, value) => ({ name, value, means: ["length", "2", p, q], moves: {} });
  const { free, given } = sizing({
    links: { 0: {}, 2: { B: [0, 0], C: [4, 0], S: [0, 3] } },
    slides: [],
    inputs: [{ name: "l_CS", value: 5 }, { name: "A", value: [1, 1] }, { name: "side_C", side: "C", value: 1 }],
    parameters: [side("l_BC", "B", "C", 4), side("l_BS", "B", "S", 3), side("l_SC", "S", "C", 5),
      { name: "x_A", value: 1, means: ["fixed", "A", "x"], moves: { A: [1, 0] } }],
  });
  assert.deepEqual(free(given()), [5, 1, 1, 1]);
  const [far, x, y, turned] = free({ ...given(), l_SC: 6, x_A: 3 }, { C: -1 });
  assert.ok(Math.abs(far - 6) < 1e-12);
  assert.deepEqual([x, y, turned], [3, 1, -1]);
});
