import assert from "node:assert/strict";
import { test } from "node:test";
import { aside, crosses, distance, overlap, unbroken } from "../../planmethod/render/live/script/geometry.js";

test("the distance to a segment is that to its nearest point, its ends included", () => {
  assert.equal(distance([1, 1], [[0, 0], [2, 0]]), 1);
  assert.equal(distance([5, 4], [[0, 0], [2, 0]]), 5);
  assert.equal(distance([3, 4], [[0, 0], [0, 0]]), 5);
});

test("a segment crosses a box exactly if a point of it is inside", () => {
  let seen = 0;
  for (let k = 0; k < 400; k++) {  // a spiral of segments, no chance in it
    const a = [3 * Math.cos(k), 3 * Math.sin(2.1 * k)], b = [2 * Math.sin(1.7 * k), 2 * Math.cos(0.3 * k)];
    const inside = Array.from({ length: 2001 }, (_, n) => n / 2000).some(t =>
      Math.abs(a[0] + (b[0] - a[0]) * t) < 0.998 && Math.abs(a[1] + (b[1] - a[1]) * t) < 0.998);
    if (inside) { assert.ok(crosses([-1, -1, 1, 1], [a, b]), `${a} ${b}`); seen++; }
    if (!crosses([-1, -1, 1, 1], [a, b])) assert.ok(!inside);
  }
  assert.ok(seen > 100 && seen < 390);
});

test("segments on one line are drawn beside one another", () => {
  const first = aside([[0, 0], [10, 0]], []), second = aside([[2, 0], [8, 0]], [first]);
  assert.deepEqual(first, [[0, 0], [10, 0]]);
  assert.equal(Math.abs(second[0][1]), 1.7);
});

test("boxes share no area beside one another", () => {
  assert.equal(overlap([0, 0, 2, 2], [1, 1, 3, 3]), 1);
  assert.equal(overlap([0, 0, 1, 1], [1, 0, 2, 1]), 0);
});

test("a line is broken where there is no place", () => {
  assert.deepEqual(unbroken([[0, 0], [1, 0], null, [2, 0], null, [3, 0], [4, 0]]), [[[0, 0], [1, 0]], [[3, 0], [4, 0]]]);
});
