// The drawing room without a mouse: letters choose tools, arrows move the pointer, a joint or the driver.
import { byId } from "./api.js";

const KEYS = { v: "select", j: "joint", l: "link", s: "slider", r: "guide", g: "ground", d: "driver", f: "load", x: "delete" };
const REST = 400;  // ms: presses until then are one change of the text

/** @typedef {[number, number]} Place */

/** Listen to the keys of a drawing.
 * @param {any} svg the board
 * @param {{ board: any, typed: any, turnTo: (tool: string) => void, acted: (kind: string, name: string, place: Place, drop: any[]) => void,
 *   at: (point: string) => Place, nudge: (id: string, by: Place, times: number) => void, nudged: () => void, open: (name: string) => void,
 *   leave: () => void, remove: () => boolean }} drawing
 * @returns {{ again: () => void }} */
export function keys(svg, { board, typed, turnTo, acted, at, nudge, nudged, open, leave, remove }) {
  /** @type {Place | null} */
  let cursor = null;  // the pointer of who has no mouse, pixels of the board
  let rest = 0;

  function pointed(event) {
    const { width, height } = svg.getBoundingClientRect(), far = event.shiftKey ? 50 : 10;
    const by = { ArrowLeft: [-far, 0], ArrowRight: [far, 0], ArrowUp: [0, -far], ArrowDown: [0, far] }[event.key];
    if (by) {
      const [x, y] = cursor || [width / 2, height / 2];
      cursor = [Math.min(width, Math.max(0, x + by[0])), Math.min(height, Math.max(0, y + by[1]))];
    } else if (event.key === "Enter" || event.key === " ") {
      cursor ||= [width / 2, height / 2];
      const [kind, name] = board.hit(cursor);
      acted(kind, name, board.from(cursor), ["", "", 0]);
    } else return false;
    board.cursor(cursor);
    return true;
  }
  svg.addEventListener("blur", () => board.cursor(null));

  byId("drawing").addEventListener("keydown", event => {
    if (event.target.matches?.("input, select")) return;
    if (event.ctrlKey || event.metaKey) {
      if (event.code === "KeyZ" || event.code === "KeyY") {
        event.preventDefault();
        if (event.code === "KeyZ" && !event.shiftKey) typed.undo(); else typed.redo();
      }
      return;
    }
    if (event.target === svg && pointed(event)) { event.preventDefault(); return; }
    const id = event.target.dataset?.id || "";
    /** @type {Place | undefined} */
    const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (arrows && (id.startsWith("joint ") || id === "driver")) {
      event.preventDefault();
      nudge(id, arrows, event.shiftKey ? 10 : 1);
      clearTimeout(rest);
      rest = setTimeout(nudged, REST);
    } else if (event.key === "Enter" || event.key === " ") {
      if (id.startsWith("size ")) { event.preventDefault(); open(id.slice(5)); }
      else if (id.startsWith("joint ")) { event.preventDefault(); acted("joint", id.slice(6), at(id.slice(6)), ["", "", 0]); }
    } else if (event.key === "Escape") leave();
    else if (event.key === "Delete" && remove()) event.preventDefault();
    else {
      const wanted = KEYS[event.key.toLowerCase()] || KEYS[event.code.replace("Key", "").toLowerCase()];
      if (wanted) { event.preventDefault(); turnTo(wanted); }
    }
  });

  return { again() { if (cursor && document.activeElement === svg) board.cursor(cursor); } };  // after the board was built
}
