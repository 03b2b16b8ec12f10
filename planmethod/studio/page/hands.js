// A mouse, fingers and a wheel on the board: what is held and where; two fingers and the wheel change the scale.
import { apart } from "./drag.js";

/** @typedef {[number, number]} Place */
/** @typedef {{ kind: string, name: string, here: Place, start: Place, moved: boolean, before: any, exact?: boolean, ratio?: boolean }} Held */

const STILL = 5;  // px: a click, no drag

/** Listen to pointers on a board.
 * @param {any} svg
 * @param {{ board: any, pressed: (event: any) => boolean, before: () => any, moves: (held: Held) => boolean, seen: () => void,
 *   dropped: (held: Held, pointer: string) => void, left: (held: Held) => void }} drawing
 *   pressed: whether something else takes it; moves: whether what is held follows, else the view does
 * @returns {() => Held | null} what is held */
export function hands(svg, { board, pressed, before, moves, seen, dropped, left }) {
  const fingers = new Map();
  /** @type {any} */
  let held = null;
  let waits = 0;

  /** @type {(event: any) => Place} */
  const placeOf = event => { const { left, top } = svg.getBoundingClientRect(); return [event.clientX - left, event.clientY - top]; };

  svg.addEventListener("pointerdown", event => {
    const here = placeOf(event);
    if (pressed(event)) { event.preventDefault(); return; }
    fingers.set(event.pointerId, here);
    svg.setPointerCapture(event.pointerId);
    if (fingers.size > 1) {  // what one finger held goes back
      if (held && !held.pinch) left(held);
      held = { pinch: true, from: [...fingers.values()] };
      return;
    }
    const [kind, name] = board.hit(here, event.pointerType);
    held = { kind, name, here, start: here, moved: false, before: before(), view: { ...board.view }, times: [] };
  });

  svg.addEventListener("pointermove", event => {
    if (!held) return;
    const here = placeOf(event);
    if (fingers.has(event.pointerId)) fingers.set(event.pointerId, here);
    if (held.pinch) {
      const [a, b] = held.from, [c, e] = [...fingers.values()];
      if (!c || !e) return;
      board.zoom(apart(c, e) / Math.max(1, apart(a, b)), /** @type {any} */ ([(c[0] + e[0]) / 2, (c[1] + e[1]) / 2]));
      held.from = [c, e];
      seen();
      return;
    }
    held.here = here;
    held.exact = event.altKey;
    held.ratio = event.shiftKey;
    held.moved ||= Math.hypot(here[0] - held.start[0], here[1] - held.start[1]) > STILL;
    if (!held.moved || waits) return;
    waits = requestAnimationFrame(() => { waits = 0; if (held) frame(); });
  });

  function frame() {
    const began = performance.now();
    if (!moves(held)) {
      Object.assign(board.view, { x: held.view.x + held.here[0] - held.start[0], y: held.view.y + held.here[1] - held.start[1] });
      board.picture();
      seen();
    }
    held.times.push(performance.now() - began);
    svg.dataset.ms = String(held.times.reduce((a, b) => a + b, 0) / held.times.length);
  }

  function up(event) {
    fingers.delete(event.pointerId);
    if (!held) return;
    const own = held;
    if (own.pinch) { if (!fingers.size) held = null; return; }
    if (waits) { cancelAnimationFrame(waits); waits = 0; if (own.moved && event.type === "pointerup") frame(); }
    held = null;
    if (event.type === "pointerup") dropped(own, event.pointerType); else left(own);
  }
  svg.addEventListener("pointerup", up);
  svg.addEventListener("pointercancel", up);
  svg.addEventListener("wheel", event => {
    event.preventDefault();
    board.zoom(Math.exp(-event.deltaY / 500), placeOf(event));
    seen();
  }, { passive: false });

  return () => held;
}
