// How the page asks its server. A page without one has alone.js in place of this.
export const ask = (path, options) => fetch(path, options);
export const show = (frame, address) => { frame.src = address; };
export const starting = () => {};
