// Sizes on the board: lengths of links and angles of guides, typed where they are shown, kept by a lock.
import { W, byId } from "./api.js";
import { apart, toward } from "./drag.js";
import * as edits from "./edits.js";
import { short } from "./numbers.js";

/** @typedef {[number, number]} Place */

const spoken = one => one.label.map(run => run[0]).join("");

/** The sizes of a drawing, and the field in which one of them is typed.
 * @param {any} svg the board
 * @param {{ now: () => { mech: any, model: any, sizes: any, table: any }, at: (point: string) => Place, places: Map<string, Place>,
 *   scale: () => number, step: () => number, settle: (sizes: any) => void, build: () => void,
 *   commit: (changes: [any[], any][]) => any }} drawing */
export function dimensions(svg, { now, at, places, scale, step, settle, build, commit }) {
  const field = byId("size-field"), box = byId("size"), locked = new Set();
  let edited = "";

  /** @type {(p: string, q: string) => Place} */
  const middle = (p, q) => { const [a, b] = [at(p), at(q)]; return [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2]; };

  const lengths = ({ model, sizes }) => model.parameters.filter(one => one.means[0] === "length" && one.means.slice(2).every(p => places.has(p))).map(one => ({
    name: one.name, locked: locked.has(one.name), spoken: spoken(one), told: () => short(now().sizes.values[one.name] * 1000, 5),
    middle: () => middle(one.means[2], one.means[3]) }));

  const angles = ({ mech, model }) => model.parameters.filter(one => one.means[0] === "guide angle").flatMap(one => {
    const slide = model.slides.find(other => other.label === one.means[1] && other.host === "0");
    return slide ? [{ name: one.name, locked: locked.has(one.name), spoken: `∠ ${one.means[1]}`, told: () => `${short(now().sizes.values[one.name], 5)}°`,
      middle: () => {  // on the guide, beyond its slider; of a driving one, whose handle is there, behind it
        const { through, heading } = mech.guide(slide, now().sizes.values), [x, y] = at(slide.pin), [ux, uy] = toward(heading, 1);
        const ahead = slide.slider === model.driver.link || (x - through[0]) * ux + (y - through[1]) * uy < 0 ? -46 : 46;
        return [x + ahead * ux / scale(), y + ahead * uy / scale()];
      } }] : [];
  });

  const written = ({ table }) => Object.entries(table.links).flatMap(([link, points]) => points.flatMap((p, k) => points.slice(k + 1).flatMap(q => {
    const key = [p + q, q + p].find(one => typeof table.raw[link][one] === "number");
    return key && places.has(p) && places.has(q) ? [{ name: `${link} ${key} ${p} ${q}`, spoken: key, locked: false,
      told: () => short(table.raw[link][key] / table.per * 1000, 5), middle: () => middle(p, q) }] : [];
  })));

  const group = name => svg.querySelector(`[data-id="size ${CSS.escape(name)}"]`);
  const perUnit = one => one.means[0] === "guide angle" ? 1 : 1000;  // degrees; millimetres of a metre

  /** What a field is of: a number of the model, or one that the file has of a drawing that does not move yet. */
  function sizeOf(name) {
    const { mech, sizes, table } = now(), one = mech?.parameters.get(name);
    if (one) return { said: spoken(one), value: sizes.values[name], factor: perUnit(one), unit: perUnit(one) === 1 ? "°" : W.of_length, low: perUnit(one) === 1 ? -Infinity : 0 };
    const [link, key] = name.split(" "), value = table.raw[link]?.[key];
    return typeof value === "number" ? { said: key, value: value / table.per, factor: 1000, unit: W.of_length, low: 0 } : null;
  }

  function open(name) {
    const one = sizeOf(name), shown = group(name);
    if (!one || !shown) return;
    edited = name;
    const { left, top } = byId("board-box").getBoundingClientRect(), place = shown.getBoundingClientRect();
    field.hidden = false;
    field.style.left = `${Math.max(0, Math.min(place.left - left - 20, byId("board-box").clientWidth - 190))}px`;
    field.style.top = `${place.top - top - 6}px`;
    byId("size-name").textContent = `${one.said}, ${one.unit}`;
    box.value = edits.tidy(one.value * one.factor);
    byId("size-lock").checked = locked.has(name);
    byId("size-lock").parentElement.hidden = !now().mech;
    field.dataset.before = JSON.stringify(one.value);
    box.focus();
    box.select();
  }

  const typed = ({ factor, low }) => {
    const value = parseFloat(box.value.replace(",", ".").replace("−", "-")) / factor;
    return value > low ? value : NaN;
  };

  function take(value) {
    const { mech, sizes } = now();
    if (mech && Number.isFinite(value)) settle({ ...sizes, values: { ...sizes.values, [edited]: value } });
  }
  function follow() {
    const one = edited && sizeOf(edited);
    if (one) take(typed(one));
  }

  function close() {
    if (!edited) return;
    const name = edited, before = JSON.parse(field.dataset.before), one = sizeOf(name), { mech, sizes, table } = now();
    edited = "";
    field.hidden = true;
    if (!mech) {
      const [link, key, p, q] = name.split(" "), value = one ? typed(one) : NaN;
      if (!Number.isFinite(value) || value === before) { build(); return; }
      const free = q in table.fixed ? p : q, other = free === p ? q : p, [a, b] = [at(other), at(free)], times = value / (apart(a, b) || 1);
      places.set(free, [a[0] + (b[0] - a[0]) * times, a[1] + (b[1] - a[1]) * times]);
      commit([[["links", link, key], edits.tidy(value * table.per)]]);
    } else if (sizes.values[name] !== before) commit([[mech.parameters.get(name).key, edits.tidy(sizes.values[name] * mech.parameters.get(name).per)]]);
    else build();
  }

  box.addEventListener("input", follow);
  box.addEventListener("keydown", event => {
    if (event.key === "Enter") { const name = edited; close(); group(name)?.focus(); }
    if (event.key === "Escape") {
      const before = JSON.parse(field.dataset.before);
      box.value = String(edits.tidy(before * (sizeOf(edited)?.factor ?? 1000)));
      take(before);
      close();
    }
    if (["ArrowUp", "ArrowDown"].includes(event.key)) {
      event.preventDefault();
      box.value = String(edits.tidy(parseFloat(box.value) + (event.key === "ArrowUp" ? 1 : -1) * (step() * 1000 || 1) * (event.shiftKey ? 10 : 1)));
      follow();
    }
  });
  byId("size-lock").addEventListener("change", event => { if (event.target.checked) locked.add(edited); else locked.delete(edited); });
  field.addEventListener("focusout", event => { if (!field.contains(event.relatedTarget)) close(); });

  return { open, close, locked,
    shown: () => { const all = now(); return all.mech ? [...lengths(all), ...angles(all)] : written(all); } };  // those that the board shows
}
