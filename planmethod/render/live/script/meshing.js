// The page of two wheels in mesh: they turn, and the contact travels along the line of action. Millimetres, y down.
import { driving } from "./driver.js";
import { decimals, modulo, said } from "./numbers.js";
import { byId } from "./svg.js";

const D = JSON.parse(byId("scene").textContent);
decimals(D.words.decimal);

/** Contacts of a meshing when wheel 1 has turned by an angle, degrees: distances from N₁ along the line of action, rising.
 * @type {(mesh: { base: number, start: number, end: number, pole: number, pitch: number }, turned: number) => number[]} */
export function contacts({ base, start, end, pole, pitch }, turned) {
  const one = pole + base * turned * Math.PI / 180, found = [];
  for (let rho = start + modulo(one - start, pitch); rho <= end + 1e-9 * pitch; rho += pitch) found.push(rho);
  return found;
}

/** Specific sliding of both profiles where the contact is.
 * @type {(mesh: { line: number, teeth: number[] }, rho: number) => [number, number]} */
export function sliding({ line, teeth: [one, two] }, rho) {
  const ratio = (line - rho) / rho * one / two;
  return rho > 0 ? [1 - ratio, 1 - 1 / ratio] : [NaN, NaN];
}

const onLine = rho => {  // y down
  const along = rho - D.pole, [x, y] = D.along;
  return [x * along, -y * along];
};

function show(turned) {
  D.wheels.forEach((one, k) => {
    const degrees = one.ratio * turned;
    for (const node of document.querySelectorAll(".wheel-" + k)) node.setAttribute("transform", `translate(0 ${one.y}) rotate(${degrees.toFixed(5)})`);
    byId("turned-" + k).textContent = said(Math.abs(degrees), 5);
    byId("turned-" + k).dataset.value = String(degrees);
  });
  const now = contacts(D, turned);
  document.querySelectorAll(".contact").forEach((node, k) => {
    const rho = now[k % D.most];
    node.setAttribute("visibility", rho === undefined ? "hidden" : "visible");
    if (rho === undefined) return;
    const [x, y] = onLine(rho);
    node.setAttribute("cx", x.toFixed(4));
    node.setAttribute("cy", y.toFixed(4));
  });
  byId("pairs").textContent = String(now.length);
  for (let k = 0; k < D.most; k++) {
    const told = now[k] === undefined ? [] : [now[k], Math.abs(D.line - now[k]), ...sliding(D, now[k])];
    ["rho1", "rho2", "theta1", "theta2"].forEach((name, n) => {
      const cell = byId(`${name}-${k}`);
      cell.dataset.value = String(told[n]);
      cell.textContent = told.length ? said(told[n], n < 2 ? 4 : 3, n < 2 ? 0 : 1) : "—";
    });
  }
}

const bar = driving({ ends: [0, 360], round: true, rate: () => 360 / D.teeth[0] / 3, told: x => `φ₁ = ${said(x, 5)}°`, show, words: D.words });
globalThis.planmethod = { show: bar.go, contacts: x => contacts(D, x), sliding: rho => sliding(D, rho), at: onLine };
bar.go(0);
