// A mechanism moved by hand: its pose by the program's tape, and which numbers of the file a joint that is pulled changes.
import { branch } from "./numbers.js";
import { machine } from "./tape.js";

/** @typedef {[number, number]} Place metres */
/** @typedef {{ name: string, label: string[][], key: (string | number)[], value: number, per: number, means: string[],
 *   moves: Record<string, any> }} Parameter */
/** @typedef {Record<string, number>} Numbers by the names of parameters */
/** @typedef {{ values: Numbers, sides: Numbers, x: number }} Sizes x: position of the driver */
/** @typedef {{ at: (point: string) => Place, out: number[], failed: number }} Pose failed: the guard, or -1 */

const DEGREE = Math.PI / 180;
/** @type {(a: Place, b: Place) => number} */
export const apart = (a, b) => Math.hypot(b[0] - a[0], b[1] - a[1]);
/** @type {(a: Place, b: Place) => Place} */
const way = (a, b) => [b[0] - a[0], b[1] - a[1]];
/** @type {(v: Place) => number} */
const angle = ([x, y]) => Math.atan2(y, x) / DEGREE;
/** @type {(v: Place, degrees: number) => Place} */
const turn = ([x, y], degrees) => {
  const c = Math.cos(degrees * DEGREE), s = Math.sin(degrees * DEGREE);
  return [x * c - y * s, x * s + y * c];
};
/** @type {(heading: number, far: number) => Place} */
export const toward = (heading, far) => turn([far, 0], heading);
/** @type {Place} */
const ZERO = [0, 0];
/** @type {(a: Place, b: Place) => Place} */
const sum = (a, b) => [a[0] + b[0], a[1] + b[1]];
/** The direction of a line of a link in its own axes, or of its own axis.
 * @type {(points: Record<string, Place>, from: string, to: string) => number} */
const axis = (points, from, to) => points[from] && points[to] ? angle(way(points[from], points[to])) : 0;
/** @type {(degrees: number) => number} */
export const signed = degrees => degrees - 360 * Math.round(degrees / 360);

/** Return the mechanism of a model of the server; see `drawn_model`.
 * @param {any} model */
export function mechanism(model) {
  const run = machine(model.tape), rows = new Map(model.rows.map((name, k) => [name, k]));
  /** @type {Map<string, Parameter>} */
  const parameters = new Map(model.parameters.map(one => [one.name, one]));
  const order = new Map(model.order.map((point, k) => [point, k]));
  const rank = point => order.get(point) ?? 1e9;
  const links = Object.entries(model.links).filter(([link]) => link !== "0");
  const means = (kind, ...of) => model.parameters.find(one => one.means[0] === kind && of.every((word, k) => one.means[k + 1] === word));
  const length = (link, p, q) => means("length", link, p, q) || means("length", link, q, p);

  /** @returns {Sizes} */
  const given = () => ({ values: Object.fromEntries(model.parameters.map(one => [one.name, one.value])), sides: {}, x: model.driver.first });

  /** Places of the points of a link in its own axes with some numbers.
   * @type {(link: string, values: Numbers) => Record<string, Place>} */
  function own(link, values) {
    const base = model.links[link], found = { ...base };
    const grown = parameter => values[parameter.name] - parameter.value;
    for (const point of Object.keys(base)) {
      const [at, across] = ["at", "across"].map(kind => means(kind, link, point));
      const arm = means("arm angle", link, point), far = means("arm distance", link, point);
      const earlier = Object.keys(base).slice(0, Object.keys(base).indexOf(point));
      const sides = earlier.map(other => [other, length(link, point, other)]).filter(([, one]) => one);
      if (at || across) {
        const [, , , start, s, t] = (at || across).means, along = axis(base, s, t);
        const [u, v] = turn(way(base[start] ?? ZERO, base[point]), -along);
        const [x, y] = turn([u + (at ? grown(at) : 0), v + (across ? grown(across) : 0)], axis(found, s, t));
        found[point] = sum(found[start] ?? ZERO, [x, y]);
      } else if (arm || far) {
        const [, , , vertex, s, t] = (arm || far).means, r = way(base[vertex], base[point]);
        const size = apart([0, 0], r) + (far ? grown(far) : 0);
        const heading = angle(r) + (arm ? grown(arm) : 0) + axis(found, s, t) - axis(base, s, t);
        const [x, y] = turn([size, 0], heading);
        found[point] = [found[vertex][0] + x, found[vertex][1] + y];
      } else if (sides.length === 2) {
        const [[p, one], [q, two]] = sides, span = apart(found[p], found[q]), a = values[one.name], b = values[two.name];
        const along = (a * a - b * b + span * span) / (2 * span), high = Math.sqrt(Math.max(0, a * a - along * along));
        const left = Math.sign(turn(way(base[p], base[point]), -angle(way(base[p], base[q])))[1]) || 1;
        const [x, y] = turn([along, left * high], angle(way(found[p], found[q])));
        found[point] = [found[p][0] + x, found[p][1] + y];
      } else if (sides.length === 1 && apart([0, 0], base[sides[0][0]]) < 1e-12) {
        const size = apart([0, 0], base[point]), times = size ? values[sides[0][1].name] / size : 1;
        found[point] = [base[point][0] * times, base[point][1] * times];
      }
    }
    return found;
  }

  const distances = new Map(model.inputs.map(({ name }) => {  // of two points of a link, which follow from other numbers
    if (!name.startsWith("l_") || parameters.has(name)) return [name, null];
    for (const [link, points] of links) {
      const pair = Object.keys(points).flatMap(p => Object.keys(points).map(q => [p, q])).find(([p, q]) => name === `l_${p}${q}`);
      if (pair) return [name, [link, ...pair]];
    }
    return [name, null];
  }));

  /** Values of all inputs of the tape.
   * @type {(sizes: Sizes) => number[]} */
  function inputs({ values, sides, x }) {
    const bodies = {}, all = [x];
    for (const one of model.inputs) {
      const pair = distances.get(one.name);
      if (one.side !== undefined) all.push(sides[one.side] ?? 1);
      else if (pair) {
        const body = bodies[pair[0]] ??= own(pair[0], values);
        all.push(apart(body[pair[1]], body[pair[2]]));
      } else {
        const place = Array.isArray(one.value) ? [...one.value] : [one.value];
        for (const parameter of model.parameters) {
          const slope = parameter.moves[one.name];
          if (slope === undefined) continue;
          const grown = values[parameter.name] - parameter.value;
          (Array.isArray(slope) ? slope : [slope]).forEach((s, k) => { place[k] += s * grown; });
        }
        all.push(...place);
      }
    }
    return [...all, ...model.branches.map(one => branch(one, x))];
  }

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
      const [bx, by] = turn(way(body[home], slot.base), facing), start = before.at(home);
      const base = /** @type {Place} */ ([start[0] + bx, start[1] + by]), along = facing + slot.angle;
      const [x, y] = turn([turn(way(base, to), -along)[0], slot.offset], along);
      return [base[0] + x, base[1] + y];
    }
    const slide = slideOf(point);
    if (!slide) return to;
    const { through, heading } = guide(slide, sizes.values), [u] = turn(way(through, to), -heading);
    const [x, y] = turn([u, slide.offset + change(means("slide offset", slide.slider), sizes.values)], heading);
    return [through[0] + x, through[1] + y];
  }

  const change = (one, values) => one ? values[one.name] - one.value : 0;

  /** @type {(slide: any, values: Numbers) => { through: Place, heading: number }} */
  function guide(slide, values) {
    const [x, y] = ["x", "y"].map(axis => means("guide", slide.label, axis) || (slide.through && means("fixed", slide.through, axis)));
    return { through: [slide.base[0] + change(x, values), slide.base[1] + change(y, values)],
      heading: slide.angle + change(means("guide angle", slide.label), values) };
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
        const [x, y] = turn(arm, -next.x);
        placed(driver, point, [body[pivot][0] + x, body[pivot][1] + y], body, put);
      }
      return next;
    }
    const slide = slideOf(point);
    const target = allowed(point, to, sizes, before);
    if (slide && model.driver.link === slide.slider && model.driver.coordinate === "s") {
      const { through, heading } = guide(slide, values);
      next.x = turn(way(through, target), -heading)[0];
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
      const [x, y] = turn(way(before.at(home), target), -before.out[rows.get(`${link}.phi_deg`)]);
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
      const [u, v] = turn(way(body[start] ?? ZERO, place), -axis(body, s, t));
      const [u0, v0] = turn(way(base[start] ?? ZERO, base[point]), -axis(base, s, t));
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
    const across = turn(way(through, to), -heading)[1];
    const round = value => step ? Math.round(value / step) * step : value;
    if (x && y && !locked.has(x.name) && !locked.has(y.name)) {
      const [dx, dy] = turn([0, across], heading);
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
