"""Look at what differs from the outputs that were taken, and take it: ``make outputs``.

``--show PATTERN`` computes the outputs whose names have the pattern, alone, and shows how those
that differ differ from the revision that last took sums; ``--take`` takes what differs, sums and
facts. Where the facts of many outputs change it wants a reason, which goes into ``reasons.txt``.
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

from facts import (
    describe_changes,
    extract_facts,
    find_differing,
    make_facts,
    read_facts,
    select_outputs,
    write_facts,
)
from produced import ROOT, groups
from sums import SUMS, compare_sums, compute_sum, difference, make_texts, read_sums, write_sums

SHOWN = 200
"""Most lines of the difference of one output."""

FREE = 10
"""Outputs whose facts may change without a reason."""

REASONS = SUMS.with_name("reasons.txt")
"""How many outputs changed their facts, and why."""


def produced(pattern: str) -> dict[str, str]:
    """Return the texts of all outputs whose names have a pattern, made by two processes."""
    found: dict[str, str] = {}
    with Pool(2, maxtasksperchild=8) as pool:
        todo = groups()
        for done, texts in enumerate(
            pool.imap_unordered(partial(make_texts, wanted=partial(re.search, pattern)), todo), 1
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
        texts |= make_texts(group, {*names}.__contains__)
    for number, name in enumerate(names):
        if name in texts:
            (folder / str(number)).write_bytes(texts[name].encode())


def explain_refusal(count: int, reason: str) -> str:
    """Return why facts of so many outputs are not taken; nothing if they are."""
    if count <= FREE or reason.strip():
        return ""
    return (
        f"Nothing is taken: the facts of {count} outputs change, of more than {FREE}. "
        'Say why in a sentence: make outputs TAKE=1 REASON="...".'
    )


def report_changes(old: dict[str, list[str]], new: dict[str, list[str]], reason: str) -> int:
    """Print what facts change and return of how many outputs; end where a reason is missing."""
    names = find_differing(old, new)
    for name in names:
        print(name, *describe_changes(old.get(name, []), new.get(name, [])), sep="\n")
    if message := explain_refusal(len(names), reason):
        sys.exit(message)
    return len(names)


def take(sums: dict[str, str], texts: dict[str, str], reason: str) -> None:
    """Take sums, and the facts of the outputs that have some now."""
    old = read_facts()
    names = select_outputs(sums)
    new = {name: extract_facts(name, texts[name]) for name in names if name in texts}
    new |= {name: old[name] for name in names if name in old and name not in new}
    new |= make_facts(name for name in names if name not in new)
    count = report_changes(old, new, reason)
    write_sums(sums)
    write_facts(new)
    if reason.strip():
        with REASONS.open("a", encoding="utf-8") as file:
            file.write(f"{count} outputs: {' '.join(reason.split())}\n")


def main() -> None:
    """Look, show, take."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--show", default="", metavar="PATTERN")
    parser.add_argument("--take", action="store_true")
    # What is given to make is in the environment, with all its quotes.
    parser.add_argument("--reason", default=os.environ.get("REASON", ""))
    parser.add_argument("--write", nargs="+", metavar=("FOLDER", "NAME"), help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.write:
        write(Path(options.write[0]), options.write[1:])
        return
    if options.take and not options.reason.strip():  # facts are there in a tenth of the time
        old = {name: one for name, one in read_facts().items() if re.search(options.show, name)}
        report_changes(old, make_facts(old), options.reason)
    texts, stored = produced(options.show), read_sums()
    sums = {name: compute_sum(text) for name, text in texts.items()}
    selected = {name: one for name, one in stored.items() if re.search(options.show, name)}
    found = dict(compare_sums(sums, selected))
    for name, what in found.items():
        print(f"{what:8} {name}")
    print(f"{len(sums)} outputs, {len(found)} differ")
    if options.show and found and stored:
        texts_before = before(list(found))
        for name in found:
            print(
                *difference(name, texts_before.get(name, ""), texts.get(name, ""), SHOWN), sep="\n"
            )
    if options.take:
        unseen = {name: one for name, one in stored.items() if name not in selected}
        take({**unseen, **sums}, texts, options.reason)


if __name__ == "__main__":
    main()
