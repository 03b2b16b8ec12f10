// Numbers: sides of closings by the driver's position, and how values are written. No document is needed here.

/** @typedef {{ places?: number[], values?: number[], jumps?: number[], counts?: number[], low?: number, net?: number,
 *   changes?: number[], start?: number, turn?: number }} Closing */

const SLACK = 1e-9;

/** @type {(x: number, turn: number) => number} */
export const modulo = (x, turn) => ((x % turn) + turn) % turn;

/** @type {(x: number, start: number, turn: number) => number} */
export function within(x, start, turn) {  // angle from a start, [0, turn)
  const turned = modulo(x - start, turn);
  return turned > turn - SLACK ? 0 : turned;
}

/** @type {(one: Closing, x: number) => number} */
export function branch(one, x) {  // which side of its line a closing is on, or near what a link is held
  if (one.places) return followed(one, x);
  if (one.counts) return counted(one, x);
  const passed = one.changes.reduce((n, change) =>
    n + Math.floor((x - change) / one.turn) - Math.floor((one.start - change) / one.turn), 0);
  return passed % 2 === 0 ? 1 : -1;
}

/** @type {(one: Closing, x: number) => number} */
function counted(one, x) {  // degrees of whole turns, added to an angle that is read
  const whole = one.turn ? Math.floor((x - one.low) / one.turn) : 0, here = x - whole * one.turn;
  const passed = one.jumps.filter(jump => jump <= here).length;
  return 360 * (one.counts[passed] + whole * one.net);
}

/** @type {(one: Closing, x: number) => number} */
function followed(one, x) {  // between two positions that an assembly was followed through
  const { places, values } = one, low = places[0];
  if (one.turn) x = low + within(x, low, one.turn);
  const k = Math.min(places.findIndex(place => place > x) >>> 0, places.length - 1);
  const share = (x - places[k - 1]) / (places[k] - places[k - 1]);
  return x < low || x > places[places.length - 1] ? NaN
    : values[k - 1] + share * (values[k] - values[k - 1]);
}

let mark = ".";  // of decimals
/** @type {(own: string) => void} */
export const decimals = own => { mark = own; };

/** @type {(value: number, digits: number, largest?: number) => string} */
export function said(value, digits, largest = 0) {
  if (!Number.isFinite(value)) return "—";
  if (Math.abs(value) <= 1e-12 * largest) return "0";
  const [head, power] = value.toPrecision(digits).split("e");
  return (power ? head + "·10^" + +power : head).replaceAll("-", "−").replace(".", mark);
}

/** @type {(value: number, digits: number) => string} */
export const short = (value, digits) =>  // without the zeros at the end
  said(value, digits).replace(/([.,]\d*?)0+$/, "$1").replace(/[.,]$/, "");

/** @type {(low: number, high: number, count: number) => number[]} */
export function ticks(low, high, count) {
  const raw = (high - low) / count, power = 10 ** Math.floor(Math.log10(raw));
  const step = power * [1, 2, 2.5, 5, 10].find(m => m * power >= raw * 0.999);
  const found = [];
  for (let k = Math.ceil(low / step - 1e-9); k <= high / step + 1e-9; k++) found.push(k * step || 0);
  return found;
}
