// The board of the drawing room: what is drawn, and which of it is under a finger. Pixels, y down.
import { path } from "./geometry.js";
import { said } from "./numbers.js";
import { rich, shape } from "./svg.js";

/** @typedef {[number, number]} Place */

const BLOCK = [15, 9], PIVOT = 13, FAR = 4000, ARROW = 70;  // px: half of a slider, a support, a line without end, a force
const REACH = { mouse: 11, touch: 24 };  // px: of a joint

/** @type {(p: Place, a: Place, b: Place) => number} */
function beside([x, y], [ax, ay], [bx, by]) {
  const dx = bx - ax, dy = by - ay, square = dx * dx + dy * dy;
  const t = square ? Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / square)) : 0;
  return Math.hypot(x - ax - t * dx, y - ay - t * dy);
}

/** Return a board in an SVG element.
 * @param {any} svg
 * @param {{ say: (key: string, facts?: any) => string }} words */
export function board(svg, { say }) {
  const layers = Object.fromEntries(["grid", "picture", "guides", "traces", "links", "grounds", "blocks", "joints", "loads", "letters", "sizes", "marks"]
    .map(name => [name, shape(svg, "g", name)]));
  const view = { scale: 1500, x: 200, y: 260 };
  let moving = [], shown = null;

  /** @type {(place: Place) => Place} */
  const to = ([x, y]) => [view.x + view.scale * x, view.y - view.scale * y];
  /** @type {(place: Place) => Place} */
  const from = ([x, y]) => [(x - view.x) / view.scale, (view.y - y) / view.scale];
  const set = (node, values) => { for (const [key, value] of Object.entries(values)) node.setAttribute(key, value); return node; };
  const d = (node, points, closed = false) => node.setAttribute("d", points.length && points.every(p => p && Number.isFinite(p[0] + p[1])) ? path(points) + (closed ? "Z" : "") : "");

  /** Draw anew what there is: links with their points, joints, slides, guides, sizes.
   * @param {{ links: Record<string, string[]>, fixed: Set<string>, slides: any[], guides: any[], sizes: any[], loads: any[], driver: any,
   *   at: (point: string) => Place, chosen: string, first: string }} scene */
  function build(scene) {
    const focus = document.activeElement?.closest?.("#board [data-id]")?.getAttribute("data-id");
    shown = scene;
    moving = [];
    for (const [name, layer] of Object.entries(layers)) if (!["grid", "picture", "traces"].includes(name)) layer.replaceChildren();
    for (const guide of scene.guides) {
      const line = shape(layers.guides, "path", "guide" + (scene.chosen === `guide ${guide.label}` ? " chosen" : ""));
      const name = shape(layers.letters, "text", "letter faint");
      name.textContent = guide.label;
      moving.push(() => {
        const { through, heading } = guide.now(), [x, y] = to(through), c = Math.cos(heading * Math.PI / 180), s = Math.sin(heading * Math.PI / 180);
        d(line, [[x - FAR * c, y + FAR * s], [x + FAR * c, y - FAR * s]]);
        set(name, { x: x + 46 * c + 8 * s, y: y - 46 * s - 8 * Math.abs(c) });
      });
    }
    for (const [link, points] of Object.entries(scene.links)) {
      if (points.length < 2) continue;
      const cls = `bar${scene.driver?.link === link ? " driving" : ""}${scene.chosen === `link ${link}` ? " chosen" : ""}`;
      const line = shape(layers.links, "path", cls);
      moving.push(() => d(line, points.map(p => to(scene.at(p))), points.length > 2));
    }
    for (const slide of scene.slides) {
      const [w, h] = BLOCK, block = shape(layers.blocks, "path", "block" + (scene.chosen === `link ${slide.slider}` ? " chosen" : ""));
      d(block, [[-w, -h], [w, -h], [w, h], [-w, h]], true);
      moving.push(() => {
        const [x, y] = to(scene.at(slide.pin));
        if (Number.isFinite(x + y)) block.setAttribute("transform", `translate(${x} ${y}) rotate(${-slide.heading()})`);
      });
    }
    for (const point of scene.fixed) {
      const base = shape(layers.grounds, "path", "ground");
      base.setAttribute("d", `M0 0L-${PIVOT} ${PIVOT + 6}H${PIVOT}Z` + [-10, -4, 2, 8].map(x => `M${x} ${PIVOT + 6}l-5 6`).join(""));
      moving.push(() => { const [x, y] = to(scene.at(point)); base.setAttribute("transform", `translate(${x} ${y})`); });
    }
    const joints = new Set([...Object.values(scene.links).flat(), ...scene.fixed]);
    for (const point of joints) {
      const chosen = scene.chosen === `joint ${point}` || scene.first === point ? " chosen" : "";
      const circle = set(shape(layers.joints, "circle", "joint" + chosen), { r: 5.5, tabindex: 0, role: "button",
        "aria-label": say("joint_named", { name: point }), "data-id": `joint ${point}` });
      const name = shape(layers.letters, "text", "letter");
      name.textContent = point;
      moving.push(() => {
        const [x, y] = to(scene.at(point));
        if (!Number.isFinite(x + y)) return;
        set(circle, { cx: x, cy: y });
        const left = scene.driver?.end?.() === point && scene.driver.handle;  // the handle is on the other side
        set(name, { x: left ? x - 9 : x + 9, y: y - 9, "text-anchor": left ? "end" : "start" });
      });
    }
    for (const [k, load] of scene.loads.entries()) {
      if (!joints.has(load.at) || typeof load.angle !== "number") continue;  // a load against a motion has no direction yet
      const arrow = shape(layers.loads, "path", "load"), head = shape(layers.loads, "path", "load head"), name = shape(layers.letters, "text", "letter");
      name.textContent = typeof load.force === "number" ? say("force_of", { force: load.force }) : "";
      d(head, [[0, 0], [-12, -4], [-12, 4]], true);
      moving.push(() => {
        const [x, y] = to(scene.at(load.at)), turned = load.angle * Math.PI / 180, c = Math.cos(turned), s = Math.sin(turned);
        if (!Number.isFinite(x + y)) return;
        d(arrow, [tail(load, [x, y]), [x - 8 * c, y + 8 * s]]);
        head.setAttribute("transform", `translate(${x - 6 * c} ${y + 6 * s}) rotate(${-load.angle})`);
        const [tx, ty] = tail(load, [x, y]);
        set(name, { x: tx + 6, y: ty - 6 });
      });
      arrow.dataset.load = String(k);
    }
    for (const size of scene.sizes) {
      const group = set(shape(layers.sizes, "g", "size" + (size.locked ? " locked" : "")), { tabindex: 0, role: "button", "data-id": `size ${size.name}` });
      const box = shape(group, "rect"), text = shape(group, "text");
      moving.push(() => {
        const told = size.told(), [x, y] = to(size.middle());
        if (text.textContent !== told) {
          text.textContent = told;
          set(group, { "aria-label": say("size_named", { name: size.spoken, value: told }) });
        }
        const wide = 7.6 * told.length + 8;
        set(box, { x: -wide / 2, y: -10, width: wide, height: 20, rx: 4 });
        if (Number.isFinite(x + y)) group.setAttribute("transform", `translate(${x} ${y})`);
      });
    }
    if (scene.driver?.handle) {
      const arm = shape(layers.marks, "path", "arm");
      const knob = set(shape(layers.marks, "circle", "knob"), { r: 8, tabindex: 0, role: "slider", "data-id": "driver",
        "aria-label": say("position"), ...(scene.driver.turns ? { "aria-valuemin": 0, "aria-valuemax": 360 } : {}) });
      moving.push(() => {
        const [[px, py], [x, y]] = scene.driver.handle().map(to), long = Math.hypot(x - px, y - py) || 1;
        const end = [x + (x - px) / long * 30, y + (y - py) / long * 30];
        d(arm, [[x, y], end]);
        set(knob, { cx: end[0], cy: end[1], "aria-valuenow": scene.driver.turns ? Math.round(((scene.driver.x() % 360) + 360) % 360) : +scene.driver.x().toFixed(4) });
      });
    }
    draw();
    if (focus) /** @type {any} */ (svg.querySelector(`[data-id="${CSS.escape(focus)}"]`))?.focus({ preventScroll: true });
  }

  function draw() { grid(); for (const act of moving) act(); }

  /** @type {(load: any, head: Place) => Place} */
  const tail = (load, [x, y]) => [x - ARROW * Math.cos(load.angle * Math.PI / 180), y + ARROW * Math.sin(load.angle * Math.PI / 180)];

  /** Turn a force so that its arrow comes from a place of the screen; its angle, whole steps of 5°.
   * @type {(name: string, from: Place) => number} */
  function turned(name, [x, y]) {
    const load = shown.loads[+name], [hx, hy] = to(shown.at(load.at));
    return load.angle = Math.round(Math.atan2(y - hy, hx - x) * 36 / Math.PI) * 5;
  }

  let ruled = "";
  const lines = shape(layers.grid, "path", "ruling"), axes = shape(layers.grid, "path", "ruling axis"), size = shape(layers.grid, "text", "unit");
  function grid() {  // squares of a round number of millimetres
    const { clientWidth: width, clientHeight: height } = svg, now = `${view.x} ${view.y} ${view.scale} ${width} ${height}`;
    if (now === ruled || !width) return;
    ruled = now;
    const least = 36 / view.scale, power = 10 ** Math.floor(Math.log10(least)), pitch = [1, 2, 5, 10].map(n => n * power).find(n => n >= least) ?? 10 * power;
    const [from_, to_] = [from([0, height]), from([width, 0])], told = [];
    for (let k = Math.ceil(from_[0] / pitch); k * pitch <= to_[0]; k++) told.push(`M${to([k * pitch, 0])[0].toFixed(1)} 0V${height}`);
    for (let k = Math.ceil(from_[1] / pitch); k * pitch <= to_[1]; k++) told.push(`M0 ${to([0, k * pitch])[1].toFixed(1)}H${width}`);
    lines.setAttribute("d", told.join(""));
    const [x, y] = to([0, 0]);
    axes.setAttribute("d", `M${x.toFixed(1)} 0V${height}M0 ${y.toFixed(1)}H${width}`);
    set(size, { x: 6, y: height - 6 }).textContent = say("square_of", { size: +(pitch * 1000).toPrecision(3) });
  }

  /** @type {(lines: (Place | null)[][]) => void} */
  function traces(lines) {
    while (layers.traces.children.length < lines.length) shape(layers.traces, "path", "way");
    [...layers.traces.children].forEach((node, k) => {
      let told = "", on = false;
      for (const place of lines[k] || []) {
        if (place) { const [x, y] = to(place); told += `${on ? "L" : "M"}${x.toFixed(1)} ${y.toFixed(1)}`; }
        on = Boolean(place);
      }
      node.setAttribute("d", told);
    });
  }

  /** What is under a place of the screen: `[kind, name]`.
   * @type {(place: Place, pointer?: string) => [string, string]} */
  function hit(place, pointer = "mouse") {
    if (!shown) return ["", ""];
    const reach = pointer === "mouse" ? REACH.mouse : REACH.touch;
    /** @type {[string, string, number][]} */
    const near = [];
    for (const point of new Set([...Object.values(shown.links).flat(), ...shown.fixed])) {
      const [x, y] = to(shown.at(point));
      near.push(["joint", point, Math.hypot(x - place[0], y - place[1])]);
    }
    const knob = layers.marks.querySelector(".knob");
    if (knob) near.push(["driver", "", Math.hypot(+knob.getAttribute("cx") - place[0], +knob.getAttribute("cy") - place[1])]);
    for (const node of layers.loads.querySelectorAll("[data-load]")) {
      const name = /** @type {any} */ (node).dataset.load, load = shown.loads[+name], end = tail(load, to(shown.at(load.at)));
      near.push(["load", name, Math.hypot(end[0] - place[0], end[1] - place[1])]);
    }
    const best = near.sort((a, b) => a[2] - b[2])[0];
    if (best && best[2] <= reach) return [best[0], best[1]];
    for (const [link, points] of Object.entries(shown.links)) {
      const ends = points.map(p => to(shown.at(p)));
      if (ends.some((a, k) => k && beside(place, ends[k - 1], a) < reach * 0.8) ||
        (ends.length > 2 && beside(place, ends[0], ends[ends.length - 1]) < reach * 0.8)) return ["link", link];
    }
    for (const slide of shown.slides) {
      const [x, y] = to(shown.at(slide.pin));
      if (Math.hypot(x - place[0], y - place[1]) < 18) return ["link", slide.slider];
    }
    for (const guide of shown.guides) {
      const { through, heading } = guide.now(), [x, y] = to(through), c = Math.cos(heading * Math.PI / 180), s = Math.sin(heading * Math.PI / 180);
      if (Math.abs((place[0] - x) * s + (place[1] - y) * c) < reach * 0.8) return ["guide", guide.label];
    }
    return ["", ""];
  }

  /** Whether all points are in the picture.
   * @type {(points: Place[]) => boolean} */
  const holds = points => points.map(to).every(([x, y]) => x > 0 && y > 0 && x < svg.clientWidth && y < svg.clientHeight);

  /** Let coordinates begin at a place; nothing moves on the screen.
   * @type {(origin: Place) => void} */
  function shift([x, y]) {
    view.x += view.scale * x;
    view.y -= view.scale * y;
    if (under) under.place = under.place.map(([px, py]) => [px - x, py - y]);
  }

  /** Show all points.
   * @type {(points: Place[]) => void} */
  function fit(points) {
    const { width, height } = svg.getBoundingClientRect(), real = points.filter(p => Number.isFinite(p[0] + p[1]));
    if (!real.length || !width) return;
    const [x0, x1, y0, y1] = [0, 1].flatMap(k => [Math.min(...real.map(p => p[k])), Math.max(...real.map(p => p[k]))]);
    view.scale = Math.min((width - 110) / Math.max(x1 - x0, 0.02), (height - 110) / Math.max(y1 - y0, 0.02), 8000);
    view.x = width / 2 - view.scale * (x0 + x1) / 2;
    view.y = height / 2 + view.scale * (y0 + y1) / 2;
  }

  /** @type {(times: number, about: Place) => void} */
  function zoom(times, [x, y]) {
    const next = Math.min(60000, Math.max(20, view.scale * times)), real = next / view.scale;
    view.x = x + (view.x - x) * real;
    view.y = y + (view.y - y) * real;
    view.scale = next;
    picture();
  }

  let under = null;  // of the textbook, to draw over
  /** @param {string} [address] */
  function picture(address) {
    if (address !== undefined) {
      layers.picture.replaceChildren();
      under = address ? set(shape(layers.picture, "image"), { href: address, opacity: 0.45, preserveAspectRatio: "xMinYMin meet" }) : null;
      const { width, height } = svg.getBoundingClientRect();
      if (under) under.place = [from([20, 20]), from([width - 20, height - 20])];
    }
    if (!under) return;
    const [[x, y], [x1, y1]] = under.place.map(to);
    set(under, { x, y, width: x1 - x, height: y1 - y });
  }

  /** @param {Place | null} a
   * @param {Place | null} [b] */
  function sketch(a, b = null) {  // the line that is being drawn
    const line = layers.marks.querySelector(".drawing") || shape(layers.marks, "path", "drawing");
    d(line, a && b ? [a, b] : []);
    if (!a) line.remove();
  }

  /** @param {Place | null} at */
  function cursor(at) {  // of the keyboard
    const cross = layers.marks.querySelector(".cursor") || shape(layers.marks, "path", "cursor");
    if (at) set(cross, { d: `M${at[0] - 12} ${at[1]}h24M${at[0]} ${at[1] - 12}v24` }); else cross.remove();
  }

  return { build, draw, turned, holds, shift, traces, hit, fit, zoom, picture, sketch, cursor, to, from, view };
}

/** Make the picture of a plan, which views.js draws.
 * @param {any} parent
 * @param {any} view */
export function planned(parent, view) {
  const figure = parent.appendChild(document.createElement("figure")), caption = figure.appendChild(document.createElement("figcaption"));
  rich(caption.appendChild(document.createElement("span")), view.title);
  caption.appendChild(document.createElement("small")).id = `zoom-${view.id}`;
  const svg = shape(figure, "svg");
  svg.id = `svg-${view.id}`;
  Object.assign(view, { per_mm: 1, box: [0, 0, 105, 80], turns: [], pushes: [], fixed: [], blocks: [], rods: [], supports: [], zooms: true });
  svg.setAttribute("viewBox", view.box.join(" "));
  shape(svg, "g", "lines");
  view.labels.forEach((one, k) => {
    const label = shape(svg, "g");
    label.id = `label-${view.id}-${k}`;
    const text = shape(label, "text", "letter");
    for (const [letters, kind] of one.text) {
      const run = shape(text, "tspan");
      run.textContent = letters;
      if (kind) { run.setAttribute("font-size", "70%"); run.setAttribute("baseline-shift", kind === "sub" ? "-25%" : "35%"); }
    }
    const told = one.text.map(run => run[0]).join("");
    label.setAttribute("role", "img");
    label.setAttribute("aria-label", told);
    Object.assign(one, { width: 2.6 * told.length + 0.5, up: 3.6, down: 1, gap: 1.2 });
  });
  figure.appendChild(document.createElement("output")).id = `told-${view.id}`;
  view.values = figure.appendChild(document.createElement("p"));
  return figure;
}

/** Write the values of all vectors of a plan below it.
 * @param {any} view */
export function listed(view) {
  const there = view.segments.filter(one => one.symbol && one.ends && !one.covered);
  rich(view.values, ...there.flatMap(({ symbol, a, b }, k) => [k ? ";  " : "", symbol,
    `\u00a0=\u00a0${said(Math.hypot(view.now[b[0]] - view.now[a[0]], view.now[b[0] + 1] - view.now[a[0] + 1]), 3)}`]), " ", there.length ? view.unit : "");
}
