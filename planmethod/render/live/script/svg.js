// Elements of pictures, and letters with indices.
const SVG = "http://www.w3.org/2000/svg";

/** @type {(id: string) => any} */
export const byId = id => document.getElementById(id);

/** @type {(parent: Element, kind: string, cls?: string) => any} */
export function shape(parent, kind, cls = "") {
  const one = parent.appendChild(document.createElementNS(SVG, kind));
  one.setAttribute("class", cls);
  return one;
}

/** @type {(box: Element, ...parts: (string | string[][])[]) => void} */
export function rich(box, ...parts) {  // strings, and runs [letters, "sub", "sup" or ""]
  box.replaceChildren(...parts.flatMap(part => typeof part === "string" ? [part] :
    part.map(([letters, tag]) => {
      if (!tag) return letters;
      const index = document.createElement(tag);
      index.textContent = letters;
      return index;
    })));
}
