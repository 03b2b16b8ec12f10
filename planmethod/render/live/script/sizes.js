// Numbers of a file that are changed on a page, and the inputs of the program's tape that follow from them.

/** @typedef {[number, number]} Place metres */
/** @typedef {{ name: string, label: string[][], key: (string | number)[], value: number, per: number, means: string[],
 *   moves: Record<string, any> }} Parameter */
/** @typedef {Record<string, number>} Numbers by the names of parameters */

const DEGREE = Math.PI / 180;
/** @type {(a: Place, b: Place) => number} */
export const apart = (a, b) => Math.hypot(b[0] - a[0], b[1] - a[1]);
/** @type {(a: Place, b: Place) => Place} */
export const way = (a, b) => [b[0] - a[0], b[1] - a[1]];
/** @type {(v: Place) => number} */
export const angle = ([x, y]) => Math.atan2(y, x) / DEGREE;
/** @type {(v: Place, degrees: number) => Place} */
export const rotated = ([x, y], degrees) => {
  const c = Math.cos(degrees * DEGREE), s = Math.sin(degrees * DEGREE);
  return [x * c - y * s, x * s + y * c];
};
/** @type {Place} */
export const ZERO = [0, 0];
/** @type {(a: Place, b: Place) => Place} */
const sum = (a, b) => [a[0] + b[0], a[1] + b[1]];
/** The direction of a line of a link in its own axes, or of its own axis.
 * @type {(points: Record<string, Place>, from: string, to: string) => number} */
export const axis = (points, from, to) => points[from] && points[to] ? angle(way(points[from], points[to])) : 0;

/** Return the numbers of a model of the server; see `numbers_of`.
 * @param {any} model */
export function sizing(model) {
  /** @type {Map<string, Parameter>} */
  const parameters = new Map(model.parameters.map(one => [one.name, one]));
  const links = Object.entries(model.links).filter(([link]) => link !== "0");
  const means = (kind, ...of) => model.parameters.find(one => one.means[0] === kind && of.every((word, k) => one.means[k + 1] === word));
  const length = (link, p, q) => means("length", link, p, q) || means("length", link, q, p);
  const change = (one, values) => one ? values[one.name] - one.value : 0;

  /** @type {() => Numbers} */
  const given = () => Object.fromEntries(model.parameters.map(one => [one.name, one.value]));

  /** Places of the points of a link in its own axes with some numbers.
   * @type {(link: string, values: Numbers) => Record<string, Place>} */
  function own(link, values) {
    const base = model.links[link], found = { ...base };
    for (const point of Object.keys(base)) {
      const [at, across] = ["at", "across"].map(kind => means(kind, link, point));
      const arm = means("arm angle", link, point), far = means("arm distance", link, point);
      const earlier = Object.keys(base).slice(0, Object.keys(base).indexOf(point));
      const sides = earlier.map(other => [other, length(link, point, other)]).filter(([, one]) => one);
      if (at || across) {
        const [, , , start, s, t] = (at || across).means, along = axis(base, s, t);
        const [u, v] = rotated(way(base[start] ?? ZERO, base[point]), -along);
        const [x, y] = rotated([u + change(at, values), v + change(across, values)], axis(found, s, t));
        found[point] = sum(found[start] ?? ZERO, [x, y]);
      } else if (arm || far) {
        const [, , , vertex, s, t] = (arm || far).means, r = way(base[vertex], base[point]);
        const size = apart([0, 0], r) + change(far, values);
        const heading = angle(r) + change(arm, values) + axis(found, s, t) - axis(base, s, t);
        const [x, y] = rotated([size, 0], heading);
        found[point] = [found[vertex][0] + x, found[vertex][1] + y];
      } else if (sides.length === 2) {
        const [[p, one], [q, two]] = sides, span = apart(found[p], found[q]), a = values[one.name], b = values[two.name];
        const along = (a * a - b * b + span * span) / (2 * span), high = Math.sqrt(Math.max(0, a * a - along * along));
        const left = Math.sign(rotated(way(base[p], base[point]), -angle(way(base[p], base[q])))[1]) || 1;
        const [x, y] = rotated([along, left * high], angle(way(found[p], found[q])));
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

  /** Values of the inputs of the tape that are the same in every position; `sides` are of groups: 1, or -1.
   * @type {(values: Numbers, sides?: Numbers) => number[]} */
  function free(values, sides = {}) {
    const bodies = {}, all = [];
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
          (Array.isArray(slope) ? slope : [slope]).forEach((s, k) => { place[k] += s * change(parameter, values); });
        }
        all.push(...place);
      }
    }
    return all;
  }

  /** A point and the direction of a guide of the frame, degrees.
   * @type {(slide: any, values: Numbers) => { through: Place, heading: number }} */
  function guide(slide, values) {
    const [x, y] = ["x", "y"].map(name => means("guide", slide.label, name) || (slide.through && means("fixed", slide.through, name)));
    return { through: [slide.base[0] + change(x, values), slide.base[1] + change(y, values)],
      heading: slide.angle + change(means("guide angle", slide.label), values) };
  }

  return { parameters, means, length, change, given, own, free, guide };
}
