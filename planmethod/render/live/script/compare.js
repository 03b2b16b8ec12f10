// A position that is held, beside the current one: its lines in every view, and a table of differences.
import { path, point } from "./geometry.js";
import { said } from "./numbers.js";
import { byId, rich, shape } from "./svg.js";

/** Values of a quantity with their names: of a place both coordinates, of a vector its size.
 * @type {(q: any, out: number[]) => [string, number][]} */
export function spoken(q, out) {
  if (q.place) return [["x", out[q.rows[0]]], ["y", out[q.rows[1]]]];
  return [["", q.vector ? Math.hypot(out[q.rows[0]], out[q.rows[1]]) : out[q.rows[0]]]];
}

/** Draw the segments of a view in a position that is held, at the scale of the current one; none without it. */
export function drawGhost(view, held) {
  view.ghost ??= shape(view.svg.querySelector(".ghosts"), "path", "ghost");
  let lines = "";
  for (const one of held ? view.segments : []) {
    if (view.id === "lever" || (one.style === "thin" && view.id !== "scheme")) continue;
    const [a, b] = [one.a, one.b].map(ref => point(view, held, ref, view.times)), span = Math.hypot(b[0] - a[0], b[1] - a[1]);
    if (!(span > 0.3)) continue;
    lines += path([a, b]);
    if (!one.arrow) continue;
    const size = Math.min(3.6, span / 2) / span, [x, y] = [(b[0] - a[0]) * size, (b[1] - a[1]) * size];
    lines += [0.25, -0.25].map(k => path([b, [b[0] - x - k * y, b[1] - y + k * x]])).join("");
  }
  view.ghost.setAttribute("d", lines);
}

/** The difference of two values of a quantity; of angles within half a turn.
 * @type {(q: any, now: number, then: number) => number} */
export function difference(q, now, then) {
  const whole = now - then;
  return q.angle ? whole - 360 * Math.round(whole / 360) : whole;
}

/** Write the differences of two positions, `{ position, out }`; `place` writes where the driver is. */
export function compare(scene, now, held, place) {
  const moving = scene.quantities.filter(q => q.moves);
  const section = byId("compared");
  section.hidden = !held;
  if (!held) return;
  const heads = section.querySelectorAll("thead th");
  heads[1].textContent = place(held.position);
  heads[2].textContent = place(now.position);
  const body = section.querySelector("tbody");
  if (!body.children.length) {
    for (const q of moving) for (const [part] of spoken(q, now.out)) {
      const row = body.insertRow(), head = row.appendChild(document.createElement("th"));
      head.scope = "row";
      rich(head, q.symbol, part && `, ${part}`);
      for (let k = 0; k < 3; k++) row.insertCell();
      rich(row.insertCell(), q.unit);
    }
  }
  let k = 0;
  for (const q of moving) {
    const then = spoken(q, held.out);
    spoken(q, now.out).forEach(([, value], n) => {
      const cells = body.rows[k++].cells;
      [then[n][1], value, difference(q, value, then[n][1])].forEach((told, c) => {
        cells[c + 1].dataset.value = String(told);
        cells[c + 1].textContent = scene.hides ? "?" : said(told, 5, q.largest);
      });
    });
  }
}
