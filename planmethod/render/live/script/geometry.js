// Geometry of pictures, millimetres of a view, y down. No document is needed here.

/** @typedef {[number, number]} Point */
/** @typedef {[Point, Point]} Ends */
/** @typedef {number[]} Box left, top, right, bottom */

/** @type {(points: Point[]) => string} */
export const path = points => "M" + points.map(([x, y]) => x.toFixed(3) + " " + y.toFixed(3)).join("L");

/** @type {(view: any, out: number[], ref: number[], times: number) => Point} */
export function point(view, out, ref, times) {
  let x = out[ref[0]] - (view.origin ? view.origin[0] : 0);
  let y = out[ref[0] + 1] - (view.origin ? view.origin[1] : 0);
  if (ref[1]) [x, y] = [-y, x];
  const [right, down] = view.shift || [0, 0];
  return [x / view.per_mm / times + right, -y / view.per_mm / times + down];
}

/** @type {(place: Point, ends: Ends) => number} */
export function distance([x, y], [[ax, ay], [bx, by]]) {
  const dx = bx - ax, dy = by - ay, square = dx * dx + dy * dy;
  const t = square ? Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / square)) : 0;
  return Math.hypot(x - ax - t * dx, y - ay - t * dy);
}

/** @type {(ends: Ends) => Point} */
export const middle = ([a, b]) => [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];

/** @type {(ends: Ends, drawn: Ends[]) => Ends} */
export function aside(ends, drawn) {  // segments on one line are drawn beside one another
  const [[ax, ay], [bx, by]] = ends, long = Math.hypot(bx - ax, by - ay) || 1;
  const across = [-(by - ay) / long, (bx - ax) / long];
  for (const step of [0, 1, -1, 2, -2, 3, -3]) {
    const shifted = /** @type {Ends} */ (ends.map(([x, y]) => [x + 1.7 * step * across[0], y + 1.7 * step * across[1]]));
    const hides = /** @param {Ends} other */ other => {
      const [shorter, line] = long < Math.hypot(other[1][0] - other[0][0], other[1][1] - other[0][1]) ?
        [shifted, other] : [other, shifted];
      const at = /** @type {(k: number, j: number) => number} */ (k, j) => shorter[0][j] + (shorter[1][j] - shorter[0][j]) * k / 8;
      return [1, 2, 3, 4, 5, 6, 7].filter(k => distance([at(k, 0), at(k, 1)], line) < 0.3).length > 2;
    };
    if (!drawn.some(hides)) return shifted;
  }
  return ends;
}

/** @type {(a: Box, b: Box) => number} */
export const overlap = (a, b) => Math.max(0, Math.min(a[2], b[2]) - Math.max(a[0], b[0])) *
  Math.max(0, Math.min(a[3], b[3]) - Math.max(a[1], b[1]));

/** @type {(box: Box, ends: Ends) => boolean} */
export function crosses([x0, y0, x1, y1], [[ax, ay], [bx, by]]) {  // Liang and Barsky
  let from = 0, to = 1;
  for (const [p, q] of [[ax - bx, ax - x0], [bx - ax, x1 - ax], [ay - by, ay - y0], [by - ay, y1 - ay]]) {
    if (p === 0 && q < 0) return false;
    if (p < 0) from = Math.max(from, q / p);
    if (p > 0) to = Math.min(to, q / p);
  }
  return from <= to;
}

/** @type {(places: (Point | null)[]) => Point[][]} */
export function unbroken(places) {  // the runs of places that exist
  /** @type {Point[][]} */
  const runs = [[]];
  for (const place of places) if (place) runs[runs.length - 1].push(place); else runs.push([]);
  return runs.filter(run => run.length > 1);
}
