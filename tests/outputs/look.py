"""Look at what differs from the outputs that were taken, and take it: ``make outputs``.

``--show PATTERN`` computes the outputs whose names have the pattern, alone, and shows how those
that differ differ from the revision that last took sums; ``--take`` takes what differs.
"""

from __future__ import annotations

import argparse
import os
import re
import subprocess
import sys
import tempfile
from functools import partial
from multiprocessing import Pool
from pathlib import Path

from produced import ROOT, groups
from sums import (
    SUMS,
    WHOLE,
    compared,
    difference,
    kept_sums,
    sum_of,
    text_file,
    texts_of,
    write_sums,
)

SHOWN = 200
"""Most lines of the difference of one output."""


def produced(pattern: str) -> dict[str, str]:
    """Return the texts of all outputs whose names have a pattern, made by two processes."""
    found: dict[str, str] = {}
    with Pool(2, maxtasksperchild=8) as pool:
        todo = groups()
        for done, texts in enumerate(
            pool.imap_unordered(partial(texts_of, wanted=partial(re.search, pattern)), todo), 1
        ):
            found |= texts
            print(f"\r{done} of {len(todo)}", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    return found


def before(names: list[str]) -> dict[str, str]:
    """Return texts as the revision that took the sums makes them, in a tree of its own."""
    git = partial(subprocess.run, cwd=ROOT, check=True, capture_output=True, encoding="utf-8")
    revision = git(["git", "log", "-1", "--format=%H", "--", str(SUMS)]).stdout.strip()
    with tempfile.TemporaryDirectory() as folder:
        tree = Path(folder) / "tree"
        git(["git", "worktree", "add", "--detach", str(tree), revision])
        try:
            paths = os.pathsep.join(map(str, (tree, tree / "tests", tree / "tests/outputs")))
            subprocess.run(
                [sys.executable, tree / "tests/outputs/look.py", "--write", folder, *names],
                env={**os.environ, "PYTHONPATH": paths},
                cwd=tree,
                check=True,
            )
        finally:
            git(["git", "worktree", "remove", "--force", str(tree)])
        files = {name: Path(folder) / str(number) for number, name in enumerate(names)}
        return {name: file.read_bytes().decode() for name, file in files.items() if file.exists()}


def write(folder: Path, names: list[str]) -> None:
    """Write the texts of outputs into files called by their numbers."""
    texts: dict[str, str] = {}
    for group in sorted({name.partition(": ")[0] for name in names}):
        texts |= texts_of(group, {*names}.__contains__)
    for number, name in enumerate(names):
        if name in texts:
            (folder / str(number)).write_bytes(texts[name].encode())


def main() -> None:
    """Look, show, take."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--show", default="", metavar="PATTERN")
    parser.add_argument("--take", action="store_true")
    parser.add_argument("--write", nargs="+", metavar=("FOLDER", "NAME"), help=argparse.SUPPRESS)
    asked = parser.parse_args()
    if asked.write:
        write(Path(asked.write[0]), asked.write[1:])
        return
    texts, kept = produced(asked.show), kept_sums()
    sums = {name: sum_of(text) for name, text in texts.items()}
    looked_at = {name: one for name, one in kept.items() if re.search(asked.show, name)}
    found = dict(compared(sums, looked_at))
    for name, what in found.items():
        print(f"{what:8} {name}")
    print(f"{len(sums)} outputs, {len(found)} differ")
    if asked.show and found and kept:
        old = before(list(found))
        for name in found:
            print(*difference(name, old.get(name, ""), texts.get(name, ""), SHOWN), sep="\n")
    if asked.take:
        write_sums({**{name: one for name, one in kept.items() if name not in looked_at}, **sums})
        for name in WHOLE:
            if name in texts:
                text_file(name).write_bytes(texts[name].encode())


if __name__ == "__main__":
    main()
