// Edits of a problem file at their places: what is not changed, comments too, stays as it was typed.

/** @typedef {string | number} Part */
/** @typedef {{ from: number, to: number, insert: string }} Edit */
/** @typedef {{ path: Part[], from: number, to: number, kind: string, key: number, open: number }} Value
 *   from, to: of the value; key: where its key begins, or the value itself in a list; open: after its opening bracket */
/** @typedef {{ path: Part[], from: number, body: number, end: number, list: boolean, last: number }} Section
 *   from: of its header; body: after it; end: where the next one begins; last: after its last value, or its header */

const BARE = /[\p{L}\p{N}_-]+/uy;

/** Read where everything is in a text. A text that is no TOML is read as far as it is one.
 * @type {(text: string) => { values: Value[], sections: Section[] }} */
export function places(text) {
  /** @type {Value[]} */
  const values = [];
  /** @type {Section[]} */
  const sections = [{ path: [], from: 0, body: 0, end: text.length, list: false, last: 0 }];
  /** @type {Map<string, number>} */
  const counts = new Map();
  let at = 0;

  const gap = (lines = true) => {  // over blanks, comments, and the ends of lines
    for (;;) {
      if (text[at] === " " || text[at] === "\t" || (lines && (text[at] === "\n" || text[at] === "\r"))) at++;
      else if (lines && text[at] === "#") { while (at < text.length && text[at] !== "\n") at++; } else return;
    }
  };
  const string = () => {
    const mark = text[at], long = text.startsWith(mark.repeat(3), at), end = long ? mark.repeat(3) : mark, from = at;
    at += end.length;
    while (!text.startsWith(end, at)) {
      if (at >= text.length || (!long && text[at] === "\n")) throw new SyntaxError(`no end of the text at ${from}`);
      at += mark === '"' && text[at] === "\\" ? 2 : 1;
    }
    at += end.length;
    const told = text.slice(from + end.length, at - end.length);
    return mark === '"' && !long ? JSON.parse(`"${told}"`) : told;
  };
  const key = () => {
    /** @type {Part[]} */
    const path = [];
    for (;;) {
      gap(false);
      if (text[at] === '"' || text[at] === "'") path.push(string());
      else {
        BARE.lastIndex = at;
        const found = BARE.exec(text);
        if (!found) throw new SyntaxError(`no key at ${at}`);
        path.push(found[0]);
        at += found[0].length;
      }
      gap(false);
      if (text[at] !== ".") return path;
      at++;
    }
  };
  /** @type {(path: Part[], begin: number) => void} */
  const value = (path, begin) => {
    const from = at, one = { path, from, to: from, kind: "plain", key: begin, open: from + 1 };
    values.push(one);
    if (text[at] === '"' || text[at] === "'") { string(); one.kind = "text"; }
    else if (text[at] === "[") {
      one.kind = "list";
      at++;
      for (let n = 0; ; n++) {
        gap();
        if (text[at] === "]") break;
        value([...path, n], at);
        gap();
        if (text[at] === ",") at++; else if (text[at] !== "]") throw new SyntaxError(`no end of the list at ${at}`);
      }
      at++;
    } else if (text[at] === "{") {
      one.kind = "table";
      at++;
      for (;;) {
        gap();
        if (text[at] === "}") break;
        const start = at, own = key();
        if (text[at++] !== "=") throw new SyntaxError(`no = at ${at}`);
        gap();
        value([...path, ...own], start);
        gap();
        if (text[at] === ",") at++; else if (text[at] !== "}") throw new SyntaxError(`no end of the table at ${at}`);
      }
      at++;
    } else {
      while (at < text.length && !/[\s,\]}#]/.test(text[at])) at++;
      if (at === from) throw new SyntaxError(`no value at ${at}`);
    }
    one.to = at;
  };

  try {
    for (;;) {
      gap();
      if (at >= text.length) break;
      const begin = at, section = sections[sections.length - 1];
      if (text[at] === "[") {
        const list = text[at + 1] === "[";
        at += list ? 2 : 1;
        let path = key();
        if (!text.startsWith(list ? "]]" : "]", at)) throw new SyntaxError(`no end of the header at ${at}`);
        at += list ? 2 : 1;
        if (list) counts.set(JSON.stringify(path), (counts.get(JSON.stringify(path)) ?? -1) + 1);
        for (let n = path.length; n > 0; n--) {
          const count = counts.get(JSON.stringify(path.slice(0, n)));
          if (count !== undefined) path = [...path.slice(0, n), count, ...path.slice(n)];
        }
        section.end = begin;
        sections.push({ path, from: begin, body: at, end: text.length, list, last: at });
      } else {
        const own = key();
        if (text[at++] !== "=") throw new SyntaxError(`no = at ${at}`);
        gap(false);
        value([...section.path, ...own], begin);
        section.last = at;
      }
    }
  } catch (error) {
    if (!(error instanceof SyntaxError)) throw error;
    sections[sections.length - 1].end = Math.min(sections[sections.length - 1].end, text.length);
  }
  return { values, sections };
}

/** @type {(a: Part[], b: Part[]) => boolean} */
const same = (a, b) => a.length === b.length && a.every((part, k) => String(part) === String(b[k]));
/** @type {(whole: Part[], head: Part[]) => boolean} */
const begins = (whole, head) => same(whole.slice(0, head.length), head);

/** @type {(name: Part) => string} */
const bare = name => /^[\w-]+$/.test(String(name)) ? String(name) : JSON.stringify(String(name));

/** Write a value as TOML; the numbers of a list stay numbers of one kind.
 * @type {(value: any) => string} */
export function written(value) {
  if (Array.isArray(value)) return `[${value.map(written).join(", ")}]`;
  if (value && typeof value === "object") {
    const inner = Object.entries(value).map(([name, one]) => `${bare(name)} = ${written(one)}`);
    return inner.length ? `{ ${inner.join(", ")} }` : "{}";
  }
  return typeof value === "string" ? JSON.stringify(value) : String(value);
}

/** Return the edit that gives a key a value: at its place, or where it belongs.
 * @type {(text: string, path: Part[], value: any) => Edit | null} */
export function setting(text, path, value) {
  const { values, sections } = places(text), told = written(value);
  const there = values.find(one => same(one.path, path));
  if (there) return text.slice(there.from, there.to) === told ? null : { from: there.from, to: there.to, insert: told };
  const above = path.slice(0, -1), name = path[path.length - 1];
  for (let n = path.length - 1; n > 0; n--) {  // a table or a list that is written as a value
    const holder = values.find(one => same(one.path, path.slice(0, n)) && (one.kind === "table" || one.kind === "list"));
    if (!holder) continue;
    const inner = values.filter(one => begins(one.path, holder.path) && one.path.length > n && one !== holder);
    const end = inner.length ? Math.max(...inner.map(one => one.to)) : holder.open;
    const own = holder.kind === "list" ? told : `${path.slice(n).map(bare).join(".")} = ${told}`;
    return { from: end, to: end, insert: inner.length ? `, ${own}` : holder.kind === "table" ? ` ${own}${text[end] === " " ? "" : " "}` : own };
  }
  const section = sections.filter(one => !one.list || above.length === one.path.length).find(one => one.from < one.body && same(one.path, above)) ||
    (above.length ? null : sections[0]);
  if (section) return inSection(text, section, `${bare(name)} = ${told}`);
  const dotted = values.filter(one => begins(one.path, above) && one.path.length === path.length).pop();
  if (dotted) {  // beside its sisters, which are written with dots
    const home = sections.filter(one => one.from <= dotted.key).pop();
    const line = text.indexOf("\n", dotted.to), end = line < 0 ? text.length : line;
    const own = path.slice(home.path.length).map(bare).join(".");
    return { from: end, to: end, insert: `\n${own} = ${told}` };
  }
  return newSection(text, above, [[name, value]]);
}

/** @type {(text: string, section: Section, line: string) => Edit} */
function inSection(text, section, line) {
  if (section.body === 0 && section.last === 0) return { from: 0, to: 0, insert: `${line}\n` };
  const end = text.indexOf("\n", section.last), at = end < 0 ? text.length : end;
  return { from: at, to: at, insert: `\n${line}` };
}

/** Return the edit that adds a table with a header, after its sisters; `list`: another entry of a list of tables.
 * @type {(text: string, path: Part[], entries: [Part, any][], list?: boolean) => Edit} */
export function newSection(text, path, entries, list = false) {
  const { sections } = places(text);
  const sister = sections.filter(one => one.from < one.body && String(one.path[0]) === String(path[0])).pop();
  const last = sister ? sections.filter(one => begins(one.path, sister.path)).pop() : sections[sections.length - 1];
  const line = text.indexOf("\n", last.last), at = sister ? (line < 0 ? text.length : line) : text.trimEnd().length;
  const [from, to] = sister ? [at, at] : [Math.max(at, last.last), text.length];
  const head = path.map(bare).join(".");
  const told = [list ? `[[${head}]]` : `[${head}]`, ...entries.map(([name, value]) => `${bare(name)} = ${written(value)}`)].join("\n");
  const before = text.slice(0, from).trim() ? "\n\n" : "";
  return sister ? { from, to, insert: `${before}${told}` } :
    { from: comment(text, from), to, insert: `${before}${told}\n` };
}

/** @type {(text: string, at: number) => number} */
function comment(text, at) {  // the end of the line, so that its comment stays
  const end = text.indexOf("\n", at);
  return end < 0 ? Math.max(at, text.trimEnd().length) : at;
}

/** Return the edit that takes a key away, or a table with all of its contents.
 * @type {(text: string, path: Part[]) => Edit[]} */
export function removing(text, path) {
  const { values, sections } = places(text);
  /** @type {Edit[]} */
  const edits = sections.filter(one => one.from < one.body && begins(one.path, path)).map(one => ({ from: one.from, to: one.end, insert: "" }));
  for (const one of values.filter(value => begins(value.path, path))) {
    if (values.some(other => other !== one && begins(other.path, path) && begins(one.path, other.path) && other.from <= one.from && other.to >= one.to)) continue;
    if (edits.some(edit => edit.from <= one.key && one.to <= edit.to)) continue;
    const holder = values.filter(other => other.from < one.key && one.to < other.to && begins(one.path, other.path)).pop();
    let [from, to] = [one.key, one.to];
    if (holder) {
      const after = /^\s*,\s*/.exec(text.slice(to)), before = /,\s*$/.exec(text.slice(0, from));
      if (after) to += after[0].length; else if (before) from -= before[0].length;
    } else {
      from = text.lastIndexOf("\n", from - 1) + 1;
      const end = text.indexOf("\n", to);
      to = end < 0 ? text.length : end + 1;
    }
    edits.push({ from, to, insert: "" });
  }
  return edits.sort((a, b) => a.from - b.from);
}

/** @type {(text: string, edits: Edit[]) => string} */
export const edited = (text, edits) => [...edits].sort((a, b) => b.from - a.from)
  .reduce((whole, { from, to, insert }) => whole.slice(0, from) + insert + whole.slice(to), text);

/** Return a text with several keys set or taken away (undefined), one after the other.
 * @type {(text: string, values: [Part[], any][]) => string} */
export function patched(text, values) {
  for (const [path, value] of values) {
    if (path[path.length - 1] === "+") {  // another entry of a list of tables
      text = edited(text, [newSection(text, path.slice(0, -1), Object.entries(value), true)]);
      continue;
    }
    const edit = value === undefined ? removing(text, path) : [setting(text, path, value)];
    text = edited(text, edit.filter(Boolean));
  }
  return text;
}

/** Return the one edit between two texts, for a history of them.
 * @type {(before: string, after: string) => Edit | null} */
export function between(before, after) {
  if (before === after) return null;
  let from = 0, end = 0;
  const most = Math.min(before.length, after.length);
  while (from < most && before[from] === after[from]) from++;
  while (end < most - from && before[before.length - 1 - end] === after[after.length - 1 - end]) end++;
  return { from, to: before.length - end, insert: after.slice(from, after.length - end) };
}
