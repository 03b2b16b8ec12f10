// Inscriptions of a view: each where it covers the least, near where it was.
import { crosses, middle, overlap, point } from "./geometry.js";

export function label(view, out) {
  const [left, top, width, height] = view.box, placed = [];
  const bars = [...view.segments, ...view.pushes].filter(one => one.ends).map(one => one.ends);
  bars.push(...view.fixed);
  placed.push(...view.supports);
  for (const one of view.rods) {
    const [x, y] = point(view, out, one.at, 1), turn = out[one.turn] * Math.PI / 180;
    const [c, s] = [Math.cos(turn), Math.sin(turn)];
    const end = (a, b) => [x + a * c - b * s, y - a * s - b * c];
    for (const [a, b, u, v] of one.bars) bars.push([end(a, b), end(u, v)]);
  }
  const block = ([x, y], half) => placed.push([x - half, y - half, x + half, y + half]);
  for (const [ref, half] of view.blocks) block(point(view, out, ref, view.times), half);
  for (const one of view.turns) if (one.shown) block(one.centre, 5.5);
  for (const one of view.labels) {
    const owner = one.of !== undefined ? view.segments[one.of] : one.push !== undefined ?
      view.pushes[one.push] : one.turn !== undefined ? view.turns[one.turn] : null;
    const absent = one.centre !== undefined ? !one.place : owner && ((!owner.ends && !owner.shown) || owner.covered);
    one.node.setAttribute("visibility", absent ? "hidden" : "visible");
    if (absent) continue;
    const p = one.place ? one.place : one.at ? point(view, out, one.at, view.times) : one.on ?
      middle(one.on.map(ref => point(view, out, ref, view.times))) : one.turn !== undefined ?
      owner.centre : one.push !== undefined ? owner.ends[1] : middle(owner.ends);
    const high = one.up + one.down, gap = one.turn !== undefined ? 6.4 : one.gap;
    let best = null;
    for (let k = 0; k < 80; k++) {
      const angle = (k % 16) * Math.PI / 8, far = gap + 4 * (k >> 4);
      const x = p[0] + Math.cos(angle) * (far + one.width / 2);
      const y = p[1] + Math.sin(angle) * (far + high / 2);
      const [w, h] = [one.width / 2 + 0.8, high / 2 + 0.8], box = [x - w, y - h, x + w, y + h];
      let cost = 2 * (k >> 4);
      cost += one.angle === undefined ? 0 : 1.2 * (1 - Math.cos(angle - one.angle));
      for (const other of placed) cost += 1.5 * overlap(box, other);
      cost += 9 * (Math.max(0, left + 1 - box[0]) + Math.max(0, top + 1 - box[1]) +
        Math.max(0, box[2] - left - width + 1) + Math.max(0, box[3] - top - height + 1));
      for (const bar of bars) if ((!best || cost < best.cost) && crosses(box, bar)) cost += 14;
      if (!best || cost < best.cost) best = { cost, angle, box, x, y };
    }
    one.angle = best.angle;
    placed.push(best.box);
    const from = [best.x - one.width / 2, best.y - high / 2 + one.up].map(v => v.toFixed(3));
    one.node.setAttribute("transform", `translate(${from})`);
  }
}
