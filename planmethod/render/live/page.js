"use strict";
// The page of a moving mechanism. `run` and `loads` above are the program's own tapes; here is only
// where their numbers are drawn. Everything is in millimetres of a view, y down.
const D = JSON.parse(document.getElementById("scene").textContent);
const SVG = "http://www.w3.org/2000/svg", byId = id => document.getElementById(id);
const TURN = 360, SLACK = 1e-9, SAMPLES = 720;

// Numbers -----------------------------------------------------------------------------------------

function branch(one, x) {  // which side of its line a closing is on, or near what a link is held
  if (one.places) return followed(one, x);
  if (one.counts) return counted(one, x);
  const passed = one.changes.reduce((n, change) =>
    n + Math.floor((x - change) / one.turn) - Math.floor((one.start - change) / one.turn), 0);
  return passed % 2 === 0 ? 1 : -1;
}

function counted(one, x) {  // degrees of whole turns, added to an angle that is read
  const whole = one.turn ? Math.floor((x - one.low) / one.turn) : 0, here = x - whole * one.turn;
  const passed = one.jumps.filter(jump => jump <= here).length;
  return 360 * (one.counts[passed] + whole * one.net);
}

function followed(one, x) {  // between two positions that an assembly was followed through
  const { places, values } = one, low = places[0];
  if (one.turn) x = low + within(x, low, one.turn);
  const k = Math.min(places.findIndex(place => place > x) >>> 0, places.length - 1);
  const share = (x - places[k - 1]) / (places[k] - places[k - 1]);
  return x < low || x > places[places.length - 1] ? NaN
    : values[k - 1] + share * (values[k] - values[k - 1]);
}

const modulo = (x, turn) => ((x % turn) + turn) % turn;

function within(x, start, turn) {  // angle from a start, [0, turn)
  const turned = modulo(x - start, turn);
  return turned > turn - SLACK ? 0 : turned;
}

function steady(x) {  // speed of the crank in the steady motion of a machine
  const { omega, first, sense, cycle } = D.motion, count = omega.length;
  const along = modulo(sense * (x - first), cycle) / cycle * count, k = Math.floor(along) % count;
  return omega[k] + (omega[(k + 1) % count] - omega[k]) * (along - Math.floor(along));
}

function at(x) {  // all outputs in a position of the driver; the guard that fails, or -1; the speed
  return D.motion ? [...solved(x), steady(x)] : solved(x);
}

function driven(x) {  // place, rate and acceleration of the link that a cam's follower moves
  const { pieces, lowest, degrees, rate } = D.cam, along = within(x, 0, TURN) * Math.PI / 180;
  const of = pieces.findLast(piece => piece.start <= along + 1e-11), t = along - of.start;
  const turn = of.rate * t + of.phase, [s, v, a] = of.powers.reduceRight(
    ([p, d, dd], factor) => [p * t + factor, d * t + p, dd * t + 2 * d], [0, 0, 0]);
  const way = s + of.size * Math.sin(turn);
  return [lowest + (degrees ? way * 180 / Math.PI : way),
    (v + of.size * of.rate * Math.cos(turn)) * rate,
    (a - of.size * of.rate ** 2 * Math.sin(turn)) * rate ** 2];
}

function solved(x) {
  const sides = [...D.cam ? driven(x) : [], ...D.branches.map(one => branch(one, x))];
  if (!D.loads) return run(x, ...sides);
  const still = run(x, ...sides, ...Array(D.loads).fill(0));
  const told = loads(x, still), out = run(x, ...sides, ...told);
  if (told.some(Number.isNaN)) out[out.length - 1] = still[out.length - 1];
  return out;
}

const [LOW, HIGH] = D.way, END = D.rows.length;
const sample = Array.from({ length: SAMPLES + 1 }, (_, k) => at(LOW + (HIGH - LOW) * k / SAMPLES));
const peak = Array.from(sample[0], (_, k) => Math.max(0, ...sample.map(o => Math.abs(o[k]) || 0)));
const exists = out => D.places.every(k => Number.isFinite(out[k]));

function said(value, digits, largest = 0) {
  if (!Number.isFinite(value)) return "—";
  if (Math.abs(value) <= 1e-12 * largest) return "0";
  const [head, power] = value.toPrecision(digits).split("e");
  const told = (power ? head + "·10^" + +power : head).replaceAll("-", "−");
  return told.replace(".", D.words.decimal);
}

const short = (value, digits) =>  // without the zeros at the end
  said(value, digits).replace(/([.,]\d*?)0+$/, "$1").replace(/[.,]$/, "");

// Texts -------------------------------------------------------------------------------------------

function rich(node, ...parts) {  // strings, and runs [letters, "sub", "sup" or ""]
  node.replaceChildren(...parts.flatMap(part => typeof part === "string" ? [part] :
    part.map(([letters, tag]) => {
      if (!tag) return letters;
      const index = document.createElement(tag);
      index.textContent = letters;
      return index;
    })));
}

function made(parent, kind, cls) {
  const node = parent.appendChild(document.createElementNS(SVG, kind));
  node.setAttribute("class", cls);
  return node;
}

const path = points => "M" + points.map(([x, y]) => x.toFixed(3) + " " + y.toFixed(3)).join("L");

// Views -------------------------------------------------------------------------------------------

for (const view of D.views) {
  view.svg = byId("svg-" + view.id);
  const lines = view.svg.querySelector(".lines");
  for (const one of [...view.segments, ...view.pushes, ...view.turns]) {
    one.line = made(lines, "path", "seg " + (one.style || "push"));
    if (one.arrow || !one.style) one.head = made(lines, "path", "tip");
  }
  view.labels.forEach((one, k) => { one.node = byId("label-" + view.id + "-" + k); });
  view.told = byId("told-" + view.id);
  view.zoom = byId("zoom-" + view.id);
  view.bar = made(lines, "path", "seg thin");
  const look = event => {
    const inside = view.svg.getScreenCTM().inverse();
    const p = new DOMPoint(event.clientX, event.clientY).matrixTransform(inside);
    const near = view.segments.map(one => one.symbol && one.ends && !one.covered ?
      distance([p.x, p.y], one.ends) : 1e9);
    const best = Math.min(...near);
    view.hot = best * view.svg.getScreenCTM().a < 22 ? near.indexOf(best) : -1;
    tell(view);
  };
  view.svg.addEventListener("pointermove", look);
  view.svg.addEventListener("pointerdown", look);
}

const traces = D.views[0].labels.filter(one => one.at).map(one => {
  const node = made(D.views[0].svg.querySelector(".traces"), "path", "trace");
  const points = sample.map(out => exists(out) ? point(D.views[0], out, one.at, 1) : null);
  const parts = points.reduce((all, p) => {
    if (p) all[all.length - 1].push(p); else all.push([]);
    return all;
  }, [[]]).filter(part => part.length > 1);
  node.setAttribute("d", parts.map(path).join(""));
  return node;
});

function point(view, out, ref, times) {
  let x = out[ref[0]] - (view.origin ? view.origin[0] : 0);
  let y = out[ref[0] + 1] - (view.origin ? view.origin[1] : 0);
  if (ref[1]) [x, y] = [-y, x];
  const [right, down] = view.shift || [0, 0];
  return [x / view.per_mm / times + right, -y / view.per_mm / times + down];
}

function distance([x, y], [[ax, ay], [bx, by]]) {
  const dx = bx - ax, dy = by - ay, square = dx * dx + dy * dy;
  const t = square ? Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / square)) : 0;
  return Math.hypot(x - ax - t * dx, y - ay - t * dy);
}

function arrow(one, [a, b]) {  // a line with its head; shorter than two heads it gets a smaller one
  const dx = b[0] - a[0], dy = b[1] - a[1], span = Math.hypot(dx, dy), shown = span >= 0.3;
  one.ends = shown ? [a, b] : null;
  one.line.setAttribute("d", shown ? path([a, b]) : "");
  if (!one.head) return;
  const size = Math.min(4.4, span / 2), u = [dx / span, dy / span], w = size * 0.17;
  one.head.setAttribute("d", !shown ? "" : path([b, [b[0] - u[0] * size - u[1] * w,
    b[1] - u[1] * size + u[0] * w], [b[0] - u[0] * size + u[1] * w,
    b[1] - u[1] * size - u[0] * w]]) + "Z");
}

function aside(ends, drawn) {  // segments on one line are drawn beside one another
  const [[ax, ay], [bx, by]] = ends, long = Math.hypot(bx - ax, by - ay) || 1;
  const across = [-(by - ay) / long, (bx - ax) / long];
  for (const step of [0, 1, -1, 2, -2, 3, -3]) {
    const shifted = ends.map(([x, y]) => [x + 1.7 * step * across[0], y + 1.7 * step * across[1]]);
    const hides = other => {
      const [short, line] = long < Math.hypot(other[1][0] - other[0][0], other[1][1] - other[0][1]) ?
        [shifted, other] : [other, shifted];
      return [1, 2, 3, 4, 5, 6, 7].filter(k => distance([0, 1].map(j =>
        short[0][j] + (short[1][j] - short[0][j]) * k / 8), line) < 0.3).length > 2;
    };
    if (!drawn.some(hides)) return shifted;
  }
  return ends;
}

function circular(one, centre, sense) {  // a circular arrow; none where the sense is nothing
  const r = 5, turn = (degrees, radius) => [centre[0] + radius * Math.cos(degrees * Math.PI / 180),
    centre[1] - radius * Math.sin(degrees * Math.PI / 180)];
  one.shown = sense !== 0;
  const [from, to] = [turn(-60 * sense, r), turn(200 * sense, r)].map(p => p.map(v => v.toFixed(3)));
  one.line.setAttribute("d", sense ? `M${from}A${r} ${r} 0 1 ${sense > 0 ? 0 : 1} ${to}` : "");
  const tip = [turn(222 * sense, r), turn(194 * sense, r + 0.8), turn(194 * sense, r - 0.8)];
  one.head.setAttribute("d", sense ? path(tip) + "Z" : "");
}

function measure(view) {  // a round length of the picture, and what it is in its unit
  const [left, top, , height] = view.box, about = 30 * view.per_mm * view.times;
  const power = 10 ** Math.floor(Math.log10(about)), digit = [5, 2, 1].find(k => k * power <= about);
  const value = digit * power, x = left + 3, y = top + height - 3, end = x + value / view.per_mm / view.times;
  const marks = [x, end].map(at => [[at, y - 1.5], [at, y + 1.5]]);
  view.bar.setAttribute("d", [[[x, y], [end, y]], ...marks].map(path).join(""));
  rich(view.zoom, "├─┤ = " + short(value, Math.max(1, power.toString().length)) + " ", view.unit);
}

function draw(view, out) {
  const refs = [...view.segments.flatMap(one => [one.a, one.b]),
    ...view.labels.flatMap(one => one.at ? [one.at] : [])];
  const there = refs.every(ref => Number.isFinite(out[ref[0]] + out[ref[0] + 1]));
  view.svg.parentNode.classList.toggle("gone", !there);
  if (!there) { view.hot = -1; return; }
  const [left, top, width, height] = view.box;
  view.times = 1;
  if (view.zooms) {  // plans grow and shrink a hundredfold in a turn: each fills its box
    view.shift = [0, 0];
    const places = refs.map(ref => point(view, out, ref, 1)), margin = view.pushes.length ? 22 : 13;
    const ends = k => [Math.min, Math.max].map(most => most(...places.map(p => p[k])));
    const [[x0, x1], [y0, y1]] = [ends(0), ends(1)];
    const needed = Math.max((x1 - x0) / (width - 2 * margin), (y1 - y0) / (height - 2 * margin));
    view.times = needed > 1e-8 ? needed : 1;
    view.shift = [left + width / 2 - (x0 + x1) / 2 / view.times,
      top + height / 2 - (y0 + y1) / 2 / view.times];
  }
  measure(view);
  const drawn = [];
  for (const one of view.segments) one.covered = false;
  for (const one of view.segments) {
    let ends = [point(view, out, one.a, view.times), point(view, out, one.b, view.times)];
    const same = k => view.segments.find(other => one.beside && !other.beside && other.ends &&
      [0, 1].every(j => Math.hypot(other.exact[j ^ k][0] - ends[j][0],
        other.exact[j ^ k][1] - ends[j][1]) < 0.3));
    one.exact = ends;
    if (same(0)) same(0).covered = true;  // the whole is a component: it has the letter
    else if (same(1)) ends = [ends[0], ends[0]];
    else if (one.arrow) drawn.push(ends = aside(ends, drawn));
    arrow(one, ends);
  }
  const force = one => ["x", "y"].map((_, k) => out[one.head_at[0] + k] - out[one.tail[0] + k]);
  const largest = Math.max(...view.pushes.map(one => Math.hypot(...force(one))));
  for (const one of view.pushes) {
    const [fx, fy] = force(one), size = Math.hypot(fx, fy), a = point(view, out, one.at, view.times);
    const long = size > 1e-9 * largest ? (7 + 15 * size / largest) / size : 0;
    arrow(one, [a, [a[0] + fx * long, a[1] - fy * long]]);
  }
  for (const one of view.turns) {
    const [a, b] = one.on.map(ref => point(view, out, ref, view.times));
    const whole = Math.abs(out[one.couple]) > 1e-9 * peak[one.couple];
    one.centre = [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
    circular(one, one.centre, whole ? -Math.sign(out[one.couple] * out[one.omega]) : 0);
  }
  label(view, out);
  tell(view);
}

// Inscriptions: each where it covers the least, near where it was ---------------------------------

function label(view, out) {
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
  const middle = ([a, b]) => [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
  for (const one of view.labels) {
    const owner = one.of !== undefined ? view.segments[one.of] : one.push !== undefined ?
      view.pushes[one.push] : one.turn !== undefined ? view.turns[one.turn] : null;
    const absent = owner && ((!owner.ends && !owner.shown) || owner.covered);
    one.node.setAttribute("visibility", absent ? "hidden" : "visible");
    if (absent) continue;
    const p = one.at ? point(view, out, one.at, view.times) : one.on ?
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

const overlap = (a, b) => Math.max(0, Math.min(a[2], b[2]) - Math.max(a[0], b[0])) *
  Math.max(0, Math.min(a[3], b[3]) - Math.max(a[1], b[1]));

function crosses([x0, y0, x1, y1], [[ax, ay], [bx, by]]) {  // Liang and Barsky
  let from = 0, to = 1;
  for (const [p, q] of [[ax - bx, ax - x0], [bx - ax, x1 - ax], [ay - by, ay - y0], [by - ay, y1 - ay]]) {
    if (p === 0 && q < 0) return false;
    if (p < 0) from = Math.max(from, q / p);
    if (p > 0) to = Math.min(to, q / p);
  }
  return from <= to;
}

function tell(view) {  // the segment that is pointed at: its value, and mm at the scale of the sheet
  view.segments.forEach((one, k) => {
    for (const node of [one.line, one.head]) if (node) node.classList.toggle("hot", k === view.hot);
  });
  const one = view.segments[view.hot];
  if (!one) { view.told.textContent = view.hot === undefined ? D.words.touch : " "; return; }
  const [a, b] = [one.a, one.b].map(ref => [now[ref[0]], now[ref[0] + 1]]);
  const value = Math.hypot(b[0] - a[0], b[1] - a[1]);
  const parts = [one.symbol, ` = ${said(value, 5)} `, view.unit];
  const mm = `${said(value / view.mu, 4)} ${D.words.mm}`;
  rich(view.told, ...parts, "; ", ...(one.name ? [one.name, ` = ${mm}`] : [mm]));
}

// Numbers and diagrams ----------------------------------------------------------------------------

function valued(q, out) {
  return q.vector ? Math.hypot(out[q.rows[0]], out[q.rows[1]]) : out[q.rows[0]];
}

for (const [k, q] of D.quantities.entries()) {
  q.cells = q.rows.map(row => byId("cell-" + row)).filter(Boolean);
  q.size = byId("size-" + k);
  q.button = byId("choose-" + k);
  q.largest = Math.max(...q.rows.map(row => peak[row]));
  if (!q.button) continue;
  q.button.addEventListener("click", () => {
    const chosen = q.button.getAttribute("aria-pressed") !== "true";
    q.button.setAttribute("aria-pressed", chosen);
    if (chosen) plot(q); else { q.plot.remove(); q.plot = null; }
    show(position);
  });
}

const WIDE = 360, TALL = 120, PAD = [46, 10, 10, 18];  // px of a diagram: left, right, top, bottom
const DIGIT = 6.4;  // px: the widest figure of a tick

function plot(q) {
  const figure = q.plot = byId("diagrams").appendChild(document.createElement("figure"));
  q.caption = figure.appendChild(document.createElement("figcaption"));
  const svg = figure.appendChild(document.createElementNS(SVG, "svg"));
  svg.setAttribute("viewBox", `0 0 ${WIDE} ${TALL}`);
  const values = sample.map(out => valued(q, out)), real = values.filter(Number.isFinite);
  const sizes = real.map(Math.abs).sort((a, b) => a - b);
  const most = Math.min(sizes[sizes.length - 1] || 0, 50 * (sizes[sizes.length >> 1] || 1e300));
  const zero = q.steady ? [] : [0];  // a speed that hardly changes is looked at closely
  let low = Math.max(-most, Math.min(...zero, ...real)), high = Math.min(most, Math.max(...zero, ...real));
  if (!(high - low > 1e-12 * q.largest)) [low, high] = [low - 1, high + 1];
  const numerals = ticks(low, high, 4).map(value => [value, short(+value.toPrecision(6), 6)]);
  const left = Math.max(PAD[0], 8 + DIGIT * Math.max(...numerals.map(one => one[1].length)));
  q.x = value => left + (value - LOW) / (HIGH - LOW) * (WIDE - left - PAD[1]);
  const tall = TALL - PAD[2] - PAD[3];
  q.y = value => TALL - PAD[3] - Math.min(9, Math.max(-9, (value - low) / (high - low))) * tall;
  const text = (x, y, told, anchor) => {
    const node = made(svg, "text", "tick");
    node.setAttribute("x", x); node.setAttribute("y", y); node.setAttribute("text-anchor", anchor);
    node.textContent = told;
  };
  const rule = (points, cls) => made(svg, "path", cls).setAttribute("d", path(points));
  for (const [value, told] of numerals) {
    rule([[left, q.y(value)], [WIDE - PAD[1], q.y(value)]], value ? "grid" : "axis");
    text(left - 4, q.y(value) + 3.5, told, "end");
  }
  const across = D.crank ? [0, 1, 2, 3, 4].map(k => k * HIGH / 4) : ticks(LOW, HIGH, 5);
  for (const value of across) {
    rule([[q.x(value), PAD[2]], [q.x(value), TALL - PAD[3]]], "grid");
    text(q.x(value), TALL - 5, short(+value.toPrecision(4), 4), "middle");
  }
  const parts = values.reduce((all, value, k) => {
    const x = LOW + (HIGH - LOW) * k / SAMPLES;
    if (Number.isFinite(value)) all[all.length - 1].push([q.x(x), q.y(value)]); else all.push([]);
    return all;
  }, [[]]).filter(part => part.length > 1);
  const inner = made(svg, "svg", "");  // cuts off what a dead position throws out of the picture
  inner.setAttribute("viewBox", `0 ${PAD[2] - 1} ${WIDE} ${tall + 2}`);
  inner.setAttribute("y", PAD[2] - 1);
  inner.setAttribute("height", tall + 2);
  made(inner, "path", "curve").setAttribute("d", parts.map(path).join(""));
  q.mark = made(svg, "path", "mark");
  q.dot = made(svg, "circle", "dot");
  q.dot.setAttribute("r", 3.2);
  svg.addEventListener("pointerdown", event => {
    const p = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
    show(Math.min(HIGH, Math.max(LOW, LOW + (p.x - left) / (WIDE - left - PAD[1]) * (HIGH - LOW))));
  });
}

function ticks(low, high, count) {
  const raw = (high - low) / count, power = 10 ** Math.floor(Math.log10(raw));
  const step = power * [1, 2, 2.5, 5, 10].find(m => m * power >= raw * 0.999);
  const found = [];
  for (let k = Math.ceil(low / step - 1e-9); k <= high / step + 1e-9; k++) found.push(k * step || 0);
  return found;
}

function fill(out) {
  for (const q of D.quantities) {
    for (const cell of q.cells) {
      const value = out[+cell.dataset.row];
      cell.dataset.value = value;
      cell.textContent = said(value, 8, q.largest);
    }
    const value = valued(q, out);
    if (q.size) { q.size.dataset.value = value; q.size.textContent = said(value, 8, q.largest); }
    if (!q.plot) continue;
    rich(q.caption, q.symbol, ` = ${said(value, 5, q.largest)} `, q.unit);
    q.mark.setAttribute("d", path([[q.x(position), PAD[2]], [q.x(position), TALL - PAD[3]]]));
    const there = q.y(value) >= PAD[2] - 2 && q.y(value) <= TALL - PAD[3] + 2;
    q.dot.setAttribute("visibility", there ? "visible" : "hidden");
    if (there) { q.dot.setAttribute("cx", q.x(position)); q.dot.setAttribute("cy", q.y(value)); }
  }
}

// Where there is no position ----------------------------------------------------------------------

function edge(x, step) {  // the last position before a gap, seen from inside it
  let inside = x, out = x, n = 0;
  for (; n < SAMPLES && at(out)[END] >= 0; n++) { inside = out; out += step; }
  if (n === SAMPLES || (!D.crank && (out < LOW || out > HIGH))) return null;
  for (let k = 0; k < 50; k++) {
    const half = (inside + out) / 2;
    if (at(half)[END] >= 0) inside = half; else out = half;
  }
  return D.crank ? modulo(out, HIGH) : out;
}

function warn(out) {
  const why = byId("why"), failed = out[END] >= 0;
  const lost = !failed && D.forces.some(k => Number.isNaN(out[k]));
  why.hidden = !failed && !lost;
  if (lost) rich(why, D.words.unknown);
  if (!failed) return;
  const step = (HIGH - LOW) / SAMPLES;
  const near = [edge(position, -step), edge(position, step)].filter(v => v !== null);
  const told = near.map(v => D.symbol.map(run => run[0]).join("") + " = " + said(v, 6) + D.unit);
  rich(why, D.reasons[out[END]], near.length ? ` ${D.words.nearest} ${told.join("; ")}.` : "");
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
  fill(now);
  warn(now);
}

function tick(time) {
  if (!playing) return;
  const speed = +byId("speed").value, whole = HIGH - LOW;
  const follows = D.motion && byId("follows").checked ? now[END + 1] / D.motion.mean : 1;
  let next = position + sense * Math.min(0.1, (time - playing) / 1000) * speed * follows *
    (D.crank ? TURN : whole) / 8;
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

globalThis.planmethod = {
  at: x => Object.fromEntries(at(x).slice(0, END).map((value, k) => [D.rows[k], value])), show,
};
const watch = new IntersectionObserver(changes => {  // what nobody sees is not drawn while it moves
  for (const one of changes) D.views.find(view => view.svg === one.target).seen = one.isIntersecting;
});
for (const view of D.views) watch.observe(view.svg);
for (const q of D.quantities) if (q.chosen) { q.button.setAttribute("aria-pressed", true); plot(q); }
show(D.start);
