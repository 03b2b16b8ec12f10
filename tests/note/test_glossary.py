from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

from cases import each

ROOT = Path(__file__).parents[2]
GLOSSARY = (ROOT / "docs" / "reference" / "glossary.md").read_text(encoding="utf-8").casefold()
PACKAGE = ROOT / "planmethod"
FIELDS = ("construct", "mechanism", "plans", "problem/model.py")
"""Parts of the package whose classes are named after terms of the theory of mechanisms."""

IN_BRACKETS = re.compile(r"\(([^()]*[а-яё][^()]*)\)")


def classes() -> Iterator[tuple[str, str]]:
    for part in FIELDS:
        path = PACKAGE / part
        for module in sorted(path.rglob("*.py")) if path.is_dir() else [path]:
            for node in ast.walk(ast.parse(module.read_text(encoding="utf-8"))):
                if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
                    first = (ast.get_docstring(node) or "").split("\n", 1)[0]
                    for found in IN_BRACKETS.findall(first):
                        for term in found.split(","):
                            yield f"{module.stem}.{node.name}", term.strip()


@each("name, term", sorted(set(classes())))
def test_every_russian_term_of_a_class_is_in_the_glossary(name: str, term: str) -> None:
    assert term.casefold() in GLOSSARY, f"{name}: add '{term}' to docs/reference/glossary.md"


def test_rows_have_four_cells() -> None:
    rows = [line for line in GLOSSARY.splitlines() if line.startswith("|")]
    assert len(rows) > 60
    assert {line.replace("\\|", "").count("|") for line in rows} == {5}
