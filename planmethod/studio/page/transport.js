// How the page asks its server. A page without one has alone.js in place of this.
const JSON_TEXT = { "Content-Type": "application/json" };
export const ask = (path, options = {}) => fetch(path,
  typeof options.body === "string" ? { ...options, headers: { ...JSON_TEXT, ...options.headers } } : options);
export const show = (frame, address) => { frame.src = address; };
export const starting = () => {};
