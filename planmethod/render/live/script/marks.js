// The positions of the task on the slider, with their numbers.

const THUMB = 16, WIDE_MARK = 24;  // px: of the slider's handle; of a number

/** Which of the places, px in rising order, have room for a number: the first, and each that is not over the one before.
 * @type {(places: number[]) => boolean[]} */
export function legible(places) {
  let last = -Infinity;
  return places.map(place => {
    if (place - last < WIDE_MARK) return false;
    last = place;
    return true;
  });
}

/** Put the marks of a slider under its handle's ways, and let them lead there.
 * @param {HTMLElement} box
 * @param {number[]} ends of the slider
 * @param {(x: number) => void} go */
export function placeMarks(box, [low, high], go) {
  const marks = /** @type {HTMLElement[]} */ ([...box.children]);
  const lay = () => {
    const wide = box.clientWidth - THUMB;
    const places = marks.map(mark => (Number(mark.dataset.at) - low) / (high - low) * wide + THUMB / 2);
    const order = places.map((_, k) => k).sort((a, b) => places[a] - places[b]);
    const shown = legible(order.map(k => places[k]));
    order.forEach((k, n) => {
      marks[k].style.left = `${places[k]}px`;
      marks[k].hidden = !shown[n];
    });
  };
  for (const mark of marks) mark.addEventListener("click", () => go(Number(mark.dataset.at)));
  if (marks.length) new ResizeObserver(lay).observe(box);
}
