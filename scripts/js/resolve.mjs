// Modules of the pages for node, as a server gives them: those of both folders are beside each other.
import { existsSync } from "node:fs";
import { register } from "node:module";

const pages = ["planmethod/studio/page/", "planmethod/render/live/script/"].map(folder => new URL(`../../${folder}`, import.meta.url));

export async function resolve(name, context, next) {
  const found = /^\.\/[\w-]+\.js$/.test(name) && pages.map(page => new URL(name, page)).find(one => existsSync(one));
  return next(found ? found.href : name, context);
}

if (!process.env.PLANMETHOD_RESOLVES) {  // the thread of the hooks loads this module too
  process.env.PLANMETHOD_RESOLVES = "1";
  register(import.meta.url);
}
