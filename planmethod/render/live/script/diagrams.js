// Numbers and diagrams of the quantities of a scene.
import { path, unbroken } from "./geometry.js";
import { said, short, ticks } from "./numbers.js";
import { byId, rich, shape } from "./svg.js";

const WIDE = 360, TALL = 120, PAD = [46, 10, 10, 18];  // px of a diagram: left, right, top, bottom
const DIGIT = 6.4;  // px: the widest figure of a tick

function valued(q, out) {
  return q.vector ? Math.hypot(out[q.rows[0]], out[q.rows[1]]) : out[q.rows[0]];
}

/** Let every quantity have its cells and the button that opens its diagram; `show` goes to a position, `again` draws anew. */
export function quantities(scene, moves, show, again) {
  for (const [k, q] of scene.quantities.entries()) {
    q.cells = q.rows.map(row => byId("cell-" + row)).filter(Boolean);
    q.size = byId("size-" + k);
    q.button = byId("choose-" + k);
    q.largest = largest(q, moves);
    q.moves = q.rows.some(row => moves.sample.some(out => Math.abs(out[row] - moves.sample[0][row]) > 1e-9 * q.largest));
    if (!q.button) continue;
    q.button.addEventListener("click", () => {
      const chosen = q.button.getAttribute("aria-pressed") !== "true";
      q.button.setAttribute("aria-pressed", chosen);
      if (chosen) plot(q, scene, moves, show); else { q.plot.remove(); q.plot = null; }
      again();
    });
    if (q.chosen) { q.button.setAttribute("aria-pressed", true); plot(q, scene, moves, show); }
  }
}

const largest = (q, moves) => Math.max(...q.rows.map(row => moves.peak[row]));

/** Draw the diagrams of other motions of the same scene. */
export function plotAgain(scene, moves, show) {
  for (const q of scene.quantities) {
    q.largest = largest(q, moves);
    if (!q.plot) continue;
    const old = q.plot;
    plot(q, scene, moves, show);
    old.replaceWith(q.plot);
  }
}

function plot(q, scene, moves, show) {
  const first = moves.low, last = moves.high;
  const figure = q.plot = byId("diagrams").appendChild(document.createElement("figure"));
  q.caption = figure.appendChild(document.createElement("figcaption"));
  const svg = shape(figure, "svg");
  svg.setAttribute("role", "img");
  svg.setAttribute("aria-label", q.symbol.map(part => part[0]).join(""));
  svg.setAttribute("viewBox", `0 0 ${WIDE} ${TALL}`);
  const values = moves.sample.map(out => valued(q, out)), real = values.filter(Number.isFinite);
  const sizes = real.map(Math.abs).sort((a, b) => a - b);
  const most = Math.min(sizes[sizes.length - 1] || 0, 50 * (sizes[sizes.length >> 1] || 1e300));
  const zero = q.steady ? [] : [0];  // a speed that hardly changes is looked at closely
  let low = Math.max(-most, Math.min(...zero, ...real)), high = Math.min(most, Math.max(...zero, ...real));
  if (!(high - low > 1e-12 * q.largest)) [low, high] = [low - 1, high + 1];
  const numerals = /** @type {[number, string][]} */ (ticks(low, high, 4).map(value => [value, short(+value.toPrecision(6), 6)]));
  const left = Math.max(PAD[0], 8 + DIGIT * Math.max(...numerals.map(one => one[1].length)));
  q.x = value => left + (value - first) / (last - first) * (WIDE - left - PAD[1]);
  const tall = TALL - PAD[2] - PAD[3];
  q.y = value => TALL - PAD[3] - Math.min(9, Math.max(-9, (value - low) / (high - low))) * tall;
  const text = (x, y, told, anchor) => {
    const node = shape(svg, "text", "tick");
    node.setAttribute("x", x); node.setAttribute("y", y); node.setAttribute("text-anchor", anchor);
    node.textContent = told;
  };
  const rule = (points, cls) => shape(svg, "path", cls).setAttribute("d", path(points));
  for (const [value, told] of numerals) {
    rule([[left, q.y(value)], [WIDE - PAD[1], q.y(value)]], value ? "grid" : "axis");
    text(left - 4, q.y(value) + 3.5, told, "end");
  }
  const across = scene.crank ? [0, 1, 2, 3, 4].map(k => k * last / 4) : ticks(first, last, 5);
  for (const value of across) {
    rule([[q.x(value), PAD[2]], [q.x(value), TALL - PAD[3]]], "grid");
    text(q.x(value), TALL - 5, short(+value.toPrecision(4), 4), "middle");
  }
  const parts = unbroken(values.map((value, k) => Number.isFinite(value) ? [q.x(moves.place(k)), q.y(value)] : null));
  const inner = shape(svg, "svg", "");  // cuts off what a dead position throws out of the picture
  inner.setAttribute("viewBox", `0 ${PAD[2] - 1} ${WIDE} ${tall + 2}`);
  inner.setAttribute("y", PAD[2] - 1);
  inner.setAttribute("height", tall + 2);
  shape(inner, "path", "curve").setAttribute("d", parts.map(path).join(""));
  q.mark = shape(svg, "path", "mark");
  q.dot = shape(svg, "circle", "dot");
  q.dot.setAttribute("r", 3.2);
  svg.addEventListener("pointerdown", event => {
    const p = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
    show(Math.min(last, Math.max(first, first + (p.x - left) / (WIDE - left - PAD[1]) * (last - first))));
  });
}

/** Write the numbers of a position, and mark it in the diagrams. */
export function fill(scene, out, position) {
  const told = (value, digits, most) => scene.hides ? "?" : said(value, digits, most);
  for (const q of scene.quantities) {
    for (const cell of q.cells) {
      const value = out[+cell.dataset.row];
      cell.dataset.value = value;
      cell.textContent = told(value, 8, q.largest);
    }
    const value = valued(q, out);
    if (q.size) { q.size.dataset.value = value; q.size.textContent = told(value, 8, q.largest); }
    if (!q.plot) continue;
    rich(q.caption, q.symbol, ` = ${told(value, 5, q.largest)} `, q.unit);
    q.mark.setAttribute("d", path([[q.x(position), PAD[2]], [q.x(position), TALL - PAD[3]]]));
    const there = q.y(value) >= PAD[2] - 2 && q.y(value) <= TALL - PAD[3] + 2;
    q.dot.setAttribute("visibility", there ? "visible" : "hidden");
    if (there) { q.dot.setAttribute("cx", q.x(position)); q.dot.setAttribute("cy", q.y(value)); }
  }
}
