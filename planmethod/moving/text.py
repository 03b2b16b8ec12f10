"""A moving point as text for the terminal: its law, formulas with numbers, tables."""

from __future__ import annotations

from planmethod.moving.model import Law, PointProblem
from planmethod.moving.motion import COLUMNS, POLAR, Motion, Why, move
from planmethod.note.numbers import alike, significant, with_unit
from planmethod.note.plaintext import columns_text, heading, spoken, table, wrap
from planmethod.note.plaintext import given as written
from planmethod.note.wording import Wording, language

FEW = 3
"""Most moments that are told with formulas; more are rows of a table."""

SYMBOLS = {
    **dict(zip(("t", "x", "y", "v", "a", "rho"), ("t", "x", "y", "v", "a", "ρ"), strict=True)),
    "vx": "v_x",
    "vy": "v_y",
    "ax": "a_x",
    "ay": "a_y",
    "a_tangential": "a_τ",
    "a_normal": "a_n",
    "s": "s",
    "r": "r",
    "phi": "φ",
    "v_r": "v_r",
    "v_phi": "v_φ",
    "a_r": "a_r",
    "a_phi": "a_φ",
}
"""How columns of the record and formulas of the file are written."""


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
    for key, formula in problem.formulas.items():
        shown = formula.text.replace("**", "^").replace("*", "·")
        unit = words.units["rad" if key == "phi" else "m"]
        lines += wrap(f"{SYMBOLS[key]} = {shown}  ({unit})", first="  ", rest="    ")
    if problem.law is Law.NATURAL:
        path = said.point.line
        if problem.radius is not None:
            path = said.point.circle.format(radius=written(problem.radius, words))
        lines.append(f"  {path}")
    count = len(problem.times)
    for k in range(count if count <= FEW else 0):
        lines += ["", *_moment(motion, k, words, lang)]
    if count > FEW:
        lines += ["", *_rows(motion, COLUMNS, words)]
        for k, why in enumerate(motion.reasons):
            if why is not None:
                time = written(problem.times[k], words)
                lines += wrap(f"t = {time}: {said.point.reasons[why.value]}", rest="  ")
    if problem.law is Law.POLAR:
        lines += ["", said.point.polar, *_rows(motion, ("t", *POLAR), words)]
    printed = _printed(problem, motion, words, lang)
    return "\n".join([*lines, *(["", *printed] if printed else [])])


def _unit(name: str, words: Wording) -> str:
    units = {"t": "", "phi": "rad", "v": "m/s", "a": "m/s²"}
    unit = units.get(name, units.get(name[0], "m"))
    return words.units[unit] if unit else ""


def _rows(motion: Motion, names: tuple[str, ...], words: Wording) -> list[str]:
    columns = []
    for name in names:
        unit = _unit(name, words)
        values = [float(value) for value in motion.columns[name]]
        told = alike(values) if all(v == v for v in values) else [significant(v) for v in values]
        cells = [spoken(cell, words) for cell in told]
        if name == "t":
            cells = [written(value, words) for value in values]
        columns.append([f"{SYMBOLS[name]}, {unit}" if unit else SYMBOLS[name], *cells])
    return columns_text(columns, 1)


def _moment(motion: Motion, k: int, words: Wording, lang: str) -> list[str]:
    """Tell one moment: every formula with its numbers."""
    point = language(lang).point
    value = {name: float(column[k]) for name, column in motion.columns.items()}
    why = motion.reasons[k]

    def put(name: str, *, signed: bool = True) -> str:
        shown = written(value[name], words, 5)
        return f"({shown})" if signed and value[name] < 0 else shown

    def line(name: str, formula: str = "", numbers: str = "") -> str:
        unit, found = _unit(name, words), written(value[name], words, 5)
        between = f"{formula} = {numbers} = " if formula else ""
        return f"  {SYMBOLS[name]} = {between}{with_unit(found, unit)}"

    def root(kind: str) -> tuple[str, str]:
        x, y = f"{kind}x", f"{kind}y"
        letters = f"√({SYMBOLS[x]}² + {SYMBOLS[y]}²)"
        return letters, f"√({put(x)}² + {put(y)}²)"

    lines = heading(point.at.format(time=written(value["t"], words)))
    if why is not Why.POSITION:
        lines += [line("x"), line("y")]
    if why not in (Why.POSITION, Why.VELOCITY):
        lines += [line("vx"), line("vy"), line("v", *root("v"))]
    if why in (None, Why.REST, Why.STRAIGHT):
        lines += [line("ax"), line("ay"), line("a", *root("a"))]
    if why in (None, Why.STRAIGHT):
        along = f"({put('vx')}·{put('ax')} + {put('vy')}·{put('ay')})/{put('v')}"
        across = f"|{put('vx')}·{put('ay')} − {put('vy')}·{put('ax')}|/{put('v')}"
        lines.append(line("a_tangential", "(v_x·a_x + v_y·a_y)/v", along))
        lines.append(line("a_normal", "|v_x·a_y − v_y·a_x|/v", across))
    if why is None:
        lines.append(line("rho", "v²/a_n", f"{put('v')}²/{put('a_normal')}"))
    else:
        lines += wrap(point.reasons[why.value], first="  ", rest="  ")
    return lines


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
        rows.append((item.name, SYMBOLS.get(item.what, "—"), *cells))
    return table(language(lang).point.printed, rows, left=2) if rows else []
