// The outputs of the program's tape in every position of the driver.
import { branch, modulo, within } from "./numbers.js";

const TURN = 360, SAMPLES = 720;

/** Return how a scene moves: `at` gives all outputs in a position, the guard that fails, or -1, and the speed.
 * `run` and `loads` are the tapes. */
export function motion(scene, run, loads) {
  const [low, high] = scene.way, end = scene.rows.length;

  function steady(x) {  // speed of the crank in the steady motion of a machine
    const { omega, first, sense, cycle } = scene.motion, count = omega.length;
    const along = modulo(sense * (x - first), cycle) / cycle * count, k = Math.floor(along) % count;
    return omega[k] + (omega[(k + 1) % count] - omega[k]) * (along - Math.floor(along));
  }

  function driven(x) {  // place, rate and acceleration of the link that a cam's follower moves
    const { pieces, lowest, degrees, rate } = scene.cam, along = within(x, 0, TURN) * Math.PI / 180;
    const of = pieces.filter(piece => piece.start <= along + 1e-11).pop(), t = along - of.start;
    const turn = of.rate * t + of.phase, [s, v, a] = of.powers.reduceRight(
      ([p, d, dd], factor) => [p * t + factor, d * t + p, dd * t + 2 * d], [0, 0, 0]);
    const way = s + of.size * Math.sin(turn);
    return [lowest + (degrees ? way * 180 / Math.PI : way),
      (v + of.size * of.rate * Math.cos(turn)) * rate,
      (a - of.size * of.rate ** 2 * Math.sin(turn)) * rate ** 2];
  }

  function solved(x) {
    const sides = [...scene.cam ? driven(x) : [], ...scene.branches.map(one => branch(one, x))];
    if (!scene.loads) return run(x, ...sides);
    const still = run(x, ...sides, ...Array(scene.loads).fill(0));
    const told = loads(x, still), out = run(x, ...sides, ...told);
    if (told.some(Number.isNaN)) out[out.length - 1] = still[out.length - 1];
    return out;
  }

  const at = x => scene.motion ? [...solved(x), steady(x)] : solved(x);
  const sample = Array.from({ length: SAMPLES + 1 }, (_, k) => at(low + (high - low) * k / SAMPLES));

  function edge(x, step) {  // the last position before a gap, seen from inside it
    let inside = x, out = x, n = 0;
    for (; n < SAMPLES && at(out)[end] >= 0; n++) { inside = out; out += step; }
    if (n === SAMPLES || (!scene.crank && (out < low || out > high))) return null;
    for (let k = 0; k < 50; k++) {
      const half = (inside + out) / 2;
      if (at(half)[end] >= 0) inside = half; else out = half;
    }
    return scene.crank ? modulo(out, high) : out;
  }

  return {
    at, sample, low, high, end,
    place: k => low + (high - low) * k / SAMPLES,  // of the driver in a sample
    peak: Array.from(sample[0], (_, k) => Math.max(0, ...sample.map(o => Math.abs(o[k]) || 0))),
    exists: out => scene.places.every(k => Number.isFinite(out[k])),
    edges: x => [-1, 1].map(sense => edge(x, sense * (high - low) / SAMPLES)).filter(v => v !== null),
  };
}
