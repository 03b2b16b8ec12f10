// A view: the scheme, a plan, the lever. Its segments and inscriptions follow the outputs of the tape.
import { aside, distance, path, point, unbroken } from "./geometry.js";
import { label } from "./labels.js";
import { said, short } from "./numbers.js";
import { byId, rich, shape } from "./svg.js";

/** Make the elements of a view, and let its segments tell their values. */
export function prepare(view, { words, peak }) {
  Object.assign(view, { words, peak, svg: byId("svg-" + view.id), told: byId("told-" + view.id), zoom: byId("zoom-" + view.id) });
  const lines = view.svg.querySelector(".lines");
  for (const one of [...view.segments, ...view.pushes, ...view.turns]) {
    one.line = shape(lines, "path", "seg " + (one.style || "push"));
    if (one.arrow || !one.style) one.head = shape(lines, "path", "tip");
  }
  view.labels.forEach((one, k) => { one.node = byId("label-" + view.id + "-" + k); });
  view.bar = shape(lines, "path", "seg thin");
  const look = event => {
    const inside = view.svg.getScreenCTM().inverse();
    const p = new DOMPoint(event.clientX, event.clientY).matrixTransform(inside);
    const near = view.segments.map(one => one.symbol && one.ends && !one.covered ?
      distance([p.x, p.y], one.ends) : 1e9);
    const best = Math.min(...near);
    view.hot = best * view.svg.getScreenCTM().a < 22 ? near.indexOf(best) : -1;
    tell(view);
  };
  view.svg.addEventListener("pointermove", look);
  view.svg.addEventListener("pointerdown", look);
  view.svg.addEventListener("keydown", event => {  // arrows go from segment to segment
    const sense = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key], count = view.segments.length;
    if (!sense || !count) return;
    event.preventDefault();
    const start = view.hot >= 0 ? view.hot : sense > 0 ? -1 : count;
    for (let k = 1; k <= count; k++) {
      const next = ((start + sense * k) % count + count) % count, one = view.segments[next];
      if (!one.symbol || !one.ends || one.covered) continue;
      view.hot = next;
      break;
    }
    tell(view);
  });
}

/** Draw the ways of the points of a view; return their lines. */
export function traced(view, { sample, exists }) {
  return view.labels.filter(one => one.at).map(one => {
    const line = shape(view.svg.querySelector(".traces"), "path", "trace");
    const parts = unbroken(sample.map(out => exists(out) ? point(view, out, one.at, 1) : null));
    line.setAttribute("d", parts.map(path).join(""));
    return line;
  });
}

export function arrow(one, [a, b]) {  // a line with its head; shorter than two heads it gets a smaller one
  const dx = b[0] - a[0], dy = b[1] - a[1], span = Math.hypot(dx, dy), shown = span >= 0.3;
  one.ends = shown ? [a, b] : null;
  one.line.setAttribute("d", shown ? path([a, b]) : "");
  if (!one.head) return;
  const size = Math.min(4.4, span / 2), u = [dx / span, dy / span], w = size * 0.17;
  one.head.setAttribute("d", !shown ? "" : path([b, [b[0] - u[0] * size - u[1] * w,
    b[1] - u[1] * size + u[0] * w], [b[0] - u[0] * size + u[1] * w,
    b[1] - u[1] * size - u[0] * w]]) + "Z");
}

function circular(one, centre, sense) {  // a circular arrow; none where the sense is nothing
  /** @type {(degrees: number, radius: number) => [number, number]} */
  const turn = (degrees, radius) => [centre[0] + radius * Math.cos(degrees * Math.PI / 180),
    centre[1] - radius * Math.sin(degrees * Math.PI / 180)];
  const r = 5;
  one.shown = sense !== 0;
  const [from, to] = [turn(-60 * sense, r), turn(200 * sense, r)].map(p => p.map(v => v.toFixed(3)));
  one.line.setAttribute("d", sense ? `M${from}A${r} ${r} 0 1 ${sense > 0 ? 0 : 1} ${to}` : "");
  const tip = [turn(222 * sense, r), turn(194 * sense, r + 0.8), turn(194 * sense, r - 0.8)];
  one.head.setAttribute("d", sense ? path(tip) + "Z" : "");
}

function measure(view) {  // a round length of the picture, and what it is in its unit
  const [left, top, , height] = view.box, about = 30 * view.per_mm * view.times;
  const power = 10 ** Math.floor(Math.log10(about)), digit = [5, 2, 1].find(k => k * power <= about);
  const value = digit * power, x = left + 3, y = top + height - 3, end = x + value / view.per_mm / view.times;
  const marks = [x, end].map(at => [[at, y - 1.5], [at, y + 1.5]]);
  view.bar.setAttribute("d", [[[x, y], [end, y]], ...marks].map(path).join(""));
  rich(view.zoom, "├─┤ = " + short(value, Math.max(1, power.toString().length)) + " ", view.unit);
}

/** Draw a view in a position; at the scale of both if another position is held. */
export function draw(view, out, held = null) {
  view.now = out;
  const refs = [...view.segments.flatMap(one => [one.a, one.b]),
    ...view.labels.flatMap(one => one.at ? [one.at] : [])];
  const there = refs.every(ref => Number.isFinite(out[ref[0]] + out[ref[0] + 1]));
  view.svg.parentNode.classList.toggle("gone", !there);
  if (!there) { view.hot = -1; return; }
  const [left, top, width, height] = view.box;
  view.times = 1;
  if (view.zooms) {  // plans grow and shrink a hundredfold in a turn: each fills its box
    view.shift = [0, 0];
    const places = [out, ...held ? [held] : []].flatMap(all => refs.map(ref => point(view, all, ref, 1)))
      .filter(p => Number.isFinite(p[0] + p[1])), margin = view.pushes.length ? 22 : 13;
    const ends = k => [Math.min, Math.max].map(most => most(...places.map(p => p[k])));
    const [[x0, x1], [y0, y1]] = [ends(0), ends(1)];
    const needed = Math.max((x1 - x0) / (width - 2 * margin), (y1 - y0) / (height - 2 * margin));
    view.times = needed > 1e-8 ? needed : 1;
    view.shift = [left + width / 2 - (x0 + x1) / 2 / view.times,
      top + height / 2 - (y0 + y1) / 2 / view.times];
  }
  measure(view);
  const drawn = [];
  for (const one of view.segments) one.covered = false;
  for (const one of view.segments) {
    let ends = /** @type {import('./geometry.js').Ends} */ ([point(view, out, one.a, view.times), point(view, out, one.b, view.times)]);
    const same = k => view.segments.find(other => one.beside && !other.beside && other.ends &&
      [0, 1].every(j => Math.hypot(other.exact[j ^ k][0] - ends[j][0],
        other.exact[j ^ k][1] - ends[j][1]) < 0.3));
    one.exact = ends;
    if (same(0)) same(0).covered = true;  // the whole is a component: it has the letter
    else if (same(1)) ends = [ends[0], ends[0]];
    else if (one.arrow) drawn.push(ends = aside(ends, drawn));
    arrow(one, ends);
  }
  const force = one => ["x", "y"].map((_, k) => out[one.head_at[0] + k] - out[one.tail[0] + k]);
  const largest = Math.max(...view.pushes.map(one => Math.hypot(...force(one))));
  for (const one of view.pushes) {
    const [fx, fy] = force(one), size = Math.hypot(fx, fy), a = point(view, out, one.at, view.times);
    const long = size > 1e-9 * largest ? (7 + 15 * size / largest) / size : 0;
    arrow(one, [a, [a[0] + fx * long, a[1] - fy * long]]);
  }
  for (const one of view.turns) {
    const [a, b] = one.on.map(ref => point(view, out, ref, view.times));
    const whole = Math.abs(out[one.couple]) > 1e-9 * view.peak[one.couple];
    one.centre = [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
    circular(one, one.centre, whole ? -Math.sign(out[one.couple] * out[one.omega]) : 0);
  }
  if (view.mark) view.mark(out);
  label(view, out);
  tell(view);
}

function tell(view) {  // the segment that is pointed at: its value, and mm at the scale of the sheet
  view.segments.forEach((one, k) => {
    for (const node of [one.line, one.head]) if (node) node.classList.toggle("hot", k === view.hot);
  });
  const one = view.segments[view.hot];
  if (!one) { view.told.textContent = view.hot === undefined ? view.words.touch : " "; return; }
  const [a, b] = [one.a, one.b].map(ref => [view.now[ref[0]], view.now[ref[0] + 1]]);
  const value = Math.hypot(b[0] - a[0], b[1] - a[1]);
  const parts = [one.symbol, ` = ${view.words.hides ? "?" : said(value, 5)} `, view.unit];
  if (!view.mu || view.words.hides) { rich(view.told, ...parts); return; }  // no sheet has it
  const mm = `${said(value / view.mu, 4)} ${view.words.mm}`;
  rich(view.told, ...parts, "; ", ...(one.name ? [one.name, ` = ${mm}`] : [mm]));
}
