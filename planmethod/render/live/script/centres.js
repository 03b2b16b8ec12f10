// Instant centres of a scheme and Kennedy's lines, while their switch is on.
import { path } from "./geometry.js";
import { shape } from "./svg.js";

/** @typedef {[number, number, number]} Homogeneous x, y, w: at infinity where w is 0 */

/** @type {(a: Homogeneous, b: Homogeneous) => Homogeneous} */
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

/** @type {(a: Homogeneous, b: Homogeneous, box: number[]) => import('./geometry.js').Ends | null} */
export function chord(a, b, [x0, y0, x1, y1]) {  // the part of a line within a box: left, top, right, bottom
  const [p, q, r] = cross(a, b), size = 1e-6 * Math.hypot(...a) * Math.hypot(...b);
  if (!(Math.hypot(p, q, r) > size)) return null;
  const found = [x0, x1].map(x => [x, -(r + p * x) / q]).filter(([, y]) => y >= y0 && y <= y1);
  found.push(...[y0, y1].map(y => [-(r + q * y) / p, y]).filter(([x]) => x >= x0 && x <= x1));
  const far = found.find(([x, y]) => Math.hypot(x - found[0][0], y - found[0][1]) > 1e-6);
  return far ? /** @type {import('./geometry.js').Ends} */ ([found[0], far]) : null;
}

/** Make the lines and the dots of a scheme's centres. */
export function prepareCentres(view) {
  const group = shape(view.svg.querySelector(".lines"), "g", "centres");
  view.centres.strokes = view.centres.lines.map(() => shape(group, "path", "seg thin"));
  view.centres.dots = view.centres.marked.map(() => {
    const dot = shape(group, "circle", "tip");
    dot.setAttribute("r", "0.9");
    return dot;
  });
}

/** Place them by the numbers of the tape; those beyond the box, or all without the switch, are hidden. */
export function drawCentres(view, numbers, isOn) {
  const [left, top, width, height] = view.box, box = [left, top, left + width, top + height];
  const [ox, oy] = view.origin || [0, 0], mm = view.per_mm;
  const placed = Array.from({ length: numbers.length / 3 }, (_, k) => {
    const [x, y, w] = numbers.slice(3 * k, 3 * k + 3);
    return /** @type {Homogeneous} */ ([(x - ox * w) / mm, -(y - oy * w) / mm, w]);
  });
  view.centres.lines.forEach((three, k) => {
    const [one, two, far] = three.map(/** @param {number} number */ number => placed[number]);
    const apart = /** @type {(a: Homogeneous, b: Homogeneous) => number} */ (a, b) =>
      Math.hypot(...cross(a, b)) / (Math.hypot(...a) * Math.hypot(...b)) || 0;
    const sines = [apart(one, two), apart(one, far), apart(two, far)], best = sines.indexOf(Math.max(...sines));
    const ends = isOn ? chord(best < 2 ? one : two, best ? far : two, box) : null;
    view.centres.strokes[k].setAttribute("d", ends ? path(ends) : "");
  });
  view.centres.marked.forEach((number, k) => {
    const [x, y, w] = placed[number], at = [x / w, y / w];
    const there = isOn && at[0] >= box[0] && at[0] <= box[2] && at[1] >= box[1] && at[1] <= box[3];
    const dot = view.centres.dots[k];
    dot.setAttribute("visibility", there ? "visible" : "hidden");
    if (there) { dot.setAttribute("cx", at[0].toFixed(3)); dot.setAttribute("cy", at[1].toFixed(3)); }
    for (const one of view.labels) if (one.centre === number) one.place = there ? at : null;
  });
}
