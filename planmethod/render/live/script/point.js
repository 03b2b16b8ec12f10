// The page of a moving point: its vectors on the trajectory, and the hodographs that their ends draw. Its numbers are rows
// of even moments, between which they are interpolated. Millimetres of a view, y down.
import { driving } from "./driver.js";
import { label } from "./labels.js";
import { placeMarks } from "./marks.js";
import { decimals, said } from "./numbers.js";
import { byId, rich, shape } from "./svg.js";
import { arrow } from "./views.js";

const D = JSON.parse(byId("scene").textContent);
decimals(D.words.decimal);
const [FIRST, LAST] = D.ends, column = Object.fromEntries(D.columns.map((name, k) => [name, k]));
const largest = D.columns.map((_, k) => Math.max(0, ...D.rows.map(row => Math.abs(row[k]) || 0)));
const LEAST = 0.7, CURVED = [3, 300];  // mm: of a vector; radii of circles of curvature

/** Values of a moment; NaN beside one that does not exist. */
function at(t) {
  const along = (t - FIRST) / (LAST - FIRST) * (D.rows.length - 1), k = Math.min(D.rows.length - 2, Math.max(0, Math.floor(along)));
  const whole = Math.abs(along - Math.round(along)) < 1e-9, [a, b] = whole ? Array(2).fill(D.rows[Math.round(along)]) : [D.rows[k], D.rows[k + 1]];
  return D.columns.map((_, n) => a[n] === null || b[n] === null ? NaN : a[n] + (along - k) * (whole ? 0 : b[n] - a[n]));
}

/** Vectors of a moment, SI: velocity, acceleration and its parts along the velocity and across it. */
function vectors(row) {
  const value = name => row[column[name]];
  const v = [value("vx"), value("vy")], a = [value("ax"), value("ay")], speed = Math.hypot(...v);
  const along = v.map(part => part / speed * value("a_tangential"));
  return { v, a, at: along, an: a.map((part, k) => part - along[k]) };
}

for (const view of D.views) {
  view.svg = byId("svg-" + view.id);
  const lines = view.svg.querySelector(".lines");
  for (const one of view.arrows) {
    one.line = shape(lines, "path", "seg " + one.style);
    one.head = shape(lines, "path", "tip");
  }
  for (const one of view.labels) one.node = byId(`label-${view.id}-${one.letter}`);
  Object.assign(view, { segments: view.arrows, pushes: [], turns: [], fixed: [], supports: [], rods: [], blocks: [] });
  view.dot = shape(lines, "circle", "dot");
  view.dot.setAttribute("r", "1.3");
  if (view.id === "path") for (const [name, kind, cls] of [["bow", "circle", "seg thin"], ["radius", "path", "seg thin"],
    ["wheel", "circle", "seg thin"], ["spoke", "path", "seg thin"], ["touch", "circle", "tip"]]) view[name] = shape(lines, kind, cls);
}

/** @type {(node: any, place: number[], r: number) => void} */
const circle = (node, [x, y], r) => {
  const there = Number.isFinite(x + y + r);
  node.setAttribute("visibility", there ? "visible" : "hidden");
  if (there) for (const [key, value] of Object.entries({ cx: x, cy: y, r })) node.setAttribute(key, value.toFixed(3));
};

/** Where a letter is, if it is there, and the direction in which it is looked for first.
 * @type {(view: any, letter: string, place: number[], way?: number[]) => void} */
function put(view, letter, [x, y], [dx, dy] = [0, 0]) {
  const one = view.labels.find(label => label.letter === letter), [left, top, wide, high] = view.box;
  one.place = x > left && y > top && x < left + wide && y < top + high ? [x, y] : null;
  if (dx || dy) one.angle = Math.atan2(dy, dx);
}

function show(t) {
  const row = at(t), all = vectors(row), value = name => row[column[name]];
  for (const view of D.views) {
    const per = view.per_mm, place = view.id === "path" ? [value("x") / per, -value("y") / per] :
      view.id === "v" ? [value("vx") / per, -value("vy") / per] : [value("ax") / per, -value("ay") / per];
    const [x, y] = place;
    circle(view.dot, place, 1.3);
    view.svg.parentNode.classList.toggle("gone", !Number.isFinite(x + y));
    for (const one of view.arrows) {
      const tail = one.pole ? [0, 0] : one.from === "at" ? [all.at[0] / per, -all.at[1] / per] : place;
      const [dx, dy] = [all[one.of][0] / one.per_mm, -all[one.of][1] / one.per_mm], head = [tail[0] + dx, tail[1] + dy];
      const there = Number.isFinite(head[0] + head[1]) && Math.hypot(dx, dy) > LEAST;
      arrow(one, there ? [tail, head] : [[0, 0], [0, 0]]);
      put(view, one.of, there ? head : [NaN, NaN], [dx, dy]);
    }
    if (view.id === "path") around(view, all, place, value); else put(view, view.pole, [0, 0]);
    label(view, row);
  }
  for (const [k, name] of D.columns.entries()) {
    const cell = byId("cell-" + name);
    cell.dataset.value = row[k];
    cell.textContent = said(row[k], 5, largest[k]);
  }
}

/** The circle of curvature, and the wheel that carries the point.
 * @type {(view: any, all: any, place: number[], value: (name: string) => number) => void} */
function around(view, all, [x, y], value) {
  const per = view.per_mm;
  put(view, "M", [x, y], [-all.v[0], all.v[1]]);
  const rho = value("rho") / per, across = Math.hypot(...all.an), bent = rho > CURVED[0] && rho < CURVED[1] && across > 0;
  const centre = bent ? [x + all.an[0] / across * rho, y - all.an[1] / across * rho] : [NaN, NaN];
  circle(view.bow, centre, rho);
  view.radius.setAttribute("d", bent ? `M${x} ${y}L${centre}` : "");
  put(view, "K", centre, [centre[0] - x, centre[1] - y]);
  if (!D.wheel) return;
  const [c, p] = ["C", "P"].map(of => [value("x" + of) / per, -value("y" + of) / per]);
  circle(view.wheel, c, D.wheel / per);
  circle(view.touch, p, 1);
  view.spoke.setAttribute("d", Number.isFinite(c[0] + x) ? `M${c}L${x} ${y}` : "");
  put(view, "C", c);
  put(view, "P", p, [0, 1]);
}

const bar = driving({ ends: D.ends, rate: () => (LAST - FIRST) / 8, told: t => `t = ${said(t, 5)} ${D.words.s}`, show, words: D.words });
placeMarks(byId("marks"), D.ends, t => { bar.stop(); bar.go(t); });
globalThis.planmethod = { at: t => Object.fromEntries(at(t).map((value, k) => [D.columns[k], value])), show: bar.go, vectors };
for (const one of D.words.symbols) rich(byId("name-" + one[0]), one[1]);
bar.go(D.start);
