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
  const image = made(box, "img", "", { alt: page.title });
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

const fitting = () => Math.max(.4, (paper.clientWidth - 4) / pages[at].width);
function size() {
  const { width, height } = pages[at];
  box.style.width = `${width * zoom}px`;
  box.style.height = `${height * zoom}px`;
  box.style.aspectRatio = width / height;  // on paper it is as wide as that
  box.style.setProperty("--ratio", width / height);
  box.toggleAttribute("data-across", width > height);
}
function zoomed(next) {
  const middle = [paper.scrollLeft + paper.clientWidth / 2, paper.scrollTop + paper.clientHeight / 2].map(v => v / zoom);
  zoom = Math.min(20, Math.max(.3, next));
  size();
  paper.scrollTo(middle[0] * zoom - paper.clientWidth / 2, middle[1] * zoom - paper.clientHeight / 2);
}
byId("larger").addEventListener("click", () => zoomed(zoom * 1.4));
byId("smaller").addEventListener("click", () => zoomed(zoom / 1.4));
byId("whole").addEventListener("click", () => zoomed(fitting()));
byId("before").addEventListener("click", () => { at--; show(); });
byId("next").addEventListener("click", () => { at++; show(); });
byId("print").addEventListener("click", () => print());
paper.addEventListener("wheel", event => {
  if (!event.ctrlKey || !pages.length) return;
  event.preventDefault();
  zoomed(zoom * Math.exp(-event.deltaY / 400));
}, { passive: false });

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
