"use strict";
// The page of a gear train that turns: speeds are constant, so a number tells where everything is.
// Everything is in millimetres of the view, y down.
const D = JSON.parse(document.getElementById("scene").textContent);
const byId = id => document.getElementById(id);
const slider = byId("slider"), exact = byId("exact"), play = byId("play");
const turn = degrees => degrees * Math.PI / 180;

function said(value) {
  return value.toFixed(1).replace(".", D.decimal).replace("-", "−");
}

// Where the axis of something is: on the main one, or carried round it.
function centre(one, x) {
  const angle = turn(one.start + one.carried * x);
  return [one.far * Math.cos(angle), one.base - one.far * Math.sin(angle)];
}

function show(x) {
  slider.value = x;
  if (document.activeElement !== exact) exact.value = +x.toPrecision(8);
  for (const one of D.wheels) {
    const [cx, cy] = centre(one, x), angle = one.angle + one.ratio * x;
    byId(one.id).setAttribute("transform",
      `translate(${cx.toFixed(4)} ${cy.toFixed(4)}) rotate(${(-angle).toFixed(5)})`);
  }
  for (const one of D.arms) {
    const [cx, cy] = centre(one, x);
    byId(one.id).setAttribute("d", `M0 ${one.base}L${cx.toFixed(4)} ${cy.toFixed(4)}`);
  }
  for (const one of D.labels) {
    const [cx, cy] = centre(one, x);
    byId(one.id).setAttribute("transform", `translate(${cx.toFixed(4)} ${cy.toFixed(4)})`);
  }
  for (const one of D.angles) {
    const cell = byId(one.id);
    cell.dataset.value = one.ratio * x;
    cell.textContent = said(one.ratio * x);
  }
  position = x;
}

let position = 0, playing = 0, way = D.sense;

function tick(time) {
  if (!playing) return;
  let next = position + way * Math.min(0.1, (time - playing) / 1000) * +byId("speed").value * D.pace;
  playing = time;
  if (next > D.most) next -= 2 * D.most;
  if (next < -D.most) next += 2 * D.most;
  show(next);
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
  const x = parseFloat(exact.value);
  if (Number.isFinite(x)) show(x);
});

globalThis.planmethod = { show, centre: (k, x) => centre(D.wheels[k], x) };
show(0);
