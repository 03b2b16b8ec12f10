"""A moving point as text for the terminal: its law, formulas with numbers, tables."""

from __future__ import annotations

from planmethod.moving.model import Law, PointProblem
from planmethod.moving.motion import COLUMNS, POLAR, ROLLED, Motion, move
from planmethod.moving.told import SYMBOLS, law_lines, moment_lines, unit_of
from planmethod.note.numbers import alike, significant
from planmethod.note.plaintext import columns_text, heading, plain_text, spoken, table, wrap
from planmethod.note.plaintext import given as written
from planmethod.note.wording import Wording, language

FEW = 3
"""Most moments that are told with formulas; more are rows of a table."""


def solved_text(problem: PointProblem, lang: str = "ru") -> str:
    """Return the motion of a point as text of at most 100 columns.

    Raises
    ------
    UnknownLanguageError
    """
    said = language(lang)
    words, motion = said.note, move(problem)
    variant = f" ({problem.variant})" if problem.variant else ""
    lines = wrap((problem.title or problem.name) + variant)
    for told in law_lines(problem, said):
        lines += wrap(plain_text(told), first="  ", rest="    ")
    count = len(problem.times)
    for k in range(count if count <= FEW else 0):
        time = written(problem.times[k], words)
        lines += ["", *heading(said.point.at.format(time=time))]
        for told in moment_lines(problem, motion, k, said):
            lines += wrap(plain_text(told), first="  ", rest="  ")
    if count > FEW:
        lines += ["", *_rows(motion, COLUMNS, words)]
        for k, why in enumerate(motion.reasons):
            if why is not None:
                time = written(problem.times[k], words)
                lines += wrap(f"t = {time}: {said.point.reasons[why.value]}", rest="  ")
    if problem.law is Law.POLAR:
        lines += ["", said.point.polar, *_rows(motion, ("t", *POLAR), words)]
    if problem.law is Law.ROLLING:
        lines += [
            "",
            said.point.rolled,
            *_rows(motion, tuple(n for n in ("t", *ROLLED) if n in motion.columns), words),
        ]
    printed = _printed(problem, motion, words, lang)
    return "\n".join([*lines, *(["", *printed] if printed else [])])


def _rows(motion: Motion, names: tuple[str, ...], words: Wording) -> list[str]:
    columns = []
    for name in names:
        unit = words.units[unit_of(name)] if name != "t" else ""
        symbol = plain_text(SYMBOLS[name])
        values = [float(value) for value in motion.columns[name]]
        told = alike(values) if all(v == v for v in values) else [significant(v) for v in values]
        cells = [spoken(cell, words) for cell in told]
        if name == "t":
            cells = [written(value, words) for value in values]
        columns.append([f"{symbol}, {unit}" if unit else symbol, *cells])
    return columns_text(columns, 1)


def _printed(problem: PointProblem, motion: Motion, words: Wording, lang: str) -> list[str]:
    """Return printed values beside the exact ones."""
    rows = []
    for item in problem.published:
        exact = float(motion.columns[item.what][item.position or 0]) if item.what else float("nan")
        cells = (
            written(item.value, words),
            spoken(significant(exact), words),
            spoken(significant(item.value - exact, 2), words),
        )
        rows.append((item.name, plain_text(SYMBOLS.get(item.what, "—")), *cells))
    return table(language(lang).point.printed, rows, left=2) if rows else []
