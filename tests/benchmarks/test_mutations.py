"""The list of mutations keeps up with the code."""

from __future__ import annotations

import tomllib
from collections import Counter

from benchmarks.mutations import LIST, ROOT


def test_every_mutation_changes_one_place_of_an_existing_file_and_names_existing_tests() -> None:
    mutations = tomllib.loads(LIST.read_text("utf-8"))["mutation"]
    names = Counter(mutation["name"] for mutation in mutations)
    stale = [f"{name}: its name occurs {count} times" for name, count in names.items() if count > 1]
    for mutation in mutations:
        file = ROOT / mutation["file"]
        count = file.read_text("utf-8").count(mutation["old"]) if file.exists() else 0
        if count != 1:
            stale.append(f"{mutation['name']}: its text occurs {count} times in {mutation['file']}")
        if mutation["old"] == mutation["new"]:
            stale.append(f"{mutation['name']}: its new text is the old one")
        stale += [
            f"{mutation['name']}: no {test}"
            for test in mutation["tests"]
            if not (ROOT / test).exists()
        ]
    assert not stale
