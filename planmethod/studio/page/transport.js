// How the page asks its server. A page without one has alone.js in place of this.
const JSON_TEXT = { "Content-Type": "application/json" };
/** @type {(path: string, options?: any) => Promise<Response>} */
export const ask = (path, options = {}) => fetch(path,
  typeof options.body === "string" ? { ...options, headers: { ...JSON_TEXT, ...options.headers } } : options);
/** @type {(frame: any, address: string, live?: boolean) => void} */
export const show = (frame, address) => { frame.src = address; };
/** @type {(told: (key: string, facts?: any) => void) => void} */
export const starting = () => {};
