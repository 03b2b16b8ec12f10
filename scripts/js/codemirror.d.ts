// The bundle of the editor for the check of types: what it exports is CodeMirror's.
declare const one: any;
export { one as EditorState, one as Compartment, one as EditorView, one as keymap, one as lineNumbers,
  one as highlightActiveLine, one as drawSelection, one as highlightSpecialChars, one as StreamLanguage,
  one as syntaxHighlighting, one as HighlightStyle, one as bracketMatching, one as indentUnit, one as toml,
  one as autocompletion, one as completionKeymap, one as closeBrackets, one as closeBracketsKeymap,
  one as setDiagnostics, one as lintGutter, one as lintKeymap, one as defaultKeymap, one as history,
  one as historyKeymap, one as search, one as searchKeymap, one as highlightSelectionMatches, one as tags };
