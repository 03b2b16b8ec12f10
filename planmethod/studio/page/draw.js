// The drawing room: a mechanism drawn and moved by hand. Every act is a small change of the text, which it follows in turn.
import { W, byId, compute, faultText, note, say } from "./api.js";
import { board, listed, planned } from "./board.js";
import { dimensions } from "./dimensions.js";
import { apart, mechanism, signed, toward } from "./drag.js";
import * as edits from "./edits.js";
import { hands } from "./hands.js";
import { keys } from "./keys.js";
import { decimals } from "./numbers.js";
import { between, patched } from "./patch.js";
import { draw as drawView, prepare } from "./views.js";

const PAUSE = 250, ROUNDS = 90;  // ms without a letter; positions of a way of a point
const READ = 120;  // ms: values below plans change no faster under the hand
const PACE = 0.06, BACK = 100;  // degrees a millisecond of a crank that is played; texts whose picture comes back
const HINTS = { select: W.hint_select, joint: W.hint_joint, link: W.hint_link, slider: W.hint_slider, guide: W.hint_guide,
  ground: W.hint_ground, driver: W.hint_driver, load: W.hint_load, delete: W.hint_delete };
const MISSING = { frame: W.missing_frame, driver: W.missing_driver };

/** The room, on the texts of an editor.
 * @param {any} typed
 * @param {() => any} problem
 * @param {(found: any) => void} [heard] is told what the server says of a text */
export function drawing(typed, problem, heard = () => {}) {
  const svg = byId("board"), panel = byId("drawing"), told = byId("draw-told");
  const own = board(svg, { say });
  const plans = byId("plans");
  let table = edits.empty(), model = null, mech = null, sizes = null, text = null, faults = [];
  /** @type {Map<string, [number, number]>} */
  const places = new Map();  // of all points, as they are drawn
  const pending = new Set();  // points that no link has yet
  /** @type {Map<string, [string, [number, number]][]>} */
  const pictures = new Map();  // of texts, as they were drawn
  let tool = "select", chosen = "", first = "", views = [], asked = 0, fitted = false, why = "", read = 0;
  decimals(W.decimal);

  // The model ---------------------------------------------------------------------------------------

  const at = point => places.get(point) || /** @type {[number, number]} */ ([NaN, NaN]);
  const step = () => Math.max(0, +byId("step").value || 0) / 1000;

  const fields = dimensions(svg, { now: () => ({ mech, model, sizes, table }), at, places, scale: () => own.view.scale, step, settle, build, commit });
  let pointer = null;  // of the keyboard

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
    const was = Boolean(mech), before = model && model.driver.link === found.model?.driver.link ? sizes?.x : null;
    model = found.model?.tape ? found.model : null;
    mech = model ? mechanism(model) : null;
    sizes = mech ? mech.given() : null;
    if (sizes && before !== null && before !== undefined && !model.driver.single) sizes.x = before;
    const there = edits.points(table), back = typed.undone() && pictures.get(whole);
    if (back) for (const [point, place] of back) places.set(point, place);
    for (const point of places.keys()) if (!there.has(point) && !pending.has(point)) places.delete(point);
    for (const point of there) pending.delete(point);
    for (const [point, place] of Object.entries({ ...found.fixed, ...found.model?.places })) places.set(point, place);
    posed();
    edits.guess(table, places);
    pictures.delete(whole);
    pictures.set(whole, [...places].filter(([point]) => there.has(point)));
    if (pictures.size > BACK) pictures.delete(pictures.keys().next().value);
    if (model) show();
    byId("plans").replaceChildren();
    views = mech ? model.views.map(view => {
      planned(plans, view);
      prepare(view, { words: { touch: " " }, peak: [] });
      return view;
    }) : [];
    build();
    draw();
    traced();
    if ((!fitted || (mech && !was && !own.holds(ways()))) && places.size) { fitted = true; fit(); }
    tell(found.model && !model ? W[`no_tape_${found.model.no_tape}`] : "");
  }

  function show() {
    const slider = byId("phi"), crank = model.driver.crank;
    byId("phi-of").hidden = !crank;
    slider.value = crank ? ((sizes.x % 360) + 360) % 360 : 0;
    byId("phi-told").textContent = crank ? `${Math.round(slider.value)}°` : "";
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
    pause = setTimeout(() => { if (!panel.hidden && !held()) refresh().catch(error => note(error.message)); }, wait);
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
      sizes: fields.shown(), loads: table.loads,
      driver: { link: table.driver.link, end: () => end || slider?.pin, x: () => sizes?.x ?? 0, turns: !slider,
        handle: end && model.driver.crank ? () => [at(pivot), at(end)] : slider ? () => [behind(slider), at(slider.pin)] : null },
    });
    pointer?.again();
    for (const one of byId("tools").querySelectorAll("[data-tool]")) one.setAttribute("aria-pressed", String(one.dataset.tool === tool));
  }

  function behind(slider) {  // a place behind a driving slider, so that its handle is ahead of it
    const [x, y] = at(slider.pin), [dx, dy] = toward(mech.guide(slider, sizes.values).heading, 1e-3);
    return [x - dx, y - dy];
  }

  function traced() {
    if (!mech || !model.driver.crank) { own.traces([]); return; }
    const points = model.order.filter(point => !table.fixed[point] && edits.points(table).has(point));
    own.traces(mech.ways(sizes, points, Array.from({ length: ROUNDS + 1 }, (_, k) => 360 * k / ROUNDS)));
  }

  function draw() {
    own.draw();
    if (sizes?.out) for (const view of views) drawView(view, sizes.out);
    if (sizes?.out && (!held() || performance.now() - read > READ)) { read = performance.now(); views.forEach(listed); }
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
    const all = parts.join(" ");
    if (told.textContent !== all) told.textContent = all;
    told.classList.toggle("bad", Boolean(why));
    if (byId("draw-hint").textContent !== HINTS[tool]) byId("draw-hint").textContent = HINTS[tool];
  }

  function ways() {  // where points of the mechanism come to
    if (!mech) return [];
    const around = model.driver.crank ? [0, 60, 120, 180, 240, 300] : model.driver.positions;
    return mech.ways(sizes, [...edits.points(table)].filter(p => places.has(p)), around).flat().filter(Boolean);
  }

  function fit() {
    own.fit([...places.values(), ...ways()]);
    own.picture();
    draw();
    traced();
  }

  // Dragging ----------------------------------------------------------------------------------------

  const round = value => step() ? Math.round(value / step()) * step() : value;
  /** @type {(place: [number, number]) => [number, number]} */
  const snapped = place => [round(place[0]), round(place[1])];

  function pull(kind, name, place, exact, from) {
    const how = { step: exact ? 0 : step(), locked: fields.locked, from };
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
    const old = sizes;
    sizes = next;
    const closes = posed();
    if (!closes) sizes = old;
    draw();
    if (sizes.values !== old.values || sizes.sides !== old.sides) traced();  // the driver alone changes no way
    if (mech) show();
    told.classList.toggle("bad", Boolean(why));
    tell();
    return closes;
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

  function begins([x, y]) {  // coordinates begin at the first fixed joint; the picture stays
    for (const [point, [px, py]] of places) places.set(point, [edits.tidy(px - x), edits.tidy(py - y)]);
    for (const picture of pictures.values()) picture.forEach(one => { one[1] = [edits.tidy(one[1][0] - x), edits.tidy(one[1][1] - y)]; });
    own.shift([x, y]);
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
      case "ground":
        if (kind === "joint" || !kind) {
          const end = point(), moves = edits.isFirst(table, end) ? edits.shifted(table, at(end)) : [];
          if (edits.isFirst(table, end)) begins(at(end));
          change([...moves, ...edits.ground(table, end, snapped(at(end)))]);
        }
        return;
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

  const held = hands(svg, {
    board: own,
    before: () => sizes && { ...sizes },
    pressed(event) {
      const size = event.target.closest?.(".size");
      if (size && tool === "select") { fields.open(size.dataset.id.slice(5)); return true; }
      if (event.button) return true;
      fields.close();
      play(false);
      return false;
    },
    moves({ kind, name, here, start, exact, ratio, before }) {
      if (tool !== "select") {
        if (["slider", "guide", "link"].includes(tool)) own.sketch(start, here);
        return true;
      }
      if (kind === "load") { own.turned(name, here); draw(); return true; }
      if (!["joint", "guide", "driver"].includes(kind)) return false;
      pull(kind, name, own.from(here), exact, ratio ? before?.values : undefined);
      return true;
    },
    seen() { draw(); traced(); },
    left({ before }) {
      own.sketch(null);
      if (before && tool === "select") settle(before);
    },
    dropped({ kind, name, here, start, moved, before }, finger) {
      own.sketch(null);
      if (tool === "select" && moved) {
        if (kind === "load") commit([[["loads", +name, "angle"], own.turned(name, here)]], { asks: false });
        else if (kind === "joint" && !edits.points(table).has(name)) build();
        else if (sizes && kind && kind !== "link") released(before);
        else if (!mech && kind === "joint") commit(edits.moved(table, name, places));
        return;
      }
      const [dx, dy] = [here[0] - start[0], here[1] - start[1]], target = moved ? own.hit(here, finger) : [kind, name];
      const angle = moved && Math.hypot(dx, dy) > 20 ? signed(Math.round(Math.atan2(-dy, dx) * 36 / Math.PI) * 5) : 0;
      if (tool === "link" && moved) {  // from one place to another in one stroke
        first = kind === "joint" ? name : newPoint(own.from(start));
        build();
        acted(target[0], target[1], own.from(here), [...target, 0]);
        return;
      }
      acted(kind, name, own.from(start), [...(moved ? target : ["", ""]), angle]);
    },
  });

  // Keys and buttons --------------------------------------------------------------------------------

  function turnTo(name) {
    tool = name;
    first = chosen = "";
    if (tool !== "select" && mech && sizes.x !== model.driver.first) settle({ ...sizes, x: model.driver.first });
    build();
    tell();
  }
  for (const one of byId("tools").querySelectorAll("[data-tool]")) one.addEventListener("click", () => turnTo(one.dataset.tool));
  let before = null, nudges = "";  // by keys: several presses are one change of the text
  function nudge(id, [dx, dy], times) {
    before ??= sizes && { ...sizes };
    nudges = id;
    const size = (step() || 0.001) * times;
    if (id === "driver") settle({ ...sizes, x: model.driver.pivot ? Math.round(sizes.x) + (dx + dy) * times : sizes.x + (dx + dy) * size });
    else { const [x, y] = at(id.slice(6)); pull("joint", id.slice(6), [x + dx * size, y + dy * size], true); }
  }
  function nudged() {
    const own_ = before;
    before = null;
    if (own_ && mech) released(own_); else if (nudges !== "driver") commit(edits.moved(table, nudges.slice(6), places));
  }
  function remove() {
    const [kind, ...name] = chosen.split(" "), back = tool;
    if (!kind) return false;
    tool = "delete";
    acted(kind, name.join(" "), [0, 0], ["", "", 0]);
    tool = back;
    return true;
  }
  pointer = keys(svg, { board: own, typed, turnTo, acted, at, nudge, nudged, remove, open: fields.open,
    leave() { first = chosen = ""; own.sketch(null); build(); } });

  // The mechanism moves by itself ----------------------------------------------------------------------

  let playing = 0, way = 1, last = 0;
  function play(is) {
    cancelAnimationFrame(playing);
    playing = 0;
    byId("draw-play").setAttribute("aria-pressed", String(is));
    last = performance.now();
    if (is) playing = requestAnimationFrame(turn);
  }
  function turn(time) {
    if (!mech || !model.driver.crank || panel.hidden) { play(false); return; }
    const far = Math.min(50, Math.max(0, time - last)) * PACE;
    last = time;
    if (!settle({ ...sizes, x: sizes.x + way * far })) {  // it does not close there: back again
      way = -way;
      why = "";
      tell();
    }
    playing = requestAnimationFrame(turn);
  }
  byId("draw-play").addEventListener("click", () => play(!playing));
  byId("draw-full").addEventListener("click", () => { if (document.fullscreenElement) document.exitFullscreen(); else panel.requestFullscreen?.().catch(() => {}); });
  document.addEventListener("fullscreenchange", () => { byId("draw-full").setAttribute("aria-pressed", String(Boolean(document.fullscreenElement))); fit(); });

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
    forget() { places.clear(); pending.clear(); fields.locked.clear(); pictures.clear(); model = mech = sizes = text = null; table = edits.empty(); fitted = false; why = ""; plans.replaceChildren(); views = []; build(); own.traces([]); },
    state: () => ({ table, model, sizes, places: Object.fromEntries(places), tool, writing, held: Boolean(held()), why, view: own.view }),
    to: own.to,
  };
}
