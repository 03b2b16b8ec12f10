"""A calculation as a Python notebook of cells that run from top to bottom (блокнот Python)."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator
from math import isfinite
from typing import Any

from planmethod.note.calculation.expression import Expression, names_of
from planmethod.note.calculation.model import (
    CalculationChapter,
    Equations,
    Heading,
    LivingCalculation,
    Quantity,
)
from planmethod.note.document import plain_text
from planmethod.note.wording import MessageTable
from planmethod.note.writers.formulatext import PRELUDE, PythonText, number_text, written

# no messages: source of a program

_SHOW = '''
def show(names):
    """{doc}"""
    for name in names.split():
        value = globals()[name]
        print(f"{{name:12}} =", np.array2string(np.asarray(value), precision=6, max_line_width=150))
'''

LINE = 96


def notebook(calculation: LivingCalculation, texts: MessageTable) -> bytes:
    """Return the notebook, nbformat 4: numpy is all that it needs."""
    cells = [
        _markdown(f"# {plain_text(calculation.title)}\n\n{plain_text(texts.notebook)}"),
        _code(PRELUDE + _SHOW.format(doc=plain_text(texts.shows))),
    ]
    rows = frozenset(
        one.name for chapter in calculation.chapters for one in chapter.quantities() if one.is_row
    )
    for chapter in calculation.chapters:
        cells += _chapter(chapter, rows, texts)
    for number, cell in enumerate(cells):
        told = f"{number}{cell['source']}".encode()
        cell["id"] = hashlib.sha256(told).hexdigest()[:8]
    made = {
        "cells": cells,
        "metadata": {
            "kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"},
            "language_info": {"name": "python"},
        },
        "nbformat": 4,
        "nbformat_minor": 5,
    }
    return (json.dumps(made, ensure_ascii=False, indent=1) + "\n").encode()


def _markdown(text: str) -> dict[str, Any]:
    return {"cell_type": "markdown", "metadata": {}, "source": text.splitlines(keepends=True)}


def _code(text: str) -> dict[str, Any]:
    lines = text.strip("\n").splitlines(keepends=True)
    return {
        "cell_type": "code", "execution_count": None, "metadata": {}, "outputs": [],
        "source": lines,
    }  # fmt: skip


def _chapter(
    chapter: CalculationChapter, rows: frozenset[str], texts: MessageTable
) -> Iterator[dict[str, Any]]:
    told = ""
    if len(chapter.heads) > 1:
        first, *_, last = (plain_text(head) for head in chapter.heads)
        told = "\n\n" + plain_text(texts.elements.format(first=first, last=last))
    yield _markdown(f"## {plain_text(chapter.title)}{told}")
    lines: list[str] = []
    names: list[str] = []

    def cell() -> Iterator[dict[str, Any]]:
        if lines:
            shown = [n for n in names if n]
            told = [
                f'show("{" ".join(shown[k : k + 8])}")' for k in range(0, len(shown), 8)
            ]  # fmt: skip
            yield _code("\n".join([*lines, "", *told]))
        lines.clear()
        names.clear()

    for item in chapter.items:
        if isinstance(item, Heading):
            yield from cell()
            level = "" if item.is_sentence else "### "
            yield _markdown(level + plain_text(item.text))
        elif isinstance(item, Quantity):
            lines.append(_line(item, rows))
            if not item.is_input:
                names.append(item.name)
        else:
            lines += _equations(item)
            names += [one.name for one in item.unknowns]
    yield from cell()


def _line(one: Quantity, rows: frozenset[str]) -> str:
    """Return the line of a quantity: its value or formula, with unit and remark."""
    notes = [plain_text(one.symbol) + (f", {plain_text(one.unit)}" if one.unit else "")]
    if one.remark:
        notes.append(plain_text(one.remark))
    comment = "  # " + "; ".join(notes).replace("\n", " ")
    if one.formula is not None:
        text = written(one.formula, PythonText(rows))
        if one.is_row and rows.isdisjoint(names_of(one.formula)):
            text = f"np.full({len(one.values)}, {text})"
    elif not one.is_row:
        text = _value(one.values[0])
    else:
        parts = [_element(one, k, rows) for k in range(len(one.values))]
        text = f"np.array([{', '.join(parts)}])"
        if len(text) > LINE:
            inner = "".join(f"    {part},\n" for part in parts)
            text = f"np.array([\n{inner}])"
            if all(formula is None for formula in one.formulas):
                text = f"np.array([\n{_wrapped(parts)}])"
    return f"{one.name} = {text}{comment}"


def _wrapped(parts: list[str]) -> str:
    found, line = "", "   "
    for part in parts:
        if len(line) + len(part) > LINE:
            found, line = f"{found}{line}\n", "   "
        line += f" {part},"
    return f"{found}{line}\n"


def _element(one: Quantity, k: int, rows: frozenset[str]) -> str:
    formula: Expression | None = one.formulas[k]
    if formula is None:
        return _value(one.values[k])
    return written(formula, PythonText(rows, k))


def _value(value: float) -> str:
    return number_text(value) if isfinite(value) else "np.nan"


def _equations(item: Equations) -> list[str]:
    dialect = PythonText(frozenset())
    lines = ["coefficients = np.array(["]
    for name, row in zip(item.names, item.coefficients, strict=True):
        told = ", ".join(written(one, dialect) for one in row)
        lines.append(f"    [{told}],  # {plain_text(name)}")
    right = ", ".join(written(one, dialect) for one in item.right)
    unknowns = ", ".join(one.name for one in item.unknowns)
    ending = "," if len(item.unknowns) == 1 else ""
    return [*lines, "])", f"{unknowns}{ending} = np.linalg.solve(coefficients, [{right}])"]
