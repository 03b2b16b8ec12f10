"use strict";
// The page of a cam that turns: its numbers are rows of every half degree. Millimetres, y down.
const D = JSON.parse(document.getElementById("scene").textContent);
const byId = id => document.getElementById(id);
const slider = byId("slider"), exact = byId("exact"), play = byId("play");
const last = D.rows.length - 1, names = ["s", "v_q", "a_q", "pressure"];

function said(value) {
  return value.toFixed(2).replace(".", D.decimal).replace("-", "−");
}

// The numbers at an angle, degrees, between two rows.
function at(phi) {
  const place = phi / 360 * last, k = Math.min(last - 1, Math.floor(place)), share = place - k;
  return D.rows[k].map((value, n) => value + share * (D.rows[k + 1][n] - value));
}

function show(phi) {
  phi = ((phi % 360) + 360) % 360;
  slider.value = phi;
  if (document.activeElement !== exact) exact.value = +phi.toPrecision(8);
  const row = at(phi), m = D.mirror, mm = 1000;
  const roller = [m * row[4], -row[5]], contact = [m * row[6], -row[7]];
  byId("cam").setAttribute("transform", `rotate(${(-m * phi).toFixed(5)})`);
  byId("cursor").setAttribute("transform", `translate(${(phi * D.per_degree).toFixed(4)} 0)`);
  const across = D.line === null ? roller[0] : m * D.line;
  byId("follower").setAttribute("transform", `translate(${across.toFixed(4)} ${roller[1].toFixed(4)})`);
  if (D.oscillates) {
    const pivot = [m * D.pivot * mm, 0], dx = roller[0] - pivot[0], dy = roller[1] - pivot[1];
    const long = D.arm * mm / Math.hypot(dx, dy);
    byId("arm").setAttribute("d", `M${pivot[0]} 0L${pivot[0] + long * dx} ${pivot[1] + long * dy}`);
  }
  const nx = roller[0] - contact[0], ny = roller[1] - contact[1], size = Math.hypot(nx, ny) || 1;
  const far = size > 1e-6 ? 25 / size : 0;
  byId("normal").setAttribute("d",
    `M${contact[0] - far * nx} ${contact[1] - far * ny}L${contact[0] + 2 * far * nx} ${contact[1] + 2 * far * ny}`);
  byId("contact").setAttribute("cx", contact[0]);
  byId("contact").setAttribute("cy", contact[1]);
  names.forEach((name, n) => {
    byId(name).dataset.value = row[n];
    byId(name).textContent = said(row[n]);
  });
  position = phi;
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
