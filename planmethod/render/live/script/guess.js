// Values that are hidden while a reader measures them: what was measured is judged by the accuracy of drawing.

/** @typedef {{ at: number[], sigma: Record<string, (number | null)[]>, times: number, share: number }} Tolerances */

/** The tolerance of a value that is read off a drawing; NaN where the drawing has none.
 * @type {(told: Tolerances, quantity: number, position: number, value: number) => number} */
export function tolerance({ at, sigma, times, share }, quantity, position, value) {
  const own = sigma[quantity], next = at.findIndex(place => place >= position);
  const [a, b] = next < 0 ? [at.length - 1, at.length - 1] : [Math.max(0, next - 1), next];
  const part = at[b] > at[a] ? Math.min(1, Math.max(0, (position - at[a]) / (at[b] - at[a]))) : 0;
  const [low, high] = [own?.[a] ?? own?.[b], own?.[b] ?? own?.[a]];
  if (low === undefined || low === null) return NaN;
  return Math.max(times * (low + part * (high - low)), share * Math.abs(value));
}

/** Whether a measured value is right, of the other sense, near, or wrong; `size`: it has no sign.
 * @type {(measured: number, exact: number, allowed: number, size: boolean) => "right" | "sense" | "near" | "wrong"} */
export function verdict(measured, exact, allowed, size) {
  const off = Math.abs(measured - exact), turned = Math.abs(measured + exact);
  if (off <= allowed) return "right";
  if (!size && turned <= allowed) return "sense";
  return off <= 2 * allowed ? "near" : "wrong";
}

/** A number as people type it, with a comma or a point; NaN of anything else.
 * @type {(text: string) => number} */
export function typed(text) {
  const plain = text.trim().replace(/[−–]/g, "-").replace(",", ".").replace(/·10\^?/, "e");
  return /^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i.test(plain) ? Number(plain) : NaN;
}
