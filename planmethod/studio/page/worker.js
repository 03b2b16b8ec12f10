// Python in the browser: it does what a server would do, one thing after the other.
let alone = null;

async function begin({ core, packages, names, site }) {
  const { loadPyodide } = await import(`${core}pyodide.mjs`);
  const env = { HOME: "/home/pyodide", PLANMETHOD_NATIVE: "0" };
  const python = await loadPyodide({ indexURL: core, packageBaseUrl: packages, env });
  for (const name of names) {
    postMessage({ loading: name });
    let said = "";
    await python.loadPackage(name, { messageCallback() {}, errorCallback(text) { said += text; } });
    if (!python.loadedPackages[name]) throw new Error(`${name}. ${said}`);
  }
  postMessage({ loading: "planmethod" });
  const archive = await fetch(site);
  if (!archive.ok) throw new Error(`${site}: ${archive.status}`);
  python.unpackArchive(await archive.arrayBuffer(), "zip", { extractDir: "/lib/planmethod" });
  python.runPython("import sys; sys.path.insert(0, '/lib/planmethod')");
  const found = python.pyimport("planmethod.studio.serverless").start_studio(python.pyimport("planmethod.commands.studio_jobs").act);
  return (method, path, body, tell) => found.answer(method, path, python.toPy(body), tell).toJs();
}

onmessage = async ({ data: { id, method, path, body, from } }) => {
  let why = "not_loaded";
  try {
    const answer = await (alone ??= begin(from));
    if (!id) return postMessage({ loading: "" });
    why = "lost";
    const [status, found] = answer(method, path, body, share => postMessage({ id, share }));
    postMessage({ id, status, found });
  } catch (error) {
    postMessage({ id, failed: why, why: String(error.message || error) });
  }
};
