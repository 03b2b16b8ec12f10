// In place of a server: a worker with Python answers the same addresses, one thing after the other.
const { alone, lang, words } = JSON.parse(document.getElementById("data").textContent);
const full = path => new URL(path, document.baseURI).href;
const FROM = { ...alone, core: full(alone.core), packages: full(alone.packages), site: full(alone.site) };
const WRITTEN = { "api/tasks": `tasks-${lang}.json`, "api/schema": `schema-${lang}.json` };
const QUICK = /^api\/(?!do\/)|^api\/do\/(sketched|questions)\b/;
const KINDS = { html: "text/html", svg: "image/svg+xml", pdf: "application/pdf" };

let worker = null, running = null, waiting = [], count = 0, /** @type {(key: string, facts?: any) => void} */ tell = () => {};
export function starting(told) { tell = told; begin(); }

function begin() {  // of a blob, so that the policy of the page holds in it
  const code = new Blob([`import ${JSON.stringify(full("static/worker.js"))};`], { type: "text/javascript" });
  worker = new Worker(URL.createObjectURL(code), { type: "module" });
  worker.onmessage = ({ data }) => heard(data);
  worker.onerror = event => heard({ id: running?.id, failed: "not_loaded", why: event.message || "static/worker.js" });
  worker.postMessage({ from: FROM });
  tell("loading", { name: "Python" });
}

function heard(data) {
  if (data.loading !== undefined) return data.loading ? tell("loading", { name: data.loading }) : tell("");
  if (data.share !== undefined) return running?.id === data.id && running.told({ share: data.share });
  if (data.failed) { end(); tell(data.failed, data); }
  if (!running || (data.id && data.id !== running.id)) return;
  const { done } = running;
  running = null;
  done(data);
  next();
}

function end() { worker?.terminate(); worker = null; }

function next() {
  if (running || !waiting.length) return;
  running = waiting.shift();
  if (!worker) begin();
  worker.postMessage({ ...running.asked, id: running.id, from: FROM });
}

function answered(asked, told, signal) {
  return new Promise((done, failed) => {
    const one = { id: ++count, asked, told, done };
    if (QUICK.test(asked.path)) waiting.unshift(one); else waiting.push(one);
    signal?.addEventListener("abort", () => {  // only who stops it himself waits for another Python
      waiting = waiting.filter(other => other !== one);
      if (running === one && signal.reason === "stop") { end(); running = null; next(); }
      failed(signal.reason);
    });
    next();
  });
}

/** @type {(path: string, options?: any) => Promise<Response>} */
export async function ask(path, { method = "GET", body = "", signal } = {}) {
  const [plain, query = ""] = path.split("?");
  if (plain === "api/session") return new Response(JSON.stringify({ key: "", trusted: true }));
  if (method === "GET" && WRITTEN[plain] && !new URLSearchParams(query).get("search")) return fetch(full(WRITTEN[plain]));
  const asked = { method, path, body: new Uint8Array(await new Response(body).arrayBuffer()) };
  if (!plain.startsWith("api/do/")) {
    const { status, found, failed } = await answered(asked, () => {});
    if (failed) throw new TypeError(words[failed]);  // as where a server does not answer
    return new Response(found, { status });
  }
  return new Response(new ReadableStream({
    start(stream) {
      const line = one => { if (!signal?.aborted) stream.enqueue(new TextEncoder().encode(`${JSON.stringify(one)}\n`)); };
      answered(asked, line, signal).then(({ found, failed, why }) => {
        if (failed) line({ found: { refused: words[failed].replace("{why}", why) } }); else stream.enqueue(found);
        stream.close();
      }).catch(error => stream.error(error));
    },
  }));
}

// What was made is in the worker: it is fetched from there --------------------------------------------

/** @type {(address: string) => Promise<[Blob, string]>} */
async function file(address) {
  const answer = await ask(address), name = address.split("?")[0].split("/").pop();
  return [new Blob([await answer.arrayBuffer()], { type: KINDS[name.split(".").pop()] || "application/octet-stream" }), decodeURIComponent(name)];
}

export async function show(frame, address, live) {
  const text = await (await file(address))[0].text();
  if (!live) { frame.srcdoc = text; return; }
  frame.addEventListener("load", () => frame.contentWindow.postMessage(text, "*"));  // an empty page may load before
  frame.src = full("static/frame.html");
}

addEventListener("click", async event => {
  const link = event.target.closest?.('a[href^="files/"]');
  if (!link) return;
  event.preventDefault();
  const [blob, name] = await file(link.getAttribute("href")), url = URL.createObjectURL(blob);
  if (link.hasAttribute("download") || /-live/.test(name)) Object.assign(document.createElement("a"), { href: url, download: name }).click();
  else open(url, "_blank", "noopener");
  setTimeout(() => URL.revokeObjectURL(url), 60000);
});
