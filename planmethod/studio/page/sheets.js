// Sheets as pages: turned, zoomed, measured with a ruler.
import { D, W, byId, forgets, lettered, long, made, picture, say } from "./api.js";

let pages = [], at = 0, zoom = 0, ends = [], measures = false;
const paper = byId("paper"), box = byId("sheet"), SVG = "http://www.w3.org/2000/svg";
const number = (value, digits) => Number(value.toPrecision(digits)).toLocaleString(D.lang, { maximumSignificantDigits: digits });

export async function draw(asked) {
  const found = await long("sheets", asked, byId("sheets").querySelector(".told"));
  if (found === undefined) return found;
  pages = found?.pages || [];
  if (!pages.length) { box.replaceChildren(); forget(); return found; }
  at = Math.min(at, pages.length - 1);
  byId("turn").hidden = byId("measuring").hidden = false;
  show();
  return found;
}

function forget() {
  pages = ends = [];
  at = 0;
  byId("turn").hidden = byId("measuring").hidden = true;
}
forgets(forget);

function show() {
  const page = pages[at];
  box.replaceChildren();
  const image = made(box, "img", "", { alt: page.title, draggable: false });
  picture(image, page.svg);
  const over = box.appendChild(document.createElementNS(SVG, "svg"));
  over.setAttribute("viewBox", `0 0 ${page.width} ${page.height}`);
  byId("sheet-of").textContent = say("sheet_of", { n: at + 1, count: pages.length });
  byId("before").disabled = at === 0;
  byId("next").disabled = at === pages.length - 1;
  const spans = byId("spans");
  spans.replaceChildren();
  made(spans, "option", W.none_chosen, { value: "" });
  for (const [k, view] of page.views.entries()) {
    if (!view.unit) continue;
    for (const [n, span] of view.spans.entries()) made(spans, "option", `${span.name}  ${view.scale}`, { value: `${k} ${n}` });
  }
  zoom = zoom || fitting();
  ends = [];
  size();
  measured();
}

const SEEN = .72, ONE = 96 / 25.4;  // part of the window that the paper takes at most; pixels of a millimetre
const fitting = () => Math.max(.2, Math.min((paper.clientWidth - 4) / pages[at].width, SEEN * innerHeight / pages[at].height));
function size() {
  const { width, height } = pages[at];
  box.style.width = `${width * zoom}px`;
  box.style.height = `${height * zoom}px`;
  box.style.aspectRatio = width / height;  // on paper it is as wide as that
  box.style.setProperty("--ratio", width / height);
  box.toggleAttribute("data-across", width > height);
}
/** @type {(next: number, about?: number[]) => void} */
function zoomed(next, [x, y] = [paper.clientWidth / 2, paper.clientHeight / 2]) {  // about a place of the window
  const kept = [paper.scrollLeft + x - box.offsetLeft, paper.scrollTop + y - box.offsetTop].map(v => v / zoom);
  zoom = Math.min(20, Math.max(.2, next));
  size();
  paper.scrollTo(kept[0] * zoom + box.offsetLeft - x, kept[1] * zoom + box.offsetTop - y);
}
const within = event => { const { left, top } = paper.getBoundingClientRect(); return [event.clientX - left, event.clientY - top]; };
byId("larger").addEventListener("click", () => zoomed(zoom * 1.4));
byId("smaller").addEventListener("click", () => zoomed(zoom / 1.4));
byId("whole").addEventListener("click", () => zoomed(fitting()));
byId("before").addEventListener("click", () => { at--; show(); });
byId("next").addEventListener("click", () => { at++; show(); });
byId("print").addEventListener("click", () => print());
paper.addEventListener("wheel", event => {
  if (event.shiftKey || !pages.length) return;
  event.preventDefault();
  zoomed(zoom * Math.exp(-event.deltaY / 400), within(event));
}, { passive: false });
paper.addEventListener("dblclick", event => {
  if (pages.length && !measures) zoomed(Math.abs(zoom / ONE - 1) < .01 ? fitting() : ONE, within(event));
});
paper.addEventListener("keydown", event => {
  const times = { "+": 1.4, "=": 1.4, "-": 1 / 1.4 }[event.key];
  if (times && pages.length) { event.preventDefault(); zoomed(zoom * times); }
});

let held = null;  // the paper under the hand; a finger scrolls it as any page
paper.addEventListener("pointerdown", event => {
  if (event.button || event.pointerType !== "mouse" || measures) return;
  held = { x: event.clientX + paper.scrollLeft, y: event.clientY + paper.scrollTop };
  paper.setPointerCapture(event.pointerId);
  paper.classList.add("held");
});
paper.addEventListener("pointermove", event => { if (held) paper.scrollTo(held.x - event.clientX, held.y - event.clientY); });
for (const end of ["pointerup", "pointercancel"]) paper.addEventListener(end, () => { held = null; paper.classList.remove("held"); });

// The ruler: mm of the paper, and by the scale of the view that the segment lies in ----------------

byId("ruler").addEventListener("click", () => {
  measures = !measures;
  byId("ruler").setAttribute("aria-pressed", measures);
  paper.classList.toggle("measures", measures);
  ends = [];
  measured();
});
byId("spans").addEventListener("change", event => {
  const [k, n] = event.target.value.split(" ").map(Number);
  const span = event.target.value && pages[at].views[k].spans[n];
  ends = span ? [{ p: span.ends.slice(0, 2) }, { p: span.ends.slice(2) }] : [];
  measured();
});
box.addEventListener("click", event => {
  if (!measures) return;
  const frame = box.getBoundingClientRect();
  const p = [(event.clientX - frame.left) / zoom, pages[at].height - (event.clientY - frame.top) / zoom];
  const near = pages[at].views.flatMap(view => view.spans.flatMap(span => [span.ends.slice(0, 2), span.ends.slice(2)]))
    .map(q => ({ q, far: Math.hypot(q[0] - p[0], q[1] - p[1]) })).sort((a, b) => a.far - b.far)[0];
  if (ends.length === 2) ends = [];
  byId("spans").value = "";  // what is measured is not what was chosen there
  ends.push({ p: near && near.far < Math.max(1, 8 / zoom) ? near.q : p });
  measured();
});

function measured() {
  const over = box.querySelector("svg"), page = pages[at], told = byId("measured");
  if (!over) return;
  over.replaceChildren();
  const y = v => page.height - v, add = (tag, more) => {
    const node = over.appendChild(document.createElementNS(SVG, tag));
    for (const [key, value] of Object.entries(more)) node.setAttribute(key, value);
  };
  for (const { p } of ends) add("circle", { cx: p[0], cy: y(p[1]), r: 1.2 });
  told.textContent = "";
  if (ends.length < 2) return;
  const [a, b] = ends.map(one => one.p), mm = Math.hypot(b[0] - a[0], b[1] - a[1]);
  add("line", { x1: a[0], y1: y(a[1]), x2: b[0], y2: y(b[1]) });
  const inside = ([x0, y0, x1, y1], [x, z]) => x >= x0 && x <= x1 && z >= y0 && z <= y1;
  const view = page.views.find(one => one.unit && inside(one.box, a) && inside(one.box, b));
  const same = (p, q) => Math.hypot(p[0] - q[0], p[1] - q[1]) < .01;
  const span = view?.spans.find(one => [[a, b], [b, a]].some(([p, q]) => same(p, one.ends.slice(0, 2)) && same(q, one.ends.slice(2))));
  const name = span ? `${span.name} = ` : "";
  const facts = view && { mm: number(mm, 4), scale: `${view.scale} ${number(view.per_mm, 4)}`, unit: view.unit,
    value: number(mm * view.per_mm / (span?.share || 1), 4) };
  lettered(told, name + (view ? say("measured_as", facts) : say("measured", { mm: number(mm, 4) })));
  const place = (a[0] + b[0]) / 2 * zoom;
  if (byId("spans").value) paper.scrollTo(place - paper.clientWidth / 2, y((a[1] + b[1]) / 2) * zoom - paper.clientHeight / 2);
}
