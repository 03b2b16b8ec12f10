import assert from "node:assert/strict";
import { test } from "node:test";
import { between, edited, newSection, patched, places } from "../../planmethod/studio/page/patch.js";

const TEXT = `title = "Пример [links.9]" # не заголовок

[frame] # стойка
A = [0.0, 0.0]
C = [0.0, -0.11] # опора
guides.x-x = { through = "A", angle = 0 }

[links.1] # кривошип
points = ["A", "B"]
AB = 0.064 # м

[links.3]
points = ["C", "D"]
CD = 0.22
D.side = "left of BC"

[[loads]]
link = "1"
# конец
`;

test("a number is replaced at its place, with the comment behind it", () => {
  assert.equal(patched(TEXT, [[["links", "1", "AB"], 0.07]]), TEXT.replace("0.064", "0.07"));
  assert.equal(patched(TEXT, [[["frame", "C", 1], -0.2]]), TEXT.replace("-0.11", "-0.2"));
  assert.equal(patched(TEXT, [[["frame", "guides", "x-x", "angle"], 15]]), TEXT.replace("angle = 0", "angle = 15"));
  assert.equal(patched(TEXT, [[["loads", 0, "link"], "3"]]), TEXT.replace('link = "1"', 'link = "3"'));
});

test("a new key stands in its table, and a new table after its sisters", () => {
  assert.ok(patched(TEXT, [[["links", "1", "BC"], 0.1]]).includes("AB = 0.064 # м\nBC = 0.1\n"));
  assert.ok(patched(TEXT, [[["links", "3", "D", "at"], 0.1]]).includes('D.side = "left of BC"\nD.at = 0.1\n'));
  assert.ok(patched(TEXT, [[["frame", "guides", "x-x", "length"], 2]]).includes('{ through = "A", angle = 0, length = 2 }'));
  assert.ok(patched(TEXT, [[["links", "4", "points"], ["D"]]]).includes('D.side = "left of BC"\n\n[links.4]\npoints = ["D"]\n\n[[loads]]'));
  assert.ok(patched(TEXT, [[["driver", "phi"], 20]]).endsWith("# конец\n\n[driver]\nphi = 20\n"));
  assert.ok(patched(TEXT, [[["links", "1", "points", 2], "M"]]).includes('["A", "B", "M"]'));
  assert.equal(patched("", [[["frame", "O"], [0, 0]]]), "[frame]\nO = [0, 0]\n");
});

test("what is taken away leaves the rest as it was", () => {
  assert.equal(patched(TEXT, [[["frame", "C"], undefined]]), TEXT.replace("C = [0.0, -0.11] # опора\n", ""));
  assert.ok(!patched(TEXT, [[["links", "1"], undefined]]).includes("кривошип"));
  assert.ok(patched(TEXT, [[["frame", "guides", "x-x", "angle"], undefined]]).includes('{ through = "A" }'));
  assert.ok(patched(TEXT, [[["frame", "guides", "x-x", "through"], undefined]]).includes("{ angle = 0 }"));
});

test("brackets in texts and comments are no tables", () => {
  const { sections } = places(TEXT);
  assert.deepEqual(sections.map(one => one.path.join(".")), ["", "frame", "links.1", "links.3", "loads.0"]);
  assert.equal(places("[a]\nb = '''\n[c]\n'''\nd = 1").values.find(one => one.path[1] === "d").from, 24);
});

test("a half-typed text is read as far as it goes", () => {
  assert.equal(places("[a]\nb = 1\nc = ").values.length, 2);
  assert.equal(patched("[a]\nb = 1\nc = {", [[["a", "b"], 2]]), "[a]\nb = 2\nc = {");
});

test("entries of a list of tables are added", () => {
  const whole = edited(TEXT, [newSection(TEXT, ["loads"], [["link", "3"], ["force", 5]], true)]);
  assert.ok(whole.includes('[[loads]]\nlink = "1"\n\n[[loads]]\nlink = "3"\nforce = 5\n# конец'));
});

test("the edit between two texts makes the one of the other", () => {
  for (const [a, b] of [["abc", "axc"], ["", "x"], ["aa", "aaa"], ["aba", "a"], ["x", "x"]]) {
    const edit = between(a, b);
    assert.equal(edit ? edited(a, [edit]) : a, b);
  }
});
