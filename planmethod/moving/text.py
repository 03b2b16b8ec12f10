"""A moving point in formulas and numbers: rich text for sheet and note, the terminal's text."""

from __future__ import annotations

from collections.abc import Callable

from planmethod.moving.model import Law, PointProblem
from planmethod.moving.motion import COLUMNS, POLAR, ROLLED, Motion, Undefined, move
from planmethod.note.numbers import MINUS, Notation, alike, significant, with_unit
from planmethod.note.plaintext import given as written
from planmethod.note.plaintext import plain_text, spoken
from planmethod.note.wording import Language, Wording, language
from planmethod.note.writers.plain import columns_text, heading, table, wrap
from planmethod.pattern import pattern

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


SYMBOLS = {
    **dict(zip(("t", "x", "y", "v", "a", "rho"), ("t", "x", "y", "v", "a", "ρ"), strict=True)),
    "vx": "v_{x}",
    "vy": "v_{y}",
    "ax": "a_{x}",
    "ay": "a_{y}",
    "a_tangential": "a_{τ}",
    "a_normal": "a_{n}",
    "s": "s",
    "r": "r",
    "phi": "φ",
    "v_r": "v_{r}",
    "v_phi": "v_{φ}",
    "a_r": "a_{r}",
    "a_phi": "a_{φ}",
    "omega": "ω",
    "epsilon": "ε",
    "xC": "x_{C}",
    "yC": "y_{C}",
    "xP": "x_{P}",
    "yP": "y_{P}",
    "omega_H": "ω_{H}",
    "epsilon_H": "ε_{H}",
    "theta": "θ",
}
"""How columns of the record and formulas of the file are written, rich text."""


def unit_of(name: str) -> str:
    """Return the SI unit of a column."""
    units = {"t": "s", "phi": "rad", "v": "m/s", "a": "m/s²", "omega": "1/s", "epsilon": "1/s²"}
    name = name.removesuffix("_H")
    return units.get(name, units.get(name[0], "m"))


def textbook(text: str, decimal: str) -> str:
    """Return a formula of a file as a textbook prints it, rich text: powers, roots, π."""
    shown = _ROOT.sub("√", _PI.sub("π", text.replace(".", decimal).replace("-", MINUS)))
    return raised_powers(shown)


_PI, _ROOT = pattern(r"\bpi\b"), pattern(r"\bsqrt\b")


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
    """Return where the power ends that a text begins with: ``-t``, ``(1/2)``, ``2^t``."""
    named = _POWER.match(tail)
    end = named.end() if named else 0
    if tail[end : end + 1] == "(":
        depth = 0
        for k, sign in enumerate(tail[end:], end + 1):
            depth += {"(": 1, ")": -1}.get(sign, 0)
            if not depth:
                end = k
                break
    return end + 1 + _end_of_power(tail[end + 1 :]) if tail[end : end + 1] == "^" else end


_POWER = pattern(r" *[-+− ]*(?:[0-9.,]+(?:[eE][-+−]?[0-9]+)?|[A-Za-z_π√]+[0-9]*)?")


def law_lines(
    problem: PointProblem, words: Language, written: Callable[[str], str] = str
) -> list[str]:
    """Return the law of motion, rich text: its formulas, and along what the point moves.

    ``written`` tells how the text of a formula is written.
    """
    said, say = words.point, words.say
    lines = []
    for key, formula in problem.formulas.items():
        shown = written(formula.text.replace("**", "^").replace("*", "·"))
        lines.append(
            f"{SYMBOLS[key]} = {shown} ({say.units['rad' if key in ('phi', 'theta') else 'm']})"
        )
    if problem.law is Law.NATURAL:
        path = said.line
        if problem.radius is not None:
            path = said.circle.format(radius=say.given(problem.radius))
        lines.append(path)
    if problem.wheel is not None:
        wheel = problem.wheel
        kind = "line" if not wheel.track else "on" if wheel.track > 0 else "within"
        size = wheel.arm or abs(wheel.track)
        track = said.tracks["arm" if wheel.arm else kind].format(radius=say.given(size))
        numbers = {
            "radius": say.given(wheel.radius),
            "r": say.given(wheel.r),
            "angle": say.given(wheel.angle),
        }
        lines.append(said.wheel.format(track=track, **numbers))
    return lines


def moment_lines(problem: PointProblem, motion: Motion, k: int, words: Language) -> list[str]:
    """Return one moment, rich text: every formula with its numbers, and what does not exist."""
    value = {name: float(column[k]) + 0.0 for name, column in motion.columns.items()}
    why, say = motion.reasons[k], words.say

    def put(name: str) -> str:
        shown = say.short(value[name])
        return f"({shown})" if value[name] < 0 or "^" in shown else shown

    def line(name: str, formula: str = "", numbers: str = "") -> str:
        between = f"{formula} = {numbers} = " if formula else ""
        found = with_unit(say.short(value[name]), say.units[unit_of(name)])
        return f"{SYMBOLS[name]} = {between}{found}"

    def root(x: str, y: str) -> tuple[str, str]:
        letters = f"√({SYMBOLS[x]}^{{2}} + {SYMBOLS[y]}^{{2}})"
        return letters, f"√({put(x)}^{{2}} + {put(y)}^{{2}})"

    lines: list[str] = []
    if why is not Undefined.POSITION:
        lines += [line("x"), line("y")]
    if why not in (Undefined.POSITION, Undefined.VELOCITY):
        lines += [line("vx"), line("vy"), line("v", *root("vx", "vy"))]
        lines += _other_velocities(problem, value, line, say)
    if why in (None, Undefined.REST, Undefined.STRAIGHT):
        lines += [line("ax"), line("ay"), line("a", *root("ax", "ay"))]
    if why in (None, Undefined.STRAIGHT):
        dot = f"({put('vx')}·{put('ax')} + {put('vy')}·{put('ay')})/{put('v')}"
        cross = f"|{put('vx')}·{put('ay')} − {put('vy')}·{put('ax')}|/{put('v')}"
        lines.append(line("a_tangential", "(v_{x}·a_{x} + v_{y}·a_{y})/v", dot))
        lines.append(line("a_normal", "|v_{x}·a_{y} − v_{y}·a_{x}|/v", cross))
    if why is None:
        lines.append(line("rho", "v^{2}/a_{n}", f"{put('v')}^{{2}}/{put('a_normal')}"))
    else:
        lines.append(words.point.reasons[why.value])
    return lines


def _other_velocities(
    problem: PointProblem, value: dict[str, float], line: Callable[..., str], say: Notation
) -> list[str]:
    """Return what a polar motion, or a rolling wheel, has besides."""
    if problem.law is Law.POLAR:
        return [line("v_r"), line("v_phi")]
    if problem.law is Law.ROLLING:
        reach = abs(complex(value["x"] - value["xP"], value["y"] - value["yP"]))
        omega, arm = say.short(abs(value["omega"])), say.short(reach)
        return [
            line("omega"),
            f"PM = {with_unit(arm, say.units['m'])}",
            line("v", "|ω|·PM", f"{omega}·{arm}"),
        ]
    return []
