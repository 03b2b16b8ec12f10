// The page of a moving mechanism. `run` and `loads`, written before this, are the program's own tapes; here is only
// where their numbers are drawn. Everything is in millimetres of a view, y down.
import { drawCentres, prepareCentres } from "./centres.js";
import { fill, quantities } from "./diagrams.js";
import { point } from "./geometry.js";
import { motion } from "./motion.js";
import { decimals, modulo, said } from "./numbers.js";
import { byId, rich } from "./svg.js";
import { draw, prepare, traced } from "./views.js";

const D = JSON.parse(byId("scene").textContent);
decimals(D.words.decimal);
const moves = motion(D, run, typeof loads === "undefined" ? null : loads), { at, exists, low: LOW, high: HIGH, end: END } = moves;
for (const view of D.views) prepare(view, { words: D.words, peak: moves.peak });
const traces = traced(D.views[0], moves);

function warn(out) {  // where there is no position
  const why = byId("why"), failed = out[END] >= 0;
  const lost = !failed && D.forces.some(k => Number.isNaN(out[k]));
  why.hidden = !failed && !lost;
  if (lost) rich(why, D.words.unknown);
  if (!failed) return;
  const told = moves.edges(position).map(v => D.symbol.map(part => part[0]).join("") + " = " + said(v, 6) + D.unit);
  rich(why, D.reasons[out[END]], told.length ? ` ${D.words.nearest} ${told.join("; ")}.` : "");
}

if (D.views[0].centres) {
  const view = D.views[0], isOn = byId("centres");
  prepareCentres(view);
  view.mark = out => drawCentres(view, centres(0, out), isOn.checked);
  isOn.addEventListener("change", () => show(position));
}

// The driver --------------------------------------------------------------------------------------

let position = D.start, now = at(position), playing = 0, sense = D.sense;
const slider = byId("slider"), exact = byId("exact"), play = byId("play");

function show(x) {
  position = x;
  now = at(x);
  slider.value = x;
  if (document.activeElement !== exact) exact.value = +x.toPrecision(8);
  if (exists(now)) for (const one of D.parts) {
    const [px, py] = point(D.views[0], now, one.at, 1);
    byId(one.id).setAttribute("transform",
      `translate(${px.toFixed(4)} ${py.toFixed(4)}) rotate(${(-now[one.turn]).toFixed(5)})`);
  }
  if (exists(now)) for (const one of D.springs) {
    const [[ax, ay], [bx, by]] = one.ends.map(end => end.at ?
      point(D.views[0], end.at, [0], 1) : point(D.views[0], now, end.ref, 1));
    const turn = Math.atan2(by - ay, bx - ax) * 180 / Math.PI;
    const times = Math.hypot(bx - ax, by - ay) / one.length;
    byId(one.id).setAttribute("transform", `translate(${ax.toFixed(4)} ${ay.toFixed(4)}) ` +
      `rotate(${turn.toFixed(5)}) scale(${times.toFixed(6)} 1)`);
  }
  for (const view of D.views) if (!playing || view.seen) draw(view, now);
  fill(D, now, position);
  warn(now);
}

function tick(time) {
  if (!playing) return;
  const speed = +byId("speed").value, whole = HIGH - LOW;
  const follows = D.motion && byId("follows").checked ? now[END + 1] / D.motion.mean : 1;
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
byId("trace").addEventListener("change", event => {
  for (const node of traces) node.setAttribute("visibility", event.target.checked ? "visible" : "hidden");
});

quantities(D, moves, show, () => show(position));
globalThis.planmethod = {
  at: x => Object.fromEntries(at(x).slice(0, END).map((value, k) => [D.rows[k], value])), show,
};
const watch = new IntersectionObserver(changes => {  // what nobody sees is not drawn while it moves
  for (const one of changes) D.views.find(view => view.svg === one.target).seen = one.isIntersecting;
});
for (const view of D.views) watch.observe(view.svg);
show(D.start);
