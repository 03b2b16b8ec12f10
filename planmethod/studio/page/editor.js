// The editor of the problem file: CodeMirror with the keys of the schema and faults at their place.
import * as cm from "./codemirror.js";
import { D, W, faultText } from "./api.js";
import { ask } from "./transport.js";

const own = { "&": { color: "var(--ink)", backgroundColor: "var(--paper)", fontSize: "14px" },
  ".cm-content": { caretColor: "var(--ink)", fontFamily: 'ui-monospace, "DejaVu Sans Mono", Consolas, monospace' },
  ".cm-cursor": { borderLeftColor: "var(--ink)" },
  "&.cm-focused .cm-selectionBackground, .cm-selectionBackground": { backgroundColor: "color-mix(in srgb, var(--go) 30%, transparent) !important" },
  ".cm-gutters": { backgroundColor: "var(--panel)", color: "var(--faint)", borderRight: "1px solid var(--line)" },
  ".cm-activeLine": { backgroundColor: "color-mix(in srgb, var(--go) 8%, transparent)" },
  ".cm-tooltip": { backgroundColor: "var(--panel)", color: "var(--ink)", border: "1px solid var(--line)", maxWidth: "min(90vw, 36em)" } };
const inks = cm.HighlightStyle.define([
  { tag: cm.tags.comment, color: "var(--faint)", fontStyle: "italic" }, { tag: cm.tags.string, color: "var(--good)" },
  { tag: cm.tags.propertyName, color: "var(--go)" }, { tag: cm.tags.atom, color: "var(--hot)" },
  { tag: cm.tags.bracket, fontWeight: "600" }]);

let schema = null, asked = false;
function learn() {  // the keys, as soon as one may type: a first visit has nothing of them
  if (asked) return;
  asked = true;
  ask(`api/schema?lang=${D.lang}`).then(answer => answer.json()).then(found => { schema = found; }, () => { asked = false; });
}

const resolved = node => {
  for (let n = 0; node?.$ref && n < 9; n++) node = schema.$defs[node.$ref.split("/").pop()];
  return node;
};

function within(node, key) {  // the schemas that may be meant by a key of a table
  const found = [];
  for (const one of every(node)) {
    if (one.properties?.[key]) found.push(one.properties[key]);
    else if (one.items && /^\d+$/.test(key)) found.push(one.items);
    else {
      for (const [pattern, inner] of Object.entries(one.patternProperties || {})) if (new RegExp(pattern, "u").test(key)) found.push(inner);
      if (typeof one.additionalProperties === "object") found.push(one.additionalProperties);
    }
  }
  return found;
}

function every(node) {
  node = resolved(node);
  if (!node || typeof node !== "object") return [];
  return [node, ...["anyOf", "oneOf", "allOf"].flatMap(key => (node[key] || []).flatMap(every))];
}

const parts = text => (text.match(/[\w-]+|"[^"]*"|[^\s.\[\]"=]+/gu) || []).map(one => one.replace(/"/g, ""));

export function complete(context) {  // keys of the table that the line is in, or values of a choice
  if (!schema) return null;
  const line = context.state.doc.lineAt(context.pos), before = line.text.slice(0, context.pos - line.from);
  let table = [];
  for (let n = line.number - 1; n > 0 && !table.length; n--) {
    const head = context.state.doc.line(n).text.match(/^\s*\[{1,2}([^\]]+)\]/);
    if (head) table = parts(head[1]);
  }
  const word = before.match(/[\p{L}\w-]*$/u)[0], from = context.pos - word.length;
  const header = before.match(/^\s*\[{1,2}([^\]]*)$/), value = before.match(/^\s*([^=]+?)\s*=\s*(.*)$/);
  let path = header ? parts(header[1].slice(0, header[1].length - word.length)) : table;
  if (value) {
    const brace = value[2].lastIndexOf("{");
    path = [...table, ...parts(value[1])];
    if (brace < value[2].lastIndexOf("}") || brace < 0) return values(path, before, context);
  } else if (!header) path = [...table, ...parts(before.slice(0, before.length - word.length))];
  let nodes = [schema];
  for (const part of path) nodes = nodes.flatMap(node => within(node, part));
  const keys = new Map();
  for (const one of nodes.flatMap(every)) {
    const inner = one.items ? every(one.items) : [one];
    for (const table of inner) for (const [key, told] of Object.entries(table.properties || {})) keys.set(key, { ...resolved(told), ...told });
  }
  if (!keys.size || (!word && !context.explicit)) return null;
  const options = [...keys].map(([label, told]) => ({ label, type: "property", info: told.description || undefined,
    apply: header || value?.[2].includes("{") === false ? label : header ? label : told.type === "object" && !value ? label : `${label} = ` }));
  return { from, options, validFor: /^[\p{L}\w-]*$/u };
}

function values(path, before, context) {
  let nodes = [schema];
  for (const part of path) nodes = nodes.flatMap(node => within(node, part));
  const found = [...new Set(nodes.flatMap(every).flatMap(one => one.enum || ("const" in one ? [one.const] : [])))];
  const typed = before.match(/"?[\p{L}\w-]*$/u)[0];
  if (!found.length || (!typed && !context.explicit)) return null;
  const text = one => typeof one === "string" ? JSON.stringify(one) : String(one);
  return { from: context.pos - typed.length, options: found.map(one => ({ label: text(one), type: "enum" })) };
}

const WORD = /[^\W\d]\w*|\d+(?:[._]\d+)*(?:e[+-]?\d+)?/gi;

function numbered(state, pos) {  // a double click, and Ctrl with an arrow, take a number whole: 0.1, 2.5e-3
  const line = state.doc.lineAt(pos);
  const words = [...line.text.matchAll(WORD)].filter(({ 0: word, index }) => {
    const from = line.from + index;
    return from <= pos && pos <= from + word.length;
  });
  return words.map(([word]) => ({ wordChars: word.replace(/\w/g, "") }));
}

export function editor(parent, text, changed) {
  let undone = false, undoing = false;  // whether the last change took one back
  const begun = doc => cm.EditorState.create({
    doc,
    extensions: [
      cm.EditorView.cspNonce.of(D.nonce), cm.lineNumbers(), cm.history(), cm.drawSelection(), cm.highlightActiveLine(),
      cm.highlightSpecialChars(), cm.bracketMatching(), cm.closeBrackets(), cm.search({ top: true }), cm.lintGutter(),
      cm.StreamLanguage.define(cm.toml), cm.EditorState.languageData.of(numbered), cm.syntaxHighlighting(inks),
      cm.autocompletion({ override: [complete] }),
      cm.EditorView.theme(own), cm.EditorView.lineWrapping,
      cm.EditorView.contentAttributes.of({ "aria-label": W.editor, spellcheck: "false", tabindex: "0" }),
      cm.keymap.of([...cm.closeBracketsKeymap, ...cm.completionKeymap, ...cm.lintKeymap, ...cm.searchKeymap,
        ...cm.historyKeymap, ...cm.defaultKeymap]),
      cm.EditorView.updateListener.of(update => { 
        if (!update.docChanged) return;
        undone = undoing || update.transactions.some(one => one.isUserEvent("undo") || one.isUserEvent("redo"));
        changed(update.state.doc.toString());
      }),
      cm.EditorView.updateListener.of(update => { if (update.view.hasFocus) learn(); }),
    ],
  });
  const view = new cm.EditorView({ parent, state: begun(text) });
  const step = key => cm.historyKeymap.find(one => one.key === key).run(view);
  return {
    view,
    text: () => view.state.doc.toString(),
    open(next, state = begun(next)) { view.setState(state); },  // another text: what was undone in one is not in another
    change(edit) {  // one step of the history, whatever was done just before
      if (edit) view.dispatch({ changes: edit, userEvent: "draw", scrollIntoView: false });
    },
    undo() { undoing = true; step("Mod-z"); undoing = false; },
    redo() { undoing = true; step("Mod-y"); undoing = false; },
    undone: () => undone,
    put(next) { view.dispatch({ changes: { from: 0, to: view.state.doc.length, insert: next } }); },
    faults(found) {
      const doc = view.state.doc, told = found.filter(one => one.line).map(one => {
        const line = doc.line(Math.min(one.line, doc.lines)), from = Math.min(line.from + one.column - 1, line.to);
        return { from, to: line.to > from ? line.to : Math.max(line.from, from), severity: "error", message: faultText(one) };
      });
      view.dispatch(cm.setDiagnostics(view.state, told));
    },
    go(line, column) {
      const at = view.state.doc.line(Math.min(line, view.state.doc.lines));
      view.dispatch({ selection: { anchor: Math.min(at.from + column - 1, at.to) }, scrollIntoView: true });
      view.focus();
    },
  };
}
