// A mechanism moved by hand: its pose by the program's tape, and which numbers of the file a joint that is pulled changes.
import { branch } from "./numbers.js";
import { ZERO, angle, apart, axis, rotated, sizing, way } from "./sizes.js";
import { machine } from "./tape.js";

export { apart } from "./sizes.js";

/** @typedef {import('./sizes.js').Place} Place */
/** @typedef {import('./sizes.js').Numbers} Numbers */
/** @typedef {{ values: Numbers, sides: Numbers, x: number }} Sizes x: position of the driver */
/** @typedef {{ at: (point: string) => Place, out: number[], failed: number }} Pose failed: the guard, or -1 */

/** @type {(heading: number, far: number) => Place} */
export const toward = (heading, far) => rotated([far, 0], heading);
/** @type {(degrees: number) => number} */
export const signed = degrees => degrees - 360 * Math.round(degrees / 360);

/** Return the mechanism of a model of the server; see `drawn_model`.
 * @param {any} model */
export function mechanism(model) {
  const run = machine(model.tape), rows = new Map(model.rows.map((name, k) => [name, k]));
  const { parameters, means, length, change, own, free, guide, ...numbers } = sizing(model);
  const order = new Map(model.order.map((point, k) => [point, k]));
  const rank = point => order.get(point) ?? 1e9;
  const links = Object.entries(model.links).filter(([link]) => link !== "0");
  /** @returns {Sizes} */
  const given = () => ({ values: numbers.given(), sides: {}, x: model.driver.first });

  /** Values of all inputs of the tape.
   * @type {(sizes: Sizes) => number[]} */
  const inputs = ({ values, sides, x }) => [x, ...free(values, sides), ...model.branches.map(one => branch(one, x))];

  /** @type {(sizes: Sizes) => Pose} */
  function pose(sizes) {
    const out = run(inputs(sizes));
    return { out, failed: out[out.length - 1], at: point => [out[rows.get(`${point}.x`)], out[rows.get(`${point}.y`)]] };
  }

  /** Places of points in many positions of the driver.
   * @type {(sizes: Sizes, points: string[], positions: number[]) => (Place | null)[][]} */
  function ways(sizes, points, positions) {
    const all = inputs(sizes), still = all.length - model.branches.length;
    const found = points.map(() => []);
    for (const x of positions) {
      all[0] = x;
      model.branches.forEach((one, k) => { all[still + k] = branch(one, x); });
      const out = run(all);
      points.forEach((point, k) => {
        const place = [out[rows.get(`${point}.x`)], out[rows.get(`${point}.y`)]];
        found[k].push(Number.isFinite(place[0] + place[1]) ? place : null);
      });
    }
    return found;
  }

  const slideOf = pin => model.slides.find(one => one.pin === pin && one.host === "0");

  /** Where a joint may be pulled to: on its guide, or on the slot of a link that is placed before it.
   * @type {(point: string, to: Place, sizes: Sizes, before: Pose) => Place} */
  function allowed(point, to, sizes, before) {
    const slot = model.slides.find(one => one.pin === point && one.host !== "0" &&
      Object.keys(model.links[one.host]).some(other => !model.links[0][other] && rank(other) < rank(point)));
    if (slot) {
      const facing = before.out[rows.get(`${slot.host}.phi_deg`)], body = own(slot.host, sizes.values), home = Object.keys(body)[0];
      const [bx, by] = rotated(way(body[home], slot.base), facing), start = before.at(home);
      const base = /** @type {Place} */ ([start[0] + bx, start[1] + by]), along = facing + slot.angle;
      const [x, y] = rotated([rotated(way(base, to), -along)[0], slot.offset], along);
      return [base[0] + x, base[1] + y];
    }
    const slide = slideOf(point);
    if (!slide) return to;
    const { through, heading } = guide(slide, sizes.values), [u] = rotated(way(through, to), -heading);
    const [x, y] = rotated([u, slide.offset + change(means("slide offset", slide.slider), sizes.values)], heading);
    return [through[0] + x, through[1] + y];
  }

  /** Return the numbers with which a point is where it was pulled to; null where none of them moves it.
   * @param {Sizes} sizes
   * @param {string} point
   * @param {Place} to
   * @param {{ step?: number, locked?: Set<string>, from?: Numbers }} how step: of lengths, metres; none: 0;
   *   from: points on a link keep the ratio in which they divided it with these numbers
   * @returns {Sizes | null} */
  function pulled(sizes, point, to, how = {}) {
    const next = drawn(sizes, point, to, how), { from, locked = new Set() } = how;
    if (!next || !from) return next;
    for (const one of model.parameters) {
      if (one.means[0] !== "length" || next.values[one.name] === from[one.name]) continue;
      const [, link, p, q] = one.means, times = next.values[one.name] / from[one.name];
      for (const other of model.parameters) {
        const [kind, of, third, , s, t] = other.means;
        if (kind !== "at" || of !== link || third === p || third === q || locked.has(other.name)) continue;
        if ((s === p && t === q) || (s === q && t === p)) next.values[other.name] = Math.round(from[other.name] * times * 1e5) / 1e5;
      }
    }
    return next;
  }

  /** @type {(sizes: Sizes, point: string, to: Place, how: { step?: number, locked?: Set<string> }) => Sizes | null} */
  function drawn(sizes, point, to, { step = 0, locked = new Set() }) {
    const before = pose(sizes), values = { ...sizes.values }, next = { ...sizes, values };
    let moved = false;
    const put = (one, value, round = step) => {
      if (!one || locked.has(one.name) || !Number.isFinite(value)) return;
      const told = round ? Math.round(value / round) * round : value;
      if (one.means[0] === "length" || one.means[0] === "arm distance") if (told < 1e-6) return;
      values[one.name] = told;
      moved = true;
    };
    const own_ = ["x", "y"].map(axis => means("fixed", point, axis));
    if (own_[0] || own_[1]) {
      put(own_[0], to[0]);
      put(own_[1], to[1]);
      return moved ? next : null;
    }
    const { link: driver, pivot } = model.driver;
    if (model.links[driver][point] && pivot && model.driver.coordinate === "phi") {
      const arm = way(before.at(pivot), to), body = own(driver, values), mine = way(body[pivot], body[point]);
      const x = signed(angle(arm) - angle(mine));
      next.x = step ? Math.round(x) : x;
      moved = true;
      put(length(driver, pivot, point), apart([0, 0], arm));
      if (!length(driver, pivot, point)) {
        const [x, y] = rotated(arm, -next.x);
        placed(driver, point, [body[pivot][0] + x, body[pivot][1] + y], body, put);
      }
      return next;
    }
    const slide = slideOf(point);
    const target = allowed(point, to, sizes, before);
    if (slide && model.driver.link === slide.slider && model.driver.coordinate === "s") {
      const { through, heading } = guide(slide, values);
      next.x = rotated(way(through, target), -heading)[0];
      return next;
    }
    for (const [link, points] of links) {
      if (!(point in points)) continue;
      const names = Object.keys(points);
      const known = names.filter(other => other !== point && rank(other) < rank(point));
      const direct = known.filter(other => length(link, point, other));
      for (const other of direct) put(length(link, point, other), apart(before.at(other), target));
      if (direct.length || !known.length) continue;  // what is placed after it follows
      const body = own(link, values), home = known[0];
      const [x, y] = rotated(way(before.at(home), target), -before.out[rows.get(`${link}.phi_deg`)]);
      placed(link, point, [body[home][0] + x, body[home][1] + y], body, put);
    }
    if (!moved) return null;
    const side = model.inputs.find(one => one.side === point);
    if (side) {
      const other = { ...next, sides: { ...next.sides, [point]: -(next.sides[point] ?? 1) } };
      const [here, there] = [next, other].map(one => apart(pose(one).at(point), target));
      if (there < here || (Number.isFinite(there) && !Number.isFinite(here))) return other;
    }
    return next;
  }

  /** Give a third point of a link its place in the link's own axes. */
  function placed(link, point, place, body, put) {
    const [at, across] = ["at", "across"].map(kind => means(kind, link, point));
    const arm = means("arm angle", link, point), far = means("arm distance", link, point), base = model.links[link];
    if (at || across) {
      const [, , , start, s, t] = (at || across).means;
      const [u, v] = rotated(way(body[start] ?? ZERO, place), -axis(body, s, t));
      const [u0, v0] = rotated(way(base[start] ?? ZERO, base[point]), -axis(base, s, t));
      if (at) put(at, u + at.value - u0);
      if (across) put(across, v + across.value - v0);
    } else if (arm || far) {
      const [, , , vertex, s, t] = (arm || far).means, r = way(body[vertex], place), r0 = way(base[vertex], base[point]);
      if (far) put(far, apart([0, 0], r));
      const grown = angle(r) - angle(r0) - axis(body, s, t) + axis(base, s, t);
      if (arm) put(arm, arm.value + signed(grown), 0.5);
    } else {
      for (const other of Object.keys(base)) {
        const one = other !== point && length(link, point, other);
        if (one) put(one, apart(body[other], place));
      }
    }
  }

  /** Return the numbers with which a guide goes through a place.
   * @type {(sizes: Sizes, label: string, to: Place, how: { step?: number, locked?: Set<string> }) => Sizes | null} */
  function shifted(sizes, label, to, { step = 0, locked = new Set() }) {
    const slide = model.slides.find(one => one.label === label && one.host === "0"), values = { ...sizes.values };
    const [x, y] = ["x", "y"].map(axis => means("guide", label, axis)), { through, heading } = guide(slide, values);
    const offset = means("slide offset", slide.slider);
    const across = rotated(way(through, to), -heading)[1];
    const round = value => step ? Math.round(value / step) * step : value;
    if (x && y && !locked.has(x.name) && !locked.has(y.name)) {
      const [dx, dy] = rotated([0, across], heading);
      values[x.name] = round(values[x.name] + dx);
      values[y.name] = round(values[y.name] + dy);
    } else if (offset && !locked.has(offset.name)) values[offset.name] = round(across);
    else {
      const own_ = means("guide angle", label);
      if (!own_ || locked.has(own_.name) || apart(through, to) < 1e-6) return null;
      const grown = signed(angle(way(through, to)) - heading), half = grown - 180 * Math.round(grown / 180);
      values[own_.name] = Math.round((values[own_.name] + half) * 2) / 2;
    }
    return { ...sizes, values };
  }

  return { model, given, pose, ways, pulled, shifted, own, parameters, guide, rank };
}
