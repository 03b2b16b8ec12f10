// The drawing room: a mechanism drawn and moved by hand. Every act is a small change of the text, which it follows in turn.
import { W, byId, compute, faultText, note, say } from "./api.js";
import { board, planned } from "./board.js";
import { apart, mechanism, signed } from "./drag.js";
import * as edits from "./edits.js";
import { decimals, short } from "./numbers.js";
import { between, patched } from "./patch.js";
import { draw as drawView, prepare } from "./views.js";

const PAUSE = 250, ROUNDS = 90;  // ms without a letter; positions of a way of a point
const HINTS = { select: W.hint_select, joint: W.hint_joint, link: W.hint_link, slider: W.hint_slider, guide: W.hint_guide,
  ground: W.hint_ground, driver: W.hint_driver, load: W.hint_load, delete: W.hint_delete };
const MISSING = { frame: W.missing_frame, driver: W.missing_driver };
const KEYS = { v: "select", j: "joint", l: "link", s: "slider", r: "guide", g: "ground", d: "driver", f: "load", x: "delete" };

/** The room, on the texts of an editor.
 * @param {any} typed
 * @param {() => any} problem
 * @param {(found: any) => void} [heard] is told what the server says of a text */
export function drawing(typed, problem, heard = () => {}) {
  const svg = byId("board"), panel = byId("drawing"), told = byId("draw-told"), field = byId("size-field");
  const own = board(svg, { say });
  const plans = byId("plans");
  let table = edits.empty(), model = null, mech = null, sizes = null, text = null, faults = [];
  /** @type {Map<string, [number, number]>} */
  const places = new Map();  // of all points, as they are drawn
  const pending = new Set();  // points that no link has yet
  const locked = new Set();
  let tool = "select", chosen = "", first = "", held = null, views = [], asked = 0, fitted = false, why = "";
  decimals(W.decimal);

  // The model ---------------------------------------------------------------------------------------

  const at = point => places.get(point) || /** @type {[number, number]} */ ([NaN, NaN]);
  const step = () => Math.max(0, +byId("step").value || 0) / 1000;

  const drawn = () => {  // where points are in the position of the file by which it is assembled
    const found = Object.fromEntries([...places].filter(([point]) => edits.points(table).has(point)));
    if (mech && sizes && model.driver.first !== sizes.x && !model.driver.single) {
      const pose = mech.pose({ ...sizes, x: model.driver.first });
      for (const point of Object.keys(found)) if (Number.isFinite(pose.at(point)[0])) found[point] = pose.at(point);
    }
    return found;
  };

  const ask = (whole, near) => compute("modelled", { ...problem(), text: whole, drawn: near }, { tries: 1 });

  function adopt(found, whole) {  // what the server says of a text
    text = whole;
    faults = found.faults || [];
    heard(found);
    if (!found.table) { tell(); return; }
    table = edits.tableOf(found.table, found.per);
    const before = model && model.driver.link === found.model?.driver.link ? sizes?.x : null;
    model = found.model?.tape ? found.model : null;
    mech = model ? mechanism(model) : null;
    sizes = mech ? mech.given() : null;
    if (sizes && before !== null && before !== undefined && !model.driver.single) sizes.x = before;
    const there = edits.points(table);
    for (const point of places.keys()) if (!there.has(point) && !pending.has(point)) places.delete(point);
    for (const point of there) pending.delete(point);
    for (const [point, place] of Object.entries({ ...found.fixed, ...found.model?.places })) places.set(point, place);
    posed();
    edits.guess(table, places);
    if (model) show();
    byId("plans").replaceChildren();
    views = mech ? model.views.map(view => {
      planned(plans, view);
      prepare(view, { words: { touch: " " }, peak: [] });
      return view;
    }) : [];
    build();
    traced();
    if (!fitted && places.size) { fitted = true; fit(); }
    tell(found.model && !model ? W[`no_tape_${found.model.no_tape}`] : "");
  }

  function show() {
    const slider = byId("phi"), crank = model.driver.crank;
    byId("phi-of").hidden = !crank;
    slider.value = crank ? ((sizes.x % 360) + 360) % 360 : 0;
  }

  function posed() {  // every point where the numbers have it; false where it does not close
    if (!mech) return true;
    const pose = mech.pose(sizes);
    if (pose.failed >= 0) {
      const reason = model.reasons[pose.failed].map(run => run[0]).join("");
      why = reason;
      return false;
    }
    why = "";
    for (const point of [...edits.points(table)]) if (Number.isFinite(pose.at(point)[0])) places.set(point, pose.at(point));
    sizes.out = pose.out;
    return true;
  }

  async function refresh() {  // the text was changed elsewhere
    const turn = ++asked, whole = typed.text();
    if (!whole.trim()) { adopt({ table: {}, per: 1, faults: [] }, whole); return; }
    const found = await ask(whole, typed.undone() ? {} : drawn());
    if (turn !== asked || typed.text() !== whole) return;
    if (Object.keys(found.rules || {}).length && !typed.undone() && !(found.faults || []).length) {
      const more = edits.rules(found.rules);
      const next = patched(whole, more);
      text = next;
      typed.change(between(whole, next), true);
      adopt(found, next);
    } else adopt(found, whole);
  }

  let chain = Promise.resolve(), writing = 0;
  /** Write changes of keys; with what the server finds missing to assemble it as it is drawn.
   * @type {(changes: [any[], any][], how?: { asks?: boolean }) => Promise<void>} */
  function commit(changes, { asks = true } = {}) {
    writing++;
    chain = chain.then(async () => {
      const turn = ++asked, before = typed.text();
      let whole = patched(before, changes), found = null, all = changes;
      if (asks) {
        found = await ask(whole, drawn()).catch(error => { note(error.message); return null; });
        if (found?.rules) all = [...changes, ...edits.rules(found.rules)];
        whole = patched(typed.text(), all);
      }
      const moved = typed.text() !== before;
      text = whole;
      typed.change(between(typed.text(), whole));
      if (found && !moved && turn === asked) adopt(found, whole);
      else if (!asks || moved) { text = null; soon(0); }
    }).finally(() => { writing--; });
    return chain;
  }

  let pause = 0;
  function soon(wait = PAUSE) {
    clearTimeout(pause);
    pause = setTimeout(() => { if (!panel.hidden && !held) refresh().catch(error => note(error.message)); }, wait);
  }

  // The picture -------------------------------------------------------------------------------------

  const heading = slide => {
    if (slide.host === "0") return slide.guide.heading;
    const [a, b] = slide.ends.map(at);
    return Math.atan2(b[1] - a[1], b[0] - a[0]) * 180 / Math.PI;
  };

  function guideOf(label) {
    const live = mech && model.slides.find(one => one.label === label && one.host === "0");
    if (live) return mech.guide(live, sizes.values);
    const given = table.guides[label];
    return { through: edits.throughOf(table, given, places), heading: +given?.angle || 0 };
  }

  function build() {
    const fixed = new Set(Object.keys(table.fixed)), links = { ...table.links };
    for (const point of pending) links[`? ${point}`] = [point];
    const slides = Object.entries(table.slides).filter(([link]) => table.links[link]?.length).map(([link, slide]) => ({
      slider: link, pin: table.links[link][0], host: slide.host,
      heading: () => slide.host === "0" ? guideOf(slide.label).heading : heading({ host: slide.host, ends: slide.ends }) }));
    const pivot = mech && model.driver.pivot, end = pivot && Object.keys(model.links[model.driver.link]).find(p => p !== pivot);
    const slider = mech && !pivot && model.slides.find(one => one.slider === model.driver.link && one.host === "0");
    own.build({
      links, fixed, slides, chosen, first, at,
      guides: Object.keys(table.guides).map(label => ({ label, now: () => guideOf(label) })),
      sizes: mech ? [...lengths(), ...angles()] : typedLengths(),
      driver: { link: table.driver.link, end: () => end || slider?.pin, x: () => sizes?.x ?? 0, turns: !slider,
        handle: end && model.driver.crank ? () => [at(pivot), at(end)] : slider ? () => [behind(slider), at(slider.pin)] : null },
    });
    if (cursor && document.activeElement === svg) own.cursor(cursor);
    for (const one of byId("tools").querySelectorAll("[data-tool]")) one.setAttribute("aria-pressed", String(one.dataset.tool === tool));
  }

  const spoken = one => one.label.map(run => run[0]).join("");
  const middle = (p, q) => { const [a, b] = [at(p), at(q)]; return /** @type {[number, number]} */ ([(a[0] + b[0]) / 2, (a[1] + b[1]) / 2]); };
  const toward = (heading, far) => [far * Math.cos(heading * Math.PI / 180), far * Math.sin(heading * Math.PI / 180)];

  function behind(slider) {  // a place behind a driving slider, so that its handle is ahead of it
    const [x, y] = at(slider.pin), [dx, dy] = toward(mech.guide(slider, sizes.values).heading, 1e-3);
    return [x - dx, y - dy];
  }

  const lengths = () => model.parameters.filter(one => one.means[0] === "length" && one.means.slice(2).every(p => places.has(p))).map(one => ({
    name: one.name, locked: locked.has(one.name), spoken: spoken(one), told: () => short(sizes.values[one.name] * 1000, 5),
    middle: () => middle(one.means[2], one.means[3]) }));

  const angles = () => model.parameters.filter(one => one.means[0] === "guide angle").flatMap(one => {
    const slide = model.slides.find(other => other.label === one.means[1] && other.host === "0");
    return slide ? [{ name: one.name, locked: locked.has(one.name), spoken: `∠ ${one.means[1]}`, told: () => `${short(sizes.values[one.name], 5)}°`,
      middle: () => {  // on the guide, beyond its slider; of a driving one, whose handle is there, behind it
        const { through, heading } = mech.guide(slide, sizes.values), [x, y] = at(slide.pin), [ux, uy] = toward(heading, 1);
        const ahead = slide.slider === model.driver.link || (x - through[0]) * ux + (y - through[1]) * uy < 0 ? -46 : 46;
        return [x + ahead * ux / own.view.scale, y + ahead * uy / own.view.scale];
      } }] : [];
  });

  function typedLengths() {  // of a drawing that does not move yet: what its file has
    return Object.entries(table.links).flatMap(([link, points]) => points.flatMap((p, k) => points.slice(k + 1).flatMap(q => {
      const key = [p + q, q + p].find(one => typeof table.raw[link][one] === "number");
      return key && places.has(p) && places.has(q) ? [{ name: `${link} ${key} ${p} ${q}`, spoken: key, locked: false,
        told: () => short(table.raw[link][key] / table.per * 1000, 5), middle: () => middle(p, q) }] : [];
    })));
  }

  function traced() {
    if (!mech || !model.driver.crank) { own.traces([]); return; }
    const points = model.order.filter(point => !table.fixed[point] && edits.points(table).has(point));
    own.traces(mech.ways(sizes, points, Array.from({ length: ROUNDS + 1 }, (_, k) => 360 * k / ROUNDS)));
  }

  function draw() {
    own.draw();
    if (sizes?.out) for (const view of views) drawView(view, sizes.out);
  }

  function tell(more = "") {
    const { n, p, w } = edits.mobility(table);
    const parts = [];
    if (why) parts.push(why);
    else if (more) parts.push(more);
    else if (!n && !pending.size) parts.push(W.draw_empty);
    else if (faults.length) parts.push(MISSING[faults[0].path] || faultText(faults[0]));
    if (n) parts.push(say("mobility", { n, p, w }));
    if (model?.groups.length && !faults.length) {
      parts.push(say("groups_are", { groups: model.groups.map(one =>
        (facts => one.kind ? say("class_kind", facts) : say("class_only", facts))(
          { links: one.links.join("–"), class: one.class, kind: one.kind })).join(", ") }));
    }
    told.textContent = parts.join(" ");
    told.classList.toggle("bad", Boolean(why));
    byId("draw-hint").textContent = HINTS[tool];
    if (sizes?.out) for (const view of views) drawView(view, sizes.out);
  }

  function fit() {
    const real = [...places.values()];
    const around = model?.driver.crank ? [0, 60, 120, 180, 240, 300] : model?.driver.positions;
    if (mech) for (const line of mech.ways(sizes, [...edits.points(table)].filter(p => places.has(p)), around)) real.push(...line.filter(Boolean));
    own.fit(real);
    own.picture();
    draw();
    traced();
  }

  // Dragging ----------------------------------------------------------------------------------------

  const round = value => step() ? Math.round(value / step()) * step() : value;
  /** @type {(place: [number, number]) => [number, number]} */
  const snapped = place => [round(place[0]), round(place[1])];

  function pull(kind, name, place, exact, ratio = false) {
    const how = { step: exact ? 0 : step(), locked, from: ratio ? held?.before?.values : undefined };
    const slider = kind === "driver" && mech && !model.driver.pivot && model.slides.find(one => one.slider === model.driver.link);
    if (slider) {  // its handle is ahead of it
      const [dx, dy] = toward(mech.guide(slider, sizes.values).heading, 30 / own.view.scale);
      const next = mech.pulled(sizes, slider.pin, [place[0] - dx, place[1] - dy], how);
      if (next) settle({ ...next, x: exact ? next.x : round(next.x) });
      return;
    }
    if (kind === "driver" || !mech) {
      if (!mech) { if (kind === "joint") places.set(name, exact ? place : snapped(place)); draw(); return; }
      const pivot = at(model.driver.pivot), body = model.links[model.driver.link], end = Object.keys(body).find(p => p !== model.driver.pivot);
      const zero = Math.atan2(body[end][1] - body[model.driver.pivot][1], body[end][0] - body[model.driver.pivot][0]) * 180 / Math.PI;
      const phi = Math.atan2(place[1] - pivot[1], place[0] - pivot[0]) * 180 / Math.PI - zero;
      settle({ ...sizes, x: exact ? phi : Math.round(phi) });
      return;
    }
    if (kind === "joint" && !Number.isFinite(mech.pose(sizes).at(name)[0])) { places.set(name, exact ? place : snapped(place)); draw(); return; }
    const next = kind === "guide" ? mech.shifted(sizes, name, place, how) : mech.pulled(sizes, name, place, how);
    if (!next) { why = say("not_its_own", { name }); tell(); return; }
    settle(next);
  }

  function settle(next) {  // takes numbers if the mechanism closes with them
    const before = sizes;
    sizes = next;
    if (!posed()) sizes = before;
    draw();
    traced();
    if (mech) show();
    told.classList.toggle("bad", Boolean(why));
    tell();
  }

  function changesOf(before) {  // of the text, since a drag began
    const changes = model.parameters.filter(one => sizes.values[one.name] !== before.values[one.name])
      .map(one => [one.key, edits.tidy(sizes.values[one.name] * one.per)]);
    if (sizes.x !== before.x && model.driver.single) {
      const phi = model.driver.coordinate === "phi";  // an angle, or a way in the unit of the file
      changes.push([["driver", model.driver.coordinate], edits.tidy(phi ? signed(sizes.x) : sizes.x * model.per)]);
    }
    return changes;
  }

  function released(before) {
    const changes = changesOf(before), flipped = Object.keys(sizes.sides).some(point => sizes.sides[point] !== (before.sides[point] ?? 1));
    why = "";
    tell();
    if (changes.length) commit(changes, { asks: flipped || changes.some(([key]) => key[0] === "driver") });
  }

  // Drawing -----------------------------------------------------------------------------------------

  function newPoint(place) {
    const name = edits.letter(new Set([...edits.points(table), ...pending]));
    pending.add(name);
    fitted = true;  // the picture stays where it is under the hand
    places.set(name, snapped(place));
    return name;
  }

  function acted(kind, name, place, drop) {  // a click, or a drag that ended on something else
    const change = (made, then = "") => { chosen = then; first = ""; if (made?.length) commit(made); else { build(); tell(); } };
    const point = () => kind === "joint" ? name : newPoint(place);
    switch (tool) {
      case "joint":
        if (kind === "link" && table.links[name]?.length > 1) {
          const letter = edits.letter(new Set([...edits.points(table), ...pending]));
          const added = edits.onLink(table, name, letter, place, places);
          places.set(letter, added.place);
          change(added.changes, `joint ${letter}`);
        } else if (kind !== "joint") { newPoint(place); build(); tell(); }
        return;
      case "link": {
        const end = point();
        if (!first || first === end) { first = first === end ? "" : end; build(); tell(); return; }
        change(edits.link(table, first, end, places));
        return;
      }
      case "slider": {
        const pin = point();
        let slot = drop[0] === "link" && drop[1] !== name && !table.links[drop[1]]?.includes(pin) && table.links[drop[1]]?.length > 1 ? drop[1] : "";
        if (table.slides[Object.keys(table.slides).find(link => table.links[link][0] === pin)]) return;
        const guide = drop[0] === "guide" ? drop[1] : kind === "guide" ? name : "";
        const turned = drop[2] && !slot && !guide ? drop[2] : 0;
        change(edits.slider(table, pin, { slot, guide, angle: turned, place: snapped(at(pin)) }));
        return;
      }
      case "guide": change(edits.guide(table, snapped(place), drop[2] || 0)); return;
      case "ground": if (kind === "joint" || !kind) { const end = point(); change(edits.ground(table, end, snapped(at(end)))); } return;
      case "driver": {
        const link = kind === "link" ? name : edits.driverAt(table, name), made = link && edits.driver(table, link, places);
        if (!made) { note(W.not_grounded); return; }
        change(made);
        turnTo("select");  // it can be moved now
        return;
      }
      case "load": if (kind === "joint" && table.links) change(edits.load(table, name)); return;
      case "delete": if (kind) { pending.delete(name); change(edits.without(table, kind, name)); build(); } return;
      default: chosen = kind ? `${kind} ${name}` : ""; build();
    }
  }

  const placeOf = event => { const { left, top } = svg.getBoundingClientRect(); return /** @type {[number, number]} */ ([event.clientX - left, event.clientY - top]); };
  const fingers = new Map();

  svg.addEventListener("pointerdown", event => {
    const size = event.target.closest?.(".size"), here = placeOf(event);
    fingers.set(event.pointerId, here);
    if (size && tool === "select") { event.preventDefault(); openField(size.dataset.id.slice(5)); return; }
    if (event.button) return;
    svg.setPointerCapture(event.pointerId);
    closeField();
    if (fingers.size > 1) { held = { pinch: true, from: [...fingers.values()] }; return; }
    const [kind, name] = own.hit(here, event.pointerType);
    held = { kind, name, here, start: here, moved: false, before: sizes && { ...sizes }, view: { ...own.view }, times: [] };
  });

  let waits = null;
  svg.addEventListener("pointermove", event => {
    if (!held) return;
    const here = placeOf(event);
    if (fingers.has(event.pointerId)) fingers.set(event.pointerId, here);
    if (held.pinch) {
      const [a, b] = held.from, [c, e] = [...fingers.values()];
      if (!c || !e) return;
      own.zoom(apart(c, e) / Math.max(1, apart(a, b)), /** @type {any} */ ([(c[0] + e[0]) / 2, (c[1] + e[1]) / 2]));
      held.from = [c, e];
      draw();
      return;
    }
    held.here = here;
    held.exact = event.altKey;
    held.ratio = event.shiftKey;
    held.moved ||= Math.hypot(here[0] - held.start[0], here[1] - held.start[1]) > 5;
    if (!held.moved || waits) return;
    waits = requestAnimationFrame(() => { waits = null; if (held) frame(); });
  });

  function frame() {
    const began = performance.now(), place = own.from(held.here);
    if (tool === "select") {
      if (["joint", "guide", "driver"].includes(held.kind)) pull(held.kind, held.name, place, held.exact, held.ratio);
      else {
        Object.assign(own.view, { x: held.view.x + held.here[0] - held.start[0], y: held.view.y + held.here[1] - held.start[1] });
        own.picture();
        draw();
        traced();
      }
    } else if (["slider", "guide", "link"].includes(tool)) own.sketch(held.start, held.here);
    held.times.push(performance.now() - began);
    svg.dataset.ms = String(held.times.reduce((a, b) => a + b, 0) / held.times.length);
  }

  function up(event) {
    fingers.delete(event.pointerId);
    if (!held) return;
    const own_ = held;
    if (own_.pinch) { if (!fingers.size) held = null; traced(); return; }
    if (waits) { cancelAnimationFrame(waits); waits = null; if (own_.moved && event.type === "pointerup") frame(); }
    held = null;
    own.sketch(null);
    if (event.type !== "pointerup") { if (own_.before && tool === "select") settle(own_.before); return; }
    if (tool === "select" && own_.moved) {
      if (own_.kind === "joint" && !edits.points(table).has(own_.name)) build();
      else if (sizes && own_.kind && own_.kind !== "link") released(own_.before);
      else if (!mech && own_.kind === "joint") commit(edits.moved(table, own_.name, places));
      return;
    }
    const [dx, dy] = [own_.here[0] - own_.start[0], own_.here[1] - own_.start[1]];
    const target = own_.moved ? own.hit(own_.here, event.pointerType) : [own_.kind, own_.name];
    const angle = own_.moved && Math.hypot(dx, dy) > 20 ? signed(Math.round(Math.atan2(-dy, dx) * 36 / Math.PI) * 5) : 0;
    if (tool === "link" && own_.moved) {  // from one place to another in one stroke
      first = own_.kind === "joint" ? own_.name : newPoint(own.from(own_.start));
      build();
      acted(target[0], target[1], own.from(own_.here), [...target, 0]);
      return;
    }
    acted(own_.kind, own_.name, own.from(own_.start), [...(own_.moved ? target : ["", ""]), angle]);
  }
  svg.addEventListener("pointerup", up);
  svg.addEventListener("pointercancel", up);
  svg.addEventListener("wheel", event => {
    event.preventDefault();
    own.zoom(Math.exp(-event.deltaY / 500), placeOf(event));
    draw();
    traced();
  }, { passive: false });

  // Sizes -------------------------------------------------------------------------------------------

  let edited = "";
  const perUnit = one => one.means[0] === "guide angle" ? 1 : 1000;  // degrees; millimetres of a metre
  /** What a field is of: a number of the model, or one that the file has of a drawing that does not move yet. */
  function sizeOf(name) {
    const one = mech?.parameters.get(name);
    if (one) return { said: spoken(one), value: sizes.values[name], factor: perUnit(one), unit: perUnit(one) === 1 ? "°" : W.of_length, low: perUnit(one) === 1 ? -Infinity : 0 };
    const [link, key] = name.split(" "), value = table.raw[link]?.[key];
    return typeof value === "number" ? { said: key, value: value / table.per, factor: 1000, unit: W.of_length, low: 0 } : null;
  }
  function openField(name) {
    const one = sizeOf(name), group = svg.querySelector(`[data-id="size ${CSS.escape(name)}"]`);
    if (!one || !group) return;
    edited = name;
    const { left, top } = byId("board-box").getBoundingClientRect(), place = group.getBoundingClientRect();
    field.hidden = false;
    field.style.left = `${Math.max(0, Math.min(place.left - left - 20, byId("board-box").clientWidth - 190))}px`;
    field.style.top = `${place.top - top - 6}px`;
    byId("size-name").textContent = `${one.said}, ${one.unit}`;
    byId("size").value = edits.tidy(one.value * one.factor);
    byId("size-lock").checked = locked.has(name);
    byId("size-lock").parentElement.hidden = !mech;
    field.dataset.before = JSON.stringify(one.value);
    byId("size").focus();
    byId("size").select();
  }
  function sized() {
    const one = edited && sizeOf(edited), value = one ? typedSize(one) : NaN;
    if (!mech || !Number.isFinite(value)) return;
    settle({ ...sizes, values: { ...sizes.values, [edited]: value } });
  }
  const typedSize = ({ factor, low }) => {
    const value = parseFloat(byId("size").value.replace(",", ".").replace("−", "-")) / factor;
    return value > low ? value : NaN;
  };
  function closeField() {
    if (!edited) return;
    const name = edited, before = JSON.parse(field.dataset.before), one = sizeOf(name);
    edited = "";
    field.hidden = true;
    if (!mech) {
      const [link, key, p, q] = name.split(" "), value = one ? typedSize(one) : NaN;
      if (!Number.isFinite(value) || value === before) { build(); return; }
      const free = q in table.fixed ? p : q, other = free === p ? q : p, [a, b] = [at(other), at(free)], times = value / (apart(a, b) || 1);
      places.set(free, [a[0] + (b[0] - a[0]) * times, a[1] + (b[1] - a[1]) * times]);
      commit([[["links", link, key], edits.tidy(value * table.per)]]);
    } else if (mech && sizes.values[name] !== before) commit([[mech.parameters.get(name).key, edits.tidy(sizes.values[name] * mech.parameters.get(name).per)]]);
    else build();
  }
  byId("size").addEventListener("input", sized);
  byId("size").addEventListener("keydown", event => {
    if (event.key === "Enter") { const name = edited; closeField(); svg.querySelector(`[data-id="size ${CSS.escape(name)}"]`)?.focus(); }
    if (event.key === "Escape") {
      const before = JSON.parse(field.dataset.before);
      byId("size").value = String(edits.tidy(before * (sizeOf(edited)?.factor ?? 1000)));
      if (mech) settle({ ...sizes, values: { ...sizes.values, [edited]: before } });
      closeField();
    }
    if (["ArrowUp", "ArrowDown"].includes(event.key)) {
      event.preventDefault();
      byId("size").value = String(edits.tidy(parseFloat(byId("size").value) + (event.key === "ArrowUp" ? 1 : -1) * (step() * 1000 || 1) * (event.shiftKey ? 10 : 1)));
      sized();
    }
  });
  byId("size-lock").addEventListener("change", event => { if (event.target.checked) locked.add(edited); else locked.delete(edited); });
  field.addEventListener("focusout", event => { if (!field.contains(event.relatedTarget)) closeField(); });

  // Keys and buttons --------------------------------------------------------------------------------

  function turnTo(name) {
    tool = name;
    first = chosen = "";
    if (tool !== "select" && mech && sizes.x !== model.driver.first) settle({ ...sizes, x: model.driver.first });
    build();
    tell();
  }
  for (const one of byId("tools").querySelectorAll("[data-tool]")) one.addEventListener("click", () => turnTo(one.dataset.tool));
  panel.addEventListener("keydown", event => {
    if (event.target.matches?.("input, select")) return;
    if (event.ctrlKey || event.metaKey) {
      if (event.code === "KeyZ" || event.code === "KeyY") {
        event.preventDefault();
        if (event.code === "KeyZ" && !event.shiftKey) typed.undo(); else typed.redo();
      }
      return;
    }
    if (event.target === svg && pointed(event)) { event.preventDefault(); return; }
    const id = event.target.dataset?.id || "", arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (arrows && (id.startsWith("joint ") || id === "driver")) {
      event.preventDefault();
      keyed(id, arrows, event.shiftKey ? 10 : 1);
    } else if (event.key === "Enter" || event.key === " ") {
      if (id.startsWith("size ")) { event.preventDefault(); openField(id.slice(5)); }
      else if (id.startsWith("joint ")) { event.preventDefault(); acted("joint", id.slice(6), at(id.slice(6)), ["", "", 0]); }
    } else if (event.key === "Escape") { first = chosen = ""; own.sketch(null); build(); } else if (event.key === "Delete" && chosen) {
      const [kind, ...name] = chosen.split(" "), back = tool;
      tool = "delete";
      acted(kind, name.join(" "), [0, 0], ["", "", 0]);
      tool = back;
    } else {
      const wanted = KEYS[event.key.toLowerCase()] || KEYS[event.code.replace("Key", "").toLowerCase()];
      if (wanted) { event.preventDefault(); turnTo(wanted); }
    }
  });

  let cursor = null;  // the pointer of who has no mouse, pixels of the board
  function pointed(event) {
    const { width, height } = svg.getBoundingClientRect(), far = event.shiftKey ? 50 : 10;
    const by = { ArrowLeft: [-far, 0], ArrowRight: [far, 0], ArrowUp: [0, -far], ArrowDown: [0, far] }[event.key];
    if (by) {
      const [x, y] = cursor || [width / 2, height / 2];
      cursor = [Math.min(width, Math.max(0, x + by[0])), Math.min(height, Math.max(0, y + by[1]))];
    } else if (event.key === "Enter" || event.key === " ") {
      cursor ||= [width / 2, height / 2];
      const [kind, name] = own.hit(cursor);
      acted(kind, name, own.from(cursor), ["", "", 0]);
    } else return false;
    own.cursor(cursor);
    return true;
  }
  svg.addEventListener("blur", () => own.cursor(null));

  let keysBefore = null, keysPause = 0;
  function keyed(id, [dx, dy], times) {  // several presses are one change of the text
    keysBefore ??= sizes && { ...sizes };
    const size = (step() || 0.001) * times;
    if (id === "driver") settle({ ...sizes, x: model.driver.pivot ? Math.round(sizes.x) + (dx + dy) * times : sizes.x + (dx + dy) * size });
    else { const [x, y] = at(id.slice(6)); pull("joint", id.slice(6), [x + dx * size, y + dy * size], true); }
    clearTimeout(keysPause);
    keysPause = setTimeout(() => {
      const before = keysBefore;
      keysBefore = null;
      if (before && mech) released(before); else if (id !== "driver") commit(edits.moved(table, id.slice(6), places));
    }, 400);
  }

  byId("phi").addEventListener("input", event => { if (mech) settle({ ...sizes, x: +event.target.value }); });
  byId("draw-undo").addEventListener("click", () => typed.undo());
  byId("draw-redo").addEventListener("click", () => typed.redo());
  byId("draw-fit").addEventListener("click", fit);
  const traces = byId("trace-picture");
  traces.addEventListener("click", () => {
    if (traces.textContent === W.trace_picture) { byId("traced").click(); return; }
    own.picture("");
    traces.textContent = W.trace_picture;
  });
  byId("traced").addEventListener("change", event => {
    const [file] = event.target.files;
    own.picture(file ? URL.createObjectURL(file) : "");
    traces.textContent = file ? W.no_picture : W.trace_picture;
    event.target.value = "";
  });
  byId("share-text").addEventListener("click", async () => {
    const address = await edits.shared(typed.text(), problem().name);
    history.replaceState(null, "", address);
    await navigator.clipboard?.writeText(address).catch(() => {});
    note(W.shared);
  });
  new ResizeObserver(() => { if (!panel.hidden && !fitted && places.size) { fitted = true; fit(); } }).observe(svg);

  return {
    changed(whole) { if (whole !== text) soon(); },
    open() { if (typed.text() !== text) { fitted &&= Boolean(text); soon(0); } else { draw(); } if (!table.n && !typed.text().trim()) turnTo("link"); },
    forget() { places.clear(); pending.clear(); locked.clear(); model = mech = sizes = text = null; table = edits.empty(); fitted = false; why = ""; plans.replaceChildren(); views = []; build(); own.traces([]); },
    state: () => ({ table, model, sizes, places: Object.fromEntries(places), tool, writing, held: Boolean(held), why, view: own.view }),
    to: own.to,
  };
}
