"""Edits of a problem file at their places: equal in meaning to the file edited by hand."""

from __future__ import annotations

import copy
import json
import random
import re
import shutil
import subprocess
import tomllib
from typing import Any

import pytest
from worked import PROBLEMS, ROOT

EDITS = 200
PATCH = f"""
import {{ patched, removing, edited }} from {json.dumps((ROOT / "planmethod/studio/page/patch.js").as_uri())};
import {{ readFileSync }} from "node:fs";
const asked = JSON.parse(readFileSync(0, "utf-8"));
console.log(JSON.stringify(asked.map(({{ text, path, value, away }}) => patched(text, [[path, away ? undefined : value]]))));
"""  # noqa: E501

Path = list[Any]


def leaves(value: Any, path: Path) -> list[tuple[Path, Any]]:
    if isinstance(value, dict):
        return [leaf for key, one in value.items() for leaf in leaves(one, [*path, key])]
    if isinstance(value, list):
        return [leaf for key, one in enumerate(value) for leaf in leaves(one, [*path, key])]
    return [(path, value)]


def holder(table: Any, path: Path) -> Any:
    for part in path[:-1]:
        table = table[part]
    return table


def comments(text: str) -> list[str]:
    """Return the comments; text in quotes is none."""
    bare = re.sub(r'"""[\s\S]*?"""|"(?:\\.|[^"\\\n])*"|\'[^\'\n]*\'', '""', text)
    return re.findall(r"#.*", bare)


@pytest.mark.skipif(shutil.which("node") is None, reason="node is not installed")
def test_edits_of_shipped_files_have_the_meaning_of_edits_by_hand_and_keep_comments() -> None:
    chance = random.Random(55)
    asked: list[dict[str, Any]] = []
    wanted: list[dict[str, Any]] = []
    files = sorted(PROBLEMS.glob("*/*.toml"))
    while len(asked) < EDITS:
        text = chance.choice(files).read_text("utf-8")
        table = tomllib.loads(text)
        path, old = chance.choice(leaves(table, []))
        inside, what = holder(table, path), chance.randrange(4)
        value: Any = chance.choice([0.071, -12, "right of A", [1, 2.5], True])
        one = {"text": text, "path": path, "value": value, "away": False}
        if what == 0 and isinstance(inside, dict):
            one["path"] = [*path[:-1], "a new key"]
            inside["a new key"] = value
        elif what == 1 and isinstance(inside, dict) and len(inside) > 1:
            one["away"] = True
            del inside[path[-1]]
        else:
            one["value"] = value = value if isinstance(old, str) else 0.0815
            inside[path[-1]] = value
        asked.append(one)
        wanted.append(copy.deepcopy(table))
    done = subprocess.run(
        ["node", "--input-type=module", "-e", PATCH],
        input=json.dumps(asked), capture_output=True, text=True, check=True,
    )  # fmt: skip
    for one, made, table in zip(asked, json.loads(done.stdout), wanted, strict=True):
        assert tomllib.loads(made) == table, (one["path"], one["value"])
        if not one["away"]:
            assert comments(made) == comments(one["text"])
            grown = one["path"][-1] == "a new key"
            assert abs(made.count("\n") - one["text"].count("\n")) <= (4 if grown else 0)
        else:
            assert set(comments(made)) <= set(comments(one["text"]))
