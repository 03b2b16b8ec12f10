// The bar of a page whose picture moves with one number: play, slider, the number itself.
import { modulo, short } from "./numbers.js";
import { byId } from "./svg.js";

/** Let the bar move a picture; return what goes to a place.
 * @param {{ ends: number[], round?: boolean, rate: () => number, told: (x: number) => string, show: (x: number) => void,
 *   words: { play: string, pause: string } }} page ends: of the slider; round: after the last place the first one follows;
 *   rate: of the place, by a second; told: a place as it is spoken */
export function driving({ ends: [low, high], round = false, rate, told, show, words }) {
  const slider = byId("slider"), exact = byId("exact"), play = byId("play");
  let position = low, playing = 0;

  function go(x) {
    position = round ? low + modulo(x - low, high - low) : Math.min(high, Math.max(low, x));
    slider.value = position;
    slider.setAttribute("aria-valuetext", told(+position.toFixed(4)));
    if (document.activeElement !== exact) exact.value = short(position, 6).replace(",", ".").replace("−", "-");
    show(position);
  }

  function step(time) {
    if (!playing) return;
    const next = position + Math.min(0.1, (time - playing) / 1000) * +byId("speed").value * rate();
    playing = time;
    go(next > high ? low + (next - high) : next < low ? high - (low - next) : next);
    requestAnimationFrame(step);
  }

  function pause() {
    playing = playing ? 0 : performance.now();
    play.textContent = playing ? "❚❚" : "▶";
    play.setAttribute("aria-label", playing ? words.pause : words.play);
    if (playing) requestAnimationFrame(step);
  }

  play.addEventListener("click", pause);
  slider.addEventListener("input", () => go(+slider.value));
  exact.addEventListener("input", () => {
    const x = parseFloat(exact.value);
    if (Number.isFinite(x)) go(x);
  });
  return { go, at: () => position, stop: () => { if (playing) pause(); } };
}
