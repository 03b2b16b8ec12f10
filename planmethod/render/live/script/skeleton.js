// The scheme with changed sizes: its parts are drawn for those of the file, so lines, joints, sliders and supports stand for them.
import { path, point } from "./geometry.js";
import { shape } from "./svg.js";

const ROOM = [105, 80], MARGIN = 17, SHAPE = 1.3, FAR = 400;  // mm: as in scene.py
const BLOCK = [4.5, 2.6], SUPPORT = 5;  // mm: half a slider; a support

/** The scale and the box in which a scheme is whole in all its positions.
 * @type {(view: any, sample: number[][], exists: (out: number[]) => boolean) => { per_mm: number, box: number[] }} */
export function fitted(view, sample, exists) {
  const refs = view.labels.filter(one => one.at).map(one => one.at), unit = { ...view, per_mm: 1, shift: null };
  const places = sample.filter(exists).flatMap(out => refs.map(ref => point(unit, out, ref, 1)));
  if (!places.length) return { per_mm: view.per_mm, box: view.box };
  const [[x0, x1], [y0, y1]] = [0, 1].map(k => [
    places.reduce((low, p) => Math.min(low, p[k]), Infinity), places.reduce((high, p) => Math.max(high, p[k]), -Infinity)]);
  const per_mm = Math.max((x1 - x0) / ROOM[0], (y1 - y0) / ROOM[1]) || view.per_mm;
  const wide = 2 * MARGIN + Math.max((x1 - x0) / per_mm, SHAPE * ((y1 - y0) / per_mm + 2 * MARGIN) - 2 * MARGIN, 0.6 * ROOM[0]);
  const tall = wide / SHAPE, middle = [(x0 + x1) / 2 / per_mm, (y0 + y1) / 2 / per_mm];
  return { per_mm, box: [middle[0] - wide / 2, middle[1] - tall / 2, wide, tall] };
}

/** Make the elements of a scheme whose sizes may change; return what draws them.
 * @param {any} view
 * @param {any} model
 * @param {string[]} rows names of the outputs
 * @param {ReturnType<import('./sizes.js').sizing>} numbers */
export function skeleton(view, model, rows, numbers) {
  const group = shape(view.svg.querySelector(".skeleton"), "g"), row = new Map(rows.map((name, k) => [name, k]));
  const guides = model.slides.map(() => shape(group, "path", "seg thin"));
  const supports = Object.keys(model.links[0] ?? {}).filter(name => row.has(`${name}.x`)).map(name => {
    const base = shape(group, "path", "seg thin");
    base.setAttribute("d", `M0 0L${-SUPPORT / 2} ${SUPPORT}H${SUPPORT / 2}ZM${-SUPPORT} ${SUPPORT}H${SUPPORT}`);
    return { base, at: [row.get(`${name}.x`)] };
  });
  const [w, h] = BLOCK, blocks = model.slides.map(() => {
    const block = shape(group, "path", "seg block");
    block.setAttribute("d", path([[-w, -h], [w, -h], [w, h], [-w, h]]) + "Z");
    return block;
  });
  const joints = view.labels.filter(one => one.at).map(one => {
    const joint = shape(group, "circle", "seg block");
    joint.setAttribute("r", "1.2");
    return { joint, at: one.at };
  });
  const put = (node, [x, y], turned = 0) => node.setAttribute("transform",
    `translate(${x.toFixed(3)} ${y.toFixed(3)}) rotate(${(-turned).toFixed(4)})`);
  return (out, values) => {
    for (const { base, at } of supports) put(base, point(view, out, at, 1));
    for (const { joint, at } of joints) put(joint, point(view, out, at, 1));
    model.slides.forEach((slide, k) => {
      const at = [row.get(`${slide.pin}.x`)], fixed = slide.host === "0";
      if (at[0] === undefined) return;
      const turned = fixed ? numbers.guide(slide, values).heading : out[row.get(`${slide.host}.phi_deg`)] + slide.angle;
      put(blocks[k], point(view, out, at, 1), turned);
      guides[k].setAttribute("d", fixed ? `M${-FAR} ${h}H${FAR}` : "");
      if (fixed) put(guides[k], point(view, out, at, 1), turned);
    });
  };
}
