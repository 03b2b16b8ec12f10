// What each act of drawing changes in a problem file: keys and values. No document is needed here.

/** @typedef {[number, number]} Place */
/** @typedef {{ links: Record<string, string[]>, fixed: Record<string, any>, guides: Record<string, any>, slides: Record<string, any>,
 *   driver: any, rules: Record<string, any>, loads: any[], raw: any, n: number, per: number }} Table */
/** @typedef {[(string | number)[], any][]} Changes */

/** @type {() => Table} */
export const empty = () => tableOf({}, 1);

/** What a file has, its lengths in its own unit; `per`: how many of it are a metre.
 * @type {(found: any, per: number) => Table} */
export function tableOf({ frame, links, driver, assembly, loads }, per) {
  const is = value => value && typeof value === "object" && !Array.isArray(value);
  const raw = is(links) ? Object.fromEntries(Object.entries(links).filter(([, one]) => is(one))) : {};
  const places = is(frame) ? frame : {}, guides = is(places.guides) ? places.guides : {};
  const named = Object.fromEntries(Object.entries(raw).map(([link, one]) =>
    [link, Array.isArray(one.points) ? one.points.filter(point => typeof point === "string") : []]));
  const slides = {};
  for (const [link, one] of Object.entries(raw)) {
    if (!is(one.slides)) continue;
    const on = String(one.slides.on), slot = named[on];
    slides[link] = slot ? { host: on, ends: slot.slice(0, 2) } : { host: "0", label: on };
  }
  return { links: named, fixed: Object.fromEntries(Object.entries(places).filter(([, at]) => Array.isArray(at))
    .map(([point, at]) => [point, at.map(value => value / per)])), guides, per, slides,
    driver: is(driver) ? driver : {}, rules: is(assembly) ? assembly : {}, loads: Array.isArray(loads) ? loads.filter(is) : [], raw, n: Object.keys(raw).length };
}

/** @type {(table: Table) => Set<string>} */
export const points = table => new Set([...Object.values(table.links).flat(), ...Object.keys(table.fixed)]);

/** @type {(value: number) => number} */
export const tidy = value => +value.toFixed(9) || 0;

const LETTERS = [..."ABCDEFGHKLMNPQRTUVWXYZ"];
/** @type {(used: Set<string>) => string} */
export function letter(used) {
  for (let n = 0; ; n++) for (const one of n ? LETTERS : ["O", ...LETTERS]) if (!used.has(one + (n || ""))) return one + (n || "");
}
/** @type {(table: Table) => string} */
const numeral = table => {
  for (let n = 1; ; n++) if (!table.raw[n]) return String(n);
};
const dist = (a, b) => Math.hypot(b[0] - a[0], b[1] - a[1]);
/** A length in the unit of the file, whole millimetres. */
const inFile = (table, value) => tidy(milli(value) * table.per);
/** @type {(table: Table, place: Place) => Place} */
const placed = (table, [x, y]) => [tidy(x * table.per), tidy(y * table.per)];
const milli = value => tidy(Math.round(value * 1000) / 1000) || tidy(value);

/** Moving links, lower pairs and mobility.
 * @type {(table: Table) => { n: number, p: number, w: number }} */
export function mobility(table) {
  const n = Object.keys(table.links).length;
  let p = Object.keys(table.slides).length;
  for (const point of points(table)) {
    const count = Object.values(table.links).filter(own => own.includes(point)).length + Number(point in table.fixed);
    p += Math.max(0, count - 1);
  }
  return { n, p, w: 3 * n - 2 * p };
}

/** @type {(table: Table, guide: any, places: Map<string, Place>) => Place} */
export const throughOf = (table, guide, places) => Array.isArray(guide?.through) ? guide.through.map(value => value / table.per) : places.get(guide?.through) || [0, 0];

/** Give points that were typed and not drawn a place.
 * @type {(table: Table, places: Map<string, Place>) => void} */
export function guess(table, places) {
  for (const [point, at] of Object.entries(table.fixed)) if (!places.has(point) && at.every(Number.isFinite)) places.set(point, at);
  for (let turn = 0; turn < 9; turn++) {
    for (const [link, own] of Object.entries(table.links)) {
      const known = own.find(point => places.has(point));
      own.forEach((point, k) => {
        if (places.has(point) || (!known && turn < 8)) return;
        const far = (+table.raw[link][known + point] || +table.raw[link][point + known]) / table.per || 0.1, [x, y] = places.get(known) || [0, 0];
        const turned = (25 + 50 * k + 35 * Object.keys(table.links).indexOf(link)) * Math.PI / 180;
        places.set(point, [x + far * Math.cos(turned), y + far * Math.sin(turned)]);
      });
    }
  }
}

/** @type {(found: Record<string, string>) => Changes} */
export const rules = found => Object.entries(found).map(([point, rule]) => [["assembly", point], rule]);

/** @type {(table: Table, a: string, b: string, places: Map<string, Place>) => Changes} */
export function link(table, a, b, places) {
  const name = numeral(table);
  return [[["links", name, "points"], [a, b]], [["links", name, a + b], inFile(table, dist(places.get(a), places.get(b)))]];
}

/** A point of a link, along its line and beside it.
 * @type {(table: Table, name: string, point: string, place: Place, places: Map<string, Place>) => { changes: Changes, place: Place }} */
export function onLink(table, name, point, place, places) {
  const [p, q] = table.links[name], a = places.get(p), b = places.get(q), long = dist(a, b);
  const [ux, uy] = [(b[0] - a[0]) / long, (b[1] - a[1]) / long], [x, y] = [place[0] - a[0], place[1] - a[1]];
  const at = milli(x * ux + y * uy), beside = milli(-x * uy + y * ux), across = Math.abs(beside) < long * 0.08 ? 0 : beside;
  return {
    changes: [[["links", name, "points"], [...table.links[name], point]],
      [["links", name, point], across ? { on: p + q, at: tidy(at * table.per), across: tidy(across * table.per) } : { on: p + q, at: tidy(at * table.per) }]],
    place: [a[0] + at * ux - across * uy, a[1] + at * uy + across * ux],
  };
}

const GUIDES = ["x-x", "y-y", "u-u", "v-v", "w-w"];
/** @type {(table: Table) => string} */
const guideName = table => GUIDES.find(name => !table.guides[name]) || `g${Object.keys(table.guides).length + 1}`;

/** @type {(table: Table, through: Place, angle: number) => Changes} */
export const guide = (table, through, angle) => [[["frame", "guides", guideName(table)], { through: placed(table, through), angle }]];

/** @type {(table: Table, pin: string, how: { slot: string, guide: string, angle: number, place: Place }) => Changes} */
export function slider(table, pin, { slot, guide: on, angle, place }) {
  const name = numeral(table);
  if (slot) {
    const [p, q] = table.links[slot];
    return [[["links", name, "points"], [pin]], [["links", name, "slides"], { on: slot, along: p + q }]];
  }
  const label = on || guideName(table);
  /** @type {Changes} */
  const made = on ? [] : guide(table, place, angle);
  return [...made, [["links", name, "points"], [pin]], [["links", name, "slides"], { on: label }]];
}

/** @type {(table: Table, point: string, place: Place) => Changes} */
export const ground = (table, point, place) => [[["frame", point], point in table.fixed ? undefined : placed(table, place)]];

/** Whether coordinates may begin at a joint that becomes fixed: nothing else of the file is where it is by them.
 * @type {(table: Table, point: string) => boolean} */
export const isFirst = (table, point) => !Object.keys(table.fixed).length && Object.values(table.rules).every(rule => typeof rule === "string") && !(point in table.fixed);

/** What of a file has coordinates, with another beginning of them.
 * @type {(table: Table, origin: Place) => Changes} */
export const shifted = (table, [x, y]) => Object.entries(table.guides).filter(([, one]) => Array.isArray(one.through)).map(([label, one]) =>
  [["frame", "guides", label, "through"], [tidy(one.through[0] - x * table.per), tidy(one.through[1] - y * table.per)]]);

/** @type {(table: Table, point: string) => string} */
export const driverAt = (table, point) => Object.keys(table.links).find(name => table.links[name].includes(point) &&
  (table.links[name].some(own => own in table.fixed) || table.slides[name]?.host === "0")) || "";

/** @type {(table: Table, name: string, places: Map<string, Place>) => Changes | null} */
export function driver(table, name, places) {
  const own = table.links[name] || [], pivot = own.find(point => point in table.fixed);
  const [p, q] = own, away = key => table.driver[key] === undefined ? [] : /** @type {Changes} */ ([[["driver", key], undefined]]);
  if (pivot && own.length > 1) {
    const a = places.get(p), b = places.get(q), phi = Math.round(Math.atan2(b[1] - a[1], b[0] - a[0]) * 180 / Math.PI);
    return [...away("s"), ...away("v"), [["driver", "link"], name], [["driver", "phi"], phi], [["driver", "omega"], table.driver.omega ?? 10]];
  }
  if (table.slides[name]?.host === "0") {
    const given = table.guides[table.slides[name].label], [x, y] = throughOf(table, given, places), turned = (+given?.angle || 0) * Math.PI / 180;
    const at = places.get(p), s = milli((at[0] - x) * Math.cos(turned) + (at[1] - y) * Math.sin(turned));
    return [...away("phi"), ...away("omega"), [["driver", "link"], name], [["driver", "s"], tidy(s * table.per)], [["driver", "v"], table.driver.v ?? 0.1]];
  }
  return null;
}

/** @type {(table: Table, point: string) => Changes} */
export function load(table, point) {
  const name = Object.keys(table.links).reverse().find(one => table.links[one].includes(point));
  return name ? [[["loads", "+"], { link: name, at: point, angle: 180, force: 100 }]] : [];
}

/** @type {(table: Table, kind: string, name: string) => Changes} */
export function without(table, kind, name) {
  if (kind === "guide") return [[["frame", "guides", name], undefined]];
  if (kind === "load") return [[["loads", +name], undefined]];
  const gone = new Set(kind === "link" ? [name] : []);
  /** @type {Changes} */
  const changes = [];
  if (kind === "joint") {
    for (const [link, own] of Object.entries(table.links)) {
      if (!own.includes(name)) continue;
      if (own.length < 3 || own.indexOf(name) < 2) { gone.add(link); continue; }
      changes.push([["links", link, "points"], own.filter(point => point !== name)], [["links", link, name], undefined]);
      for (const key of Object.keys(table.raw[link])) if (own.some(other => key === name + other || key === other + name)) changes.push([["links", link, key], undefined]);
    }
    if (name in table.fixed) changes.push([["frame", name], undefined]);
    if (name in table.rules) changes.push([["assembly", name], undefined]);
  }
  for (const link of gone) {
    changes.push([["links", link], undefined]);
    if (String(table.driver.link) === link) changes.push([["driver"], undefined]);
  }
  const left = new Set(Object.entries(table.links).filter(([link]) => !gone.has(link)).flatMap(([, own]) => own));
  for (const point of Object.keys(table.rules)) if (!left.has(point) && point !== name) changes.push([["assembly", point], undefined]);
  return changes;
}

/** A joint of a mechanism that is not whole was moved: the sizes that it has follow.
 * @type {(table: Table, point: string, places: Map<string, Place>) => Changes} */
export function moved(table, point, places) {
  /** @type {Changes} */
  const changes = [];
  if (point in table.fixed) changes.push([["frame", point], placed(table, places.get(point))]);
  for (const [link, own] of Object.entries(table.links)) {
    for (const other of own) {
      for (const key of [point + other, other + point]) {
        if (own.includes(point) && typeof table.raw[link][key] === "number") changes.push([["links", link, key], inFile(table, dist(places.get(point), places.get(other)))]);
      }
    }
  }
  return changes;
}

/** The address that has a whole text behind its #, compressed; nothing of it is sent.
 * @type {(text: string, name: string) => Promise<string>} */
export async function shared(text, name) {
  const packed = new Response(new Blob([text]).stream().pipeThrough(new CompressionStream("deflate-raw")));
  const bytes = new Uint8Array(await packed.arrayBuffer());
  const code = btoa(Array.from(bytes, byte => String.fromCharCode(byte)).join("")).replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "");
  return `${location.origin}${location.pathname}${location.search}#text=${code}&name=${encodeURIComponent(name)}`;
}

/** @type {(code: string) => Promise<string>} */
export async function unshared(code) {
  const bytes = Uint8Array.from(atob(code.replace(/-/g, "+").replace(/_/g, "/")), letter => letter.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"))).text();
}
