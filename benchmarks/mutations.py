"""Mutations of the code behind the texts and drawings, and whether tests notice (мутации).

``python -m benchmarks.mutations`` makes each mistake of ``mutations.toml`` in a copy of the tree,
runs the tests named beside it, and prints a table; names or words as arguments choose among them.
The text of a mutation occurs once in its file: if you move the code, fix the entry.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent.parent
LIST = Path(__file__).with_suffix(".toml")


def copied(folder: Path) -> Path:
    """Copy the files that git knows, and new ones that it would take, to a folder."""
    listed = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    names = subprocess.run(listed, cwd=ROOT, check=True, capture_output=True, text=True).stdout
    for name in filter(None, names.split("\0")):
        if (ROOT / name).is_file():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, folder / name)
    return folder


def is_killed(tree: Path, mutation: dict[str, Any]) -> bool:
    """Make a mutation in a tree, run its tests there, and take it back; True where they fail."""
    file = tree / mutation["file"]
    text = file.read_text("utf-8")
    if text.count(mutation["old"]) != 1:
        raise SystemExit(f"{mutation['name']}: its text does not stand once in {mutation['file']}")
    file.write_text(text.replace(mutation["old"], mutation["new"]), "utf-8")
    tests = [name for name in mutation["tests"] if (tree / name).exists()]
    run = [sys.executable, "-m", "pytest", "-q", "-x", "-p", "no:cacheprovider", *tests]
    own = {**os.environ, "PYTHONPATH": str(tree), "PYTHONDONTWRITEBYTECODE": "1"}
    try:
        done = subprocess.run(run, cwd=tree, env=own, capture_output=True, text=True)
    finally:
        file.write_text(text, "utf-8")
    if done.returncode not in (0, 1):
        raise SystemExit(f"{mutation['name']}: {done.stdout[-800:]}{done.stderr[-800:]}")
    return done.returncode == 1


def main(words: list[str]) -> None:
    """Print the table of the chosen mutations; exit with 1 where one survives."""
    mutations = tomllib.loads(LIST.read_text("utf-8"))["mutation"]
    chosen = [m for m in mutations if not words or {m["name"], m["room"], m["set"]} & {*words}]
    survived = []
    with tempfile.TemporaryDirectory() as folder:
        tree = copied(Path(folder))
        for mutation in chosen:
            killed = is_killed(tree, mutation)
            survived += [] if killed else [mutation["name"]]
            told = "killed" if killed else "SURVIVED"
            print(f"{told:9} {mutation['room']:10} {mutation['name']}", flush=True)
    print(f"{len(chosen) - len(survived)} of {len(chosen)} killed")
    raise SystemExit(bool(survived))


if __name__ == "__main__":
    main(sys.argv[1:])
