import assert from "node:assert/strict";
import { test } from "node:test";
import { branch, decimals, modulo, said, short, ticks, within } from "../../planmethod/render/live/script/numbers.js";

test("an angle is in one turn from its start, also after rounding at its end", () => {
  for (const x of [-725.5, -360, -1e-12, 0, 359.999999, 360, 1081.25]) {
    assert.ok(modulo(x, 360) >= 0 && modulo(x, 360) < 360);
    assert.ok(Math.abs((x - within(x, 20, 360) - 20) % 360) < 1e-8 || Math.abs(Math.abs((x - within(x, 20, 360) - 20) % 360) - 360) < 1e-8);
  }
  assert.equal(within(20 - 1e-11, 20, 360), 0);
});

test("a closing changes its side at every change, on the way there and back", () => {
  const one = { changes: [90, 270], start: 0, turn: 360 };
  assert.deepEqual([0, 100, 280, 460, 640, -100].map(x => branch(one, x)), [1, -1, 1, -1, 1, -1]);
});

test("a followed assembly is between its places, and nowhere beyond them", () => {
  const one = { places: [0, 10, 20], values: [1, 3, 7] };
  assert.deepEqual([0, 5, 15, 20].map(x => branch(one, x)), [1, 2, 5, 7]);
  assert.ok(Number.isNaN(branch(one, 20.1)) && Number.isNaN(branch(one, -1)));
});

test("values have the minus sign, the mark and the power of print", () => {
  assert.equal(said(-0.00125, 3), "−0.00125");
  assert.equal(said(-1.5e-9, 3), "−1.50·10^−9");
  assert.equal(said(1e-15, 3, 1), "0");
  assert.equal(said(NaN, 3), "—");
  assert.equal(short(2.5, 6), "2.5");
  assert.equal(short(100, 6), "100");
  decimals(",");
  assert.equal(said(2.5, 2), "2,5");
  assert.equal(short(2.50, 6), "2,5");
  decimals(".");
});

test("ticks are round, inside the range, and about as many as asked", () => {
  for (const [low, high] of [[0, 1], [-3.7, 12.2], [-5e5, 5e5], [0.001, 0.0013]]) {
    const found = ticks(low, high, 4), step = found[1] - found[0];
    assert.ok(found.length >= 2 && found.length <= 6, String(found));
    assert.ok(found[0] >= low - 1e-9 * step && found[found.length - 1] <= high + 1e-9 * step);
    const digit = step / 10 ** Math.floor(Math.log10(step) + 1e-9);
    assert.ok([1, 2, 2.5, 5].some(one => Math.abs(one - digit) < 1e-6), String(digit));
  }
});
