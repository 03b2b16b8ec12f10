// The page of a moving mechanism. `run` and `loads`, written before this, are the program's own tapes; here is only
// where their numbers are drawn. Everything is in millimetres of a view, y down.
import { drawCentres, prepareCentres } from "./centres.js";
import { compare, drawGhost, spoken } from "./compare.js";
import { fill, plotAgain, quantities } from "./diagrams.js";
import { point } from "./geometry.js";
import { tolerance, typed, verdict } from "./guess.js";
import { placeMarks } from "./marks.js";
import { motion } from "./motion.js";
import { decimals, modulo, said, short } from "./numbers.js";
import { sizing } from "./sizes.js";
import { fitted, skeleton } from "./skeleton.js";
import { byId, rich } from "./svg.js";
import { draw, prepare, traced } from "./views.js";

const D = JSON.parse(byId("scene").textContent);
decimals(D.words.decimal);
const numbers = D.sizes ? sizing(D.sizes) : null, scheme = D.views[0];
let values = numbers ? numbers.given() : {}, free = numbers ? numbers.free(values) : [], changed = false;
const ran = numbers ? (x, ...rest) => run(x, ...free, ...rest) : run;
const told = typeof loads === "undefined" ? null : (x, out) => changed ? Array(D.loads).fill(NaN) : loads(x, out);
const moves = motion(D, ran, told), { low: LOW, high: HIGH, end: END } = moves;
const at = x => moves.at(x), exists = out => moves.exists(out);
for (const view of D.views) prepare(view, { words: D.words, peak: moves.peak });
let traces = traced(scheme, moves);
const place = x => D.symbol.map(part => part[0]).join("") + " = " + said(x, 6) + D.unit;

function warn(out) {  // where there is no position
  const why = byId("why"), failed = out[END] >= 0;
  const lost = !failed && D.forces.some(k => Number.isNaN(out[k]));
  why.hidden = !failed && !lost;
  if (lost) rich(why, changed ? D.words.unknown_sizes : D.words.unknown);
  if (!failed) return;
  const near = moves.edges(position).map(place);
  rich(why, D.reasons[out[END]], near.length ? ` ${D.words.nearest} ${near.join("; ")}.` : "");
}

if (scheme.centres) {
  const isOn = byId("centres");
  prepareCentres(scheme);
  scheme.mark = out => drawCentres(scheme, centres(0, out), isOn.checked);
  isOn.addEventListener("change", () => show(position));
}

// The driver --------------------------------------------------------------------------------------

let position = D.start, now = at(position), playing = 0, sense = D.sense;
/** @type {{ position: number, out: number[] } | null} */
let held = null;
const slider = byId("slider"), exact = byId("exact"), play = byId("play");

function show(x) {
  position = x;
  now = at(x);
  slider.value = x;
  slider.setAttribute("aria-valuetext", place(+x.toFixed(3)));
  if (document.activeElement !== exact) exact.value = +x.toPrecision(8);
  if (exists(now)) for (const one of D.parts) {
    const [px, py] = point(scheme, now, one.at, 1);
    byId(one.id).setAttribute("transform",
      `translate(${px.toFixed(4)} ${py.toFixed(4)}) rotate(${(-now[one.turn]).toFixed(5)})`);
  }
  if (exists(now)) for (const one of D.springs) {
    const [[ax, ay], [bx, by]] = one.ends.map(end => end.at ?
      point(scheme, end.at, [0], 1) : point(scheme, now, end.ref, 1));
    const turn = Math.atan2(by - ay, bx - ax) * 180 / Math.PI;
    const times = Math.hypot(bx - ax, by - ay) / one.length;
    byId(one.id).setAttribute("transform", `translate(${ax.toFixed(4)} ${ay.toFixed(4)}) ` +
      `rotate(${turn.toFixed(5)}) scale(${times.toFixed(6)} 1)`);
  }
  if (changed && exists(now)) bones(now, values);
  for (const view of D.views) if (!playing || view.seen) {
    draw(view, now, held && held.out);
    drawGhost(view, held && held.out);
  }
  fill(D, now, position);
  compare(D, { position, out: now }, held, place);
  warn(now);
}

function tick(time) {
  if (!playing) return;
  const speed = +byId("speed").value, whole = HIGH - LOW;
  const follows = D.motion && byId("follows").checked ? now[END + 1] / D.motion.mean || 1 : 1;
  let next = position + sense * Math.min(0.1, (time - playing) / 1000) * speed * follows *
    (D.crank ? 360 : whole) / 8;
  playing = time;
  if (D.crank) next = modulo(next, HIGH);
  // It turns back where there is no way on.
  if (next < LOW || next > HIGH || (!exists(at(next)) && exists(now))) sense = -sense;
  else show(next);
  requestAnimationFrame(tick);
}

play.addEventListener("click", () => {
  playing = playing ? 0 : performance.now();
  play.textContent = playing ? "❚❚" : "▶";
  play.setAttribute("aria-label", playing ? D.words.pause : D.words.play);
  if (playing) requestAnimationFrame(tick); else show(position);
});
slider.addEventListener("input", () => show(+slider.value));
exact.addEventListener("input", () => {
  const x = parseFloat(exact.value);
  if (Number.isFinite(x)) show(D.crank ? modulo(x, HIGH) : Math.min(HIGH, Math.max(LOW, x)));
});
const showTraces = () => { for (const node of traces) node.setAttribute("visibility", byId("trace").checked ? "visible" : "hidden"); };
byId("trace").addEventListener("change", showTraces);
quantities(D, moves, show, () => show(position));
placeMarks(byId("marks"), [LOW, HIGH], x => { if (playing) play.click(); show(x); });

// A second position ------------------------------------------------------------------------------

byId("hold").addEventListener("click", () => {
  held = held ? null : { position, out: now };
  byId("hold").setAttribute("aria-pressed", String(Boolean(held)));
  show(position);
});

// Values that are measured before they are seen ---------------------------------------------------

function hide() {
  D.hides = D.words.hides = byId("hides").checked;
  byId("guess").hidden = !D.hides;
  byId("verdict").textContent = "";
  show(position);
}

function judge() {
  const k = +byId("guessed").value, q = D.quantities[k], [[, exact]] = spoken(q, now), box = byId("verdict");
  const measured = typed(byId("measured").value), allowed = changed ? NaN : tolerance(D.tolerances, k, position, exact);
  box.className = "";
  if (Number.isNaN(measured)) { box.textContent = D.words.no_number; return; }
  if (!Number.isFinite(exact)) { box.textContent = "—"; return; }
  if (Number.isNaN(allowed)) { box.textContent = D.words.no_tolerance; return; }
  const found = verdict(measured, exact, allowed, q.vector);
  box.className = found === "right" ? "right" : "wrong";
  const whole = found === "right" ? [` ${D.words.exactly} `, q.symbol, ` = ${said(exact, 5)} `, q.unit, "."] : [];
  rich(box, `${D.words[found]} ${D.words.tolerance} ±${said(allowed, 2)} `, q.unit, ".", ...whole);
}

byId("hides").addEventListener("change", hide);
byId("asked").addEventListener("submit", event => { event.preventDefault(); judge(); });
byId("guessed").addEventListener("change", () => {
  rich(byId("guess-unit"), D.quantities[+byId("guessed").value].unit);
  byId("verdict").textContent = "";
});

// Sizes that are changed --------------------------------------------------------------------------

const bones = numbers ? skeleton(scheme, D.sizes, D.rows, numbers) : () => {};
const fields = D.sizes ? D.sizes.sliders.map((one, k) => ({ ...one, slider: byId("size-slider-" + k), field: byId("size-field-" + k) })) : [];
const drawn = { per_mm: scheme.per_mm, box: scheme.box, rods: scheme.rods, fixed: scheme.fixed, supports: scheme.supports };

function resize() {  // all positions of the mechanism with the numbers of the sliders
  changed = fields.some(one => values[one.name] * one.per !== one.value);
  free = numbers.free(values);
  Object.assign(moves, motion(changed ? { ...D, motion: null } : D, ran, told));
  for (const view of D.views) view.peak = moves.peak;
  Object.assign(scheme, drawn, changed ? { rods: [], fixed: [], supports: [], ...fitted(scheme, moves.sample, exists) } : {});
  scheme.svg.setAttribute("viewBox", scheme.box.join(" "));
  scheme.svg.classList.toggle("changed", changed);
  for (const node of traces) node.remove();
  traces = traced(scheme, moves);
  showTraces();
  plotAgain(D, moves, show);
  byId("first-sizes").disabled = !changed;
  show(position);
}

let waiting = 0;
for (const one of fields) {
  const write = (from, to) => from.addEventListener("input", () => {
    const value = parseFloat(from.value);
    if (!Number.isFinite(value)) return;
    to.value = short(value, 6).replace(D.words.decimal, ".").replace("−", "-");
    values = { ...values, [one.name]: value / one.per };
    waiting ||= requestAnimationFrame(() => { waiting = 0; resize(); });
  });
  write(one.slider, one.field);
  write(one.field, one.slider);
}
byId("first-sizes")?.addEventListener("click", () => {
  values = numbers.given();
  for (const one of fields) for (const node of [one.slider, one.field]) node.value = +one.value.toPrecision(8);
  resize();
});

globalThis.planmethod = {
  at: x => Object.fromEntries(at(x).slice(0, END).map((value, k) => [D.rows[k], value])), show,
};
const watch = new IntersectionObserver(changes => {  // what nobody sees is not drawn while it moves
  for (const one of changes) D.views.find(view => view.svg === one.target).seen = one.isIntersecting;
});
for (const view of D.views) watch.observe(view.svg);
show(D.start);
