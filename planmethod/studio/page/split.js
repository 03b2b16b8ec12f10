// The line between the text and the picture: dragged, moved by arrows, and folding the text away.
import { byId } from "./api.js";

const HOME = "planmethod.split", LEAST = 15, MOST = 70, USUAL = 32, STEP = 4;  // parts of the width, %

/** Make the line move; it stays where it was put. */
export function splitting() {
  const line = byId("split"), halves = byId("halves");
  let share = Number(localStorage.getItem(HOME) ?? USUAL), open = share || USUAL;

  function put(next) {
    share = next < LEAST / 2 ? 0 : Math.min(MOST, Math.max(LEAST, next));
    if (share) open = share;
    halves.style.setProperty("--text", String(share));
    halves.toggleAttribute("data-folded", !share);
    line.setAttribute("aria-valuenow", String(Math.round(share)));
    try { localStorage.setItem(HOME, String(share)); } catch { /* it is as usual the next time */ }
  }
  const fold = () => put(share ? 0 : open);

  line.addEventListener("pointerdown", event => {
    event.preventDefault();
    line.setPointerCapture(event.pointerId);
    line.focus();
  });
  line.addEventListener("pointermove", event => {
    if (!line.hasPointerCapture(event.pointerId)) return;
    const { left, width } = halves.getBoundingClientRect();
    put((event.clientX - left) / width * 100);
  });
  line.addEventListener("dblclick", fold);
  line.addEventListener("keydown", event => {
    const next = { ArrowLeft: share - STEP, ArrowRight: (share || LEAST - STEP) + STEP, Home: 0, End: MOST }[event.key];
    if (next !== undefined) put(next < LEAST && event.key === "ArrowLeft" ? 0 : next);
    else if (event.key === "Enter" || event.key === " ") fold();
    else return;
    event.preventDefault();
  });
  put(Number.isFinite(share) ? share : USUAL);
}
