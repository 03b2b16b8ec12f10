// Works and points by hand, kept in this browser by task: no reload, ended session or other task takes them away.
const opened = () => new Promise((done, failed) => {
  const asked = indexedDB.open("planmethod", 1);
  asked.onupgradeneeded = () => asked.result.createObjectStore("works");
  asked.onsuccess = () => done(asked.result);
  asked.onerror = () => failed(asked.error);
});
let database = null;

async function works(mode, act) {
  database ??= opened();
  const box = (await database).transaction("works", mode).objectStore("works");
  return new Promise((done, failed) => {
    const asked = act(box);
    asked.onsuccess = () => done(asked.result);
    asked.onerror = () => failed(asked.error);
  });
}

const of = task => IDBKeyRange.bound([task], [task, []]);  // all names: a list comes after every text
export const names = async task => (await works("readonly", box => box.getAllKeys(of(task)))).map(([, name]) => name);
export const read = (task, name) => works("readonly", box => box.get([task, name]));
export const add = (task, name, file) => works("readwrite", box => box.put(file, [task, name]));
export const clear = task => works("readwrite", box => box.delete(of(task)));

const home = task => `planmethod.by_hand.${task}`;
export const byHand = task => JSON.parse(localStorage.getItem(home(task)) || "[]");
export const keepByHand = (task, rows) => localStorage.setItem(home(task), JSON.stringify(rows));
