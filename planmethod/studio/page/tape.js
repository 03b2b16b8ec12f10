// A program's tape as data, run without a source: the policy of the page lets no source be made.

const TURN = Math.PI / 180;
/** @type {[number, number]} */
const unit = [1, 0];

/** @type {(degrees: number) => [number, number]} */
function turned(degrees) {  // cosine and sine, exact at quadrants
  const quarter = Math.round(degrees / 90), rest = (degrees - 90 * quarter) * TURN, c = Math.cos(rest), s = Math.sin(rest);
  switch (((quarter % 4) + 4) % 4) {
    case 0: unit[0] = c; unit[1] = s; break;
    case 1: unit[0] = -s; unit[1] = c; break;
    case 2: unit[0] = -c; unit[1] = -s; break;
    case 3: unit[0] = s; unit[1] = -c; break;
    default: unit[0] = unit[1] = NaN;
  }
  return unit;
}

/** Return a function of the inputs. It gives the results, and last the number of the first guard that does not hold, or -1;
 * NaN for a result that depends on such a guard.
 * @param {{ inputs: number, constants: (number | null)[], kinds: number[], operands: number[], results: number[],
 *   guards: [number, number][], needs: number[][] }} tape
 * @returns {(given: ArrayLike<number>) => number[]} */
export function machine({ inputs, constants, kinds, operands, results, guards, needs }) {
  const first = inputs + constants.length, r = new Float64Array(first + kinds.length);
  constants.forEach((value, k) => { r[inputs + k] = value ?? NaN; });
  const kind = Uint8Array.from(kinds), from = Int32Array.from(operands);
  return given => {
    for (let k = 0; k < inputs; k++) r[k] = given[k];
    for (let k = 0; k < kind.length; k++) {
      const a = r[from[3 * k]], b = r[from[3 * k + 1]];
      let value = 0;
      switch (kind[k]) {
        case 0: value = a + b; break;
        case 1: value = a - b; break;
        case 2: value = a * b; break;
        case 3: value = a / b; break;
        case 4: value = -a; break;
        case 5: value = Math.abs(a); break;
        case 6: value = Math.sqrt(a); break;
        case 7: value = Math.min(a, b); break;
        case 8: value = Math.max(a, b); break;
        case 9: value = Math.atan2(a, b); break;
        case 10: value = a <= -Math.PI ? 180 : a / TURN; break;
        case 11: value = a === 0 ? b : r[from[3 * k + 2]]; break;
        case 12: value = a > b ? 1 : 0; break;
        case 13: value = Math.floor(a); break;
        case 14: value = turned(a)[0]; break;
        default: value = turned(a)[1];
      }
      r[first + k] = value;
    }
    /** @type {Set<number>} */
    const bad = new Set();
    guards.forEach(([place, limit], k) => { if (!(r[place] > limit)) bad.add(k); });
    const out = results.map((place, k) => bad.size && needs[k].some(guard => bad.has(guard)) ? NaN : r[place]);
    out.push(bad.size ? Math.min(...bad) : -1);
    return out;
  };
}
