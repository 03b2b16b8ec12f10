"use strict";
// The page of cams that turn with their shaft: the numbers of each are rows of every half degree of
// its own turn, which begins at its phase. Millimetres, y down. Names of elements end with the
// number of the cam, but for the first one.
const D = JSON.parse(document.getElementById("scene").textContent);
const byId = id => document.getElementById(id);
const slider = byId("slider"), exact = byId("exact"), play = byId("play");
const names = ["s", "v_q", "a_q", "pressure"], ending = k => k ? `-${k}` : "";

function said(value) {
  return value.toFixed(2).replace(".", D.decimal).replace("-", "−");
}

// The numbers of a cam at an angle of the shaft, degrees, between two rows.
function at(phi, number = 0) {
  const { rows, phase } = D.cams[number], last = rows.length - 1;
  const place = turned(phi - phase) / 360 * last;
  const k = Math.min(last - 1, Math.floor(place)), share = place - k;
  return rows[k].map((value, n) => value + share * (rows[k + 1][n] - value));
}

function turned(phi) {
  return ((phi % 360) + 360) % 360;
}

function show(phi) {
  phi = turned(phi);
  slider.value = phi;
  if (document.activeElement !== exact) exact.value = +phi.toPrecision(8);
  byId("cursor").setAttribute("transform", `translate(${(phi * D.per_degree).toFixed(4)} 0)`);
  D.cams.forEach((cam, number) => showCam(cam, number, phi));
  position = phi;
}

function showCam(cam, number, phi) {
  const row = at(phi, number), m = cam.mirror, mm = 1000, own = name => byId(name + ending(number));
  const roller = [m * row[4], -row[5]], contact = [m * row[6], -row[7]];
  const angle = -m * turned(phi - cam.phase);
  own("cam").setAttribute("transform", `rotate(${angle.toFixed(5)})`);
  const across = cam.line === null ? roller[0] : m * cam.line;
  own("follower").setAttribute("transform", `translate(${across.toFixed(4)} ${roller[1].toFixed(4)})`);
  if (cam.oscillates) {
    const pivot = [m * cam.pivot * mm, 0], dx = roller[0] - pivot[0], dy = roller[1] - pivot[1];
    const long = cam.arm * mm / Math.hypot(dx, dy);
    own("arm").setAttribute("d", `M${pivot[0]} 0L${pivot[0] + long * dx} ${pivot[1] + long * dy}`);
  }
  const nx = roller[0] - contact[0], ny = roller[1] - contact[1], size = Math.hypot(nx, ny) || 1;
  const far = size > 1e-6 ? 25 / size : 0;
  own("normal").setAttribute("d",
    `M${contact[0] - far * nx} ${contact[1] - far * ny}L${contact[0] + 2 * far * nx} ${contact[1] + 2 * far * ny}`);
  own("contact").setAttribute("cx", contact[0]);
  own("contact").setAttribute("cy", contact[1]);
  names.forEach((name, n) => {
    own(name).dataset.value = row[n];
    own(name).textContent = said(row[n]);
  });
}

let position = 0, playing = 0;

function tick(time) {
  if (!playing) return;
  const step = Math.min(0.1, (time - playing) / 1000) * +byId("speed").value * D.pace;
  playing = time;
  show(position + step);
  requestAnimationFrame(tick);
}

play.addEventListener("click", () => {
  playing = playing ? 0 : performance.now();
  play.textContent = playing ? "❚❚" : "▶";
  play.setAttribute("aria-label", playing ? D.words.pause : D.words.play);
  if (playing) requestAnimationFrame(tick);
});
slider.addEventListener("input", () => show(+slider.value));
exact.addEventListener("input", () => {
  const phi = parseFloat(exact.value);
  if (Number.isFinite(phi)) show(phi);
});

globalThis.planmethod = { show, at };
show(0);
