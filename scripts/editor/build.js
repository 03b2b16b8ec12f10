// Makes planmethod/studio/page/codemirror.js and codemirror-licences.txt: npm ci && npm run build here.
import { build } from "esbuild";
import { readFileSync, writeFileSync } from "node:fs";

const page = new URL("../../planmethod/studio/page/", import.meta.url);
const made = await build({
  entryPoints: ["entry.js"], bundle: true, minify: true, format: "esm", target: "es2020",
  legalComments: "none", metafile: true, write: false,
  banner: { js: "// CodeMirror 6, bundled by scripts/editor; MIT, see codemirror-licences.txt" },
});
writeFileSync(new URL("codemirror.js", page), made.outputFiles[0].contents);

const parts = new Set(Object.keys(made.metafile.inputs).map(path =>
  path.match(/node_modules\/((?:@[^/]+\/)?[^/]+)\//)?.[1]).filter(Boolean));
const told = [...parts].sort().map(name => {
  const { version } = JSON.parse(readFileSync(`node_modules/${name}/package.json`, "utf-8"));
  return `${name} ${version}\n\n${readFileSync(`node_modules/${name}/LICENSE`, "utf-8").trim()}\n`;
});
writeFileSync(new URL("codemirror-licences.txt", page), told.join(`\n${"-".repeat(72)}\n\n`));
