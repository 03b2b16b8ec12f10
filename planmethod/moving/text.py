"""A moving point in formulas, numbers and as a JSON record."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np

from planmethod.moving.motion import (
    COLUMNS,
    LEGEND,
    POLAR,
    ROLLED,
    Law,
    Motion,
    PointProblem,
    Undefined,
    move,
)
from planmethod.note.compared import ComparedNumber
from planmethod.note.document import (
    Caption,
    Chapter,
    Formula,
    GivenFact,
    Item,
    Node,
    Note,
    Table,
    Title,
    table_of,
    table_of_columns,
)
from planmethod.note.formula import Rich, escape, fraction, root
from planmethod.note.numbers import (
    MINUS,
    Notation,
    finite_or_none,
    format_column,
    significant,
    with_unit,
)
from planmethod.note.records.legend import legend_record
from planmethod.note.wording import Language

SCHEMA = 1
"""Version of the record's shape."""


def record(problem: PointProblem, lang: str = "ru") -> dict[str, Any]:
    """Return the motion of a point as plain data; a missing value is null, with a reason."""
    motion = move(problem)
    rows: list[dict[str, Any]] = []
    for k, why in enumerate(motion.reasons):
        row: dict[str, Any] = {
            name: finite_or_none(column[k]) for name, column in motion.columns.items()
        }
        if why is not None:
            row["reason"] = why.value
        rows.append(row)
    found: dict[str, Any] = {"schema": SCHEMA, "problem": problem.name}
    if problem.variant is not None:
        found["variant"] = problem.variant
    legend = ((name, LEGEND[name].symbol, LEGEND[name].unit) for name in motion.columns)
    return {**found, "point": rows, "legend": legend_record(legend)}


FEW = 3
"""Most moments that are written with formulas; more are rows of a table."""


def solved_document(problem: PointProblem, language: Language) -> Iterator[Node]:
    """Yield the motion of a point: its law, moments or their table, printed values."""
    texts, notation, motion = language.point, language.notation, move(problem)
    yield title(problem)
    yield from law(problem, language)
    count = len(problem.times)
    for k in range(count if count <= FEW else 0):
        yield Chapter(texts.at.format(time=notation.as_input(problem.times[k])), numbered=False)
        yield from moment(problem, motion, k, language)
    if count > FEW:
        yield _table(motion, COLUMNS, notation)
        for k, why in enumerate(motion.reasons):
            if why is not None:
                yield Item(
                    f"t = {notation.as_input(problem.times[k])}: {texts['reasons'][why.value]}"
                )
    if problem.law is Law.POLAR:
        yield Caption(texts.polar)
        yield _table(motion, ("t", *POLAR), notation)
    if problem.law is Law.ROLLING:
        yield Caption(texts.rolled)
        yield _table(motion, ("t", *(name for name in ROLLED if name in motion.columns)), notation)
    printed = list(_printed(problem, motion, notation))
    if printed:
        yield table_of(texts["printed"], printed, names=2)


def title(problem: PointProblem) -> Title:
    """Return the title of a problem, its variant with it."""
    variant = f" ({problem.variant})" if problem.variant else ""
    return Title(escape((problem.title or problem.name) + variant))


def _table(motion: Motion, names: Sequence[str], notation: Notation) -> Table:
    columns = []
    for name in names:
        values = [float(value) for value in motion.columns[name]]
        if name == "t":
            columns.append(["t", *map(notation.as_input, values)])
            continue
        told = format_column(values) if all(v == v for v in values) else map(significant, values)
        columns.append([head_of(name, notation), *map(notation.number, told)])
    return table_of_columns(columns, repeated=1)


def head_of(name: str, notation: Notation) -> Rich:
    """Return the head of a column: symbol and unit."""
    return f"{LEGEND[name].symbol}, {notation.units[LEGEND[name].unit]}"


def _printed(
    problem: PointProblem, motion: Motion, notation: Notation
) -> Iterator[tuple[Rich, ...]]:
    """Yield printed values beside the exact ones."""
    for item in problem.published:
        exact = float(motion.columns[item.what][item.position or 0]) if item.what else float("nan")
        one = ComparedNumber(exact, item.value)
        yield (
            escape(item.name),
            LEGEND[item.what].symbol if item.what else "—",
            notation.as_input(item.value),
            *notation.numbers(one.exact_text, one.off_text),
        )


def textbook(text: str, decimal: str) -> str:
    """Return a formula of a file as a textbook prints it, rich text: powers, roots, π."""
    shown = re.sub(_ROOT, "√", re.sub(_PI, "π", text.replace(".", decimal).replace("-", MINUS)))
    return raised_powers(shown)


_PI, _ROOT = r"\bpi\b", r"\bsqrt\b"


def raised_powers(text: str) -> str:
    """Return a formula of a file as rich text: ``t^(1/2)`` with its power above the line."""
    head, sign, tail = text.partition("^")
    if not sign:
        return text
    end = _end_of_power(tail)
    power = tail[:end].strip()
    if power.startswith("(") and power.endswith(")") and power.count("(") == 1:
        power = power[1:-1]
    return f"{head}^{{{raised_powers(power)}}}{raised_powers(tail[end:])}"


def _end_of_power(tail: str) -> int:
    """Return the end of the power at the beginning of a text: ``-t``, ``(1/2)``, ``2^t``."""
    named = re.match(_POWER, tail)
    end = named.end() if named else 0
    if tail[end : end + 1] == "(":
        depth = 0
        for k, sign in enumerate(tail[end:], end + 1):
            depth += {"(": 1, ")": -1}.get(sign, 0)
            if not depth:
                end = k
                break
    return end + 1 + _end_of_power(tail[end + 1 :]) if tail[end : end + 1] == "^" else end


_POWER = r" *[-+− ]*(?:[0-9.,]+(?:[eE][-+−]?[0-9]+)?|[A-Za-z_π√]+[0-9]*)?"


def law(problem: PointProblem, language: Language) -> Iterator[Formula | Item]:
    """Yield the law of motion: its formulas, and the path of the point."""
    for fact in law_facts(problem, language):
        is_formula = any(key.removeprefix("point.") in problem.formulas for key in fact.data)
        yield Formula(fact.text) if is_formula else Item(fact.text)


def given_facts(problem: PointProblem, language: Language) -> list[GivenFact]:
    """Return the given data: the law and the moments, which determine the motion (дано)."""
    return [*law_facts(problem, language), moments(problem, language)]


def law_facts(problem: PointProblem, language: Language) -> Iterator[GivenFact]:
    """Yield the law of motion, a fact each."""
    texts, notation = language.point, language.notation
    for key, formula in problem.formulas.items():
        shown = textbook(formula.text.replace("**", "^").replace("*", "·"), notation.decimal)
        text = f"{LEGEND[key].symbol} = {shown} ({notation.units[LEGEND[key].unit]})"
        yield GivenFact(text, {f"point.{key}": formula.text})
    if problem.law is Law.NATURAL:
        path, data = texts.line, {}
        if problem.radius is not None:
            path = texts.circle.format(radius=notation.as_input(problem.radius))
            data = {"point.radius": problem.radius}
        yield GivenFact(path, data)
    if problem.wheel is not None:
        wheel = problem.wheel
        kind = "line" if not wheel.track else "on" if wheel.track > 0 else "within"
        kind, size = ("arm", wheel.arm) if wheel.arm else (kind, abs(wheel.track))
        numbers = {
            "radius": notation.as_input(wheel.radius),
            "r": notation.as_input(wheel.r),
            "angle": notation.as_input(wheel.angle),
        }
        own = {"radius": wheel.radius, "r": wheel.r, "angle": wheel.angle}
        own |= {kind: size} if kind != "line" else {}
        track = texts["tracks"][kind].format(radius=notation.as_input(size))
        text = texts.wheel.format(track=track, **numbers)
        yield GivenFact(text, {f"point.wheel.{key}": value for key, value in own.items()})


def moments(problem: PointProblem, language: Language) -> GivenFact:
    """Return the moments: each, or the ends of a row of more than a few at equal intervals."""
    times, notation = problem.times, language.notation
    if len(times) > FEW:
        start, end = times[0], times[-1]
        steps = np.linspace(start, end, len(times))
        if end > start and np.allclose(
            times, steps, rtol=0, atol=1e-12 * max(abs(start), abs(end))
        ):
            ends = {"start": notation.as_input(start), "end": notation.as_input(end)}
            row = {"from": start, "to": end, "count": len(times)}
            text = language.point.row.format(**ends, count=len(times))
            return GivenFact(text, {f"point.t.{key}": value for key, value in row.items()})
    told = "; ".join(map(notation.as_input, sorted(set(times))))
    return GivenFact(language.point.moments.format(times=told), {"point.t": list(times)})


def moment(
    problem: PointProblem, motion: Motion, k: int, language: Language
) -> Iterator[Formula | Note]:
    """Yield one moment: every formula with its numbers, and the undefined quantities."""
    value = {name: float(column[k]) + 0.0 for name, column in motion.columns.items()}
    why, notation = motion.reasons[k], language.notation

    def bracketed(name: str) -> str:
        shown = notation.short(value[name])
        return f"({shown})" if value[name] < 0 or "^" in shown else shown

    def line(name: str, formula: str = "", numbers: str = "") -> Formula:
        between = f"{formula} = {numbers} = " if formula else ""
        found = with_unit(notation.short(value[name]), notation.units[LEGEND[name].unit])
        return Formula(f"{LEGEND[name].symbol} = {between}{found}")

    def length(x: str, y: str) -> tuple[str, str]:
        squares = f"{LEGEND[x].symbol}^{{2}} + {LEGEND[y].symbol}^{{2}}"
        return root(squares), root(f"{bracketed(x)}^{{2}} + {bracketed(y)}^{{2}}")

    if why is not Undefined.POSITION:
        yield from (line("x"), line("y"))
    if why not in (Undefined.POSITION, Undefined.VELOCITY):
        yield from (line("vx"), line("vy"), line("v", *length("vx", "vy")))
        yield from _other_velocities(problem, value, line, notation)
    if why in (None, Undefined.REST, Undefined.STRAIGHT):
        yield from (line("ax"), line("ay"), line("a", *length("ax", "ay")))
    if why in (None, Undefined.STRAIGHT):
        dot = f"{bracketed('vx')}·{bracketed('ax')} + {bracketed('vy')}·{bracketed('ay')}"
        cross = f"|{bracketed('vx')}·{bracketed('ay')} − {bracketed('vy')}·{bracketed('ax')}|"
        tangential, normal = "v_{x}·a_{x} + v_{y}·a_{y}", "|v_{x}·a_{y} − v_{y}·a_{x}|"
        for name, above, text in (("tangential", tangential, dot), ("normal", normal, cross)):
            sides = fraction(above, "v"), fraction(text, bracketed("v"))
            yield line(f"a_{name}", *sides)
    if why is None:
        square = fraction(f"{bracketed('v')}^{{2}}", bracketed("a_normal"))
        yield line("rho", fraction("v^{2}", "a^{n}"), square)
    else:
        yield Note(language.point["reasons"][why.value])


def _other_velocities(
    problem: PointProblem, value: dict[str, float], line: Callable[..., Formula], notation: Notation
) -> list[Formula]:
    """Return the further quantities of a polar motion, or of a rolling wheel."""
    if problem.law is Law.POLAR:
        return [line("v_r"), line("v_phi")]
    if problem.law is Law.ROLLING:
        reach = abs(complex(value["x"] - value["xP"], value["y"] - value["yP"]))
        omega, arm = notation.short(abs(value["omega"])), notation.short(reach)
        return [
            line("omega"),
            Formula(f"PM = {with_unit(arm, notation.units['m'])}"),
            line("v", "|ω|·PM", f"{omega}·{arm}"),
        ]
    return []
