"""A tape as one straight line of Python or JavaScript: source made of numbers and letters."""

from __future__ import annotations

import math
import struct
from collections.abc import Callable, Sequence
from typing import Any

from planmethod.compiled.tape import Guard, Ref, Tape

EQUAL = 1e-9
"""Largest departure from equal steps, degrees, that a table of angles corrects."""

BINARY = {"add": "+", "sub": "-", "mul": "*", "div": "/"}


class ImpossibleError(ArithmeticError):
    """A step is impossible in some position; running the tape in blocks shows which one."""


Straight = Callable[[Sequence[Sequence[float]], bytearray], None]
"""Function of a sequence for each input; it packs the results into a buffer, float64, position by
position."""


def used_by(tape: Tape, results: Sequence[Ref]) -> list[int]:
    """Return the nodes that some results need, in the order in which they are run.

    The parts of the tape follow each other, so that values that no later part reads are released
    with their part.
    """
    part = {ref: tape.parts[ref] for ref in results if type(ref) is int}
    for number in range(len(tape.nodes) - 1, -1, -1):
        node = tape.nodes[number]
        if number in part and node.kind != "input":
            for ref in node.operands:
                if type(ref) is int:  # a value that an earlier part reads is computed there
                    part[ref] = min(part.get(ref, tape.parts[ref]), part[number])
    return sorted(part, key=lambda number: (part[number], number))


def straight(tape: Tape, results: Sequence[Ref], guards: Sequence[Guard]) -> Straight:
    """Compile a tape to a function of positions.

    Raises
    ------
    ImpossibleError, ZeroDivisionError, ValueError, OverflowError
        By the function made, where a step is impossible in some position.
    """
    lines = _Lines(tape, results, guards)
    namespace: dict[str, Any] = {
        "sqrt": math.sqrt,
        "sin": math.sin,
        "cos": math.cos,
        "remainder": math.remainder,
        "atan2": math.atan2,
        "pack": struct.Struct(f"={len(results)}d").pack_into,
        "ImpossibleError": ImpossibleError,
        "inf": math.inf,
        "nan": math.nan,
    }
    exec(compile(lines.source(), "<plan>", "exec"), namespace)  # source of our own making only
    made: Straight = namespace["run"]
    return made


# no messages: source of a program
class _Lines:
    """Lines of the function while it is written."""

    def __init__(self, tape: Tape, results: Sequence[Ref], guards: Sequence[Guard]) -> None:
        self.tape, self.results = tape, results
        watched = [guard.margin for guard in guards]
        self.needed = used_by(tape, [*results, *watched])
        self.count = dict.fromkeys(self.needed, 0)
        for number in self.needed:
            if tape.nodes[number].kind != "input":
                for ref in tape.nodes[number].operands:
                    if type(ref) is int:
                        self.count[ref] += 1
        for ref in (*results, *watched):
            if type(ref) is int:
                self.count[ref] += 1
        self.watch: dict[int, float] = {}
        for guard in guards:
            if type(guard.margin) is int:
                limit = self.watch.get(guard.margin, guard.limit)
                self.watch[guard.margin] = max(limit, guard.limit)
        self.text: dict[int, str] = {}
        self.lines: list[str] = []
        self.angles: dict[Ref, str] = {}

    def source(self) -> str:
        """Return the source of a function ``run(inputs)``."""
        for number in self.needed:
            self._write(number)
        row = ", ".join(self._operand(ref) for ref in self.results)
        inputs = sorted(
            {
                int(node.operands[0])
                for number in self.needed
                if (node := self.tape.nodes[number]).kind == "input"
            }
        )
        inputs = inputs or [0]  # constants only: repeated for every position
        names = ", ".join(f"x{number}" for number in inputs)
        columns = ", ".join(f"inputs[{number}]" for number in inputs)
        each = f"for {names} in " + (columns if len(inputs) == 1 else f"zip({columns})")
        body = "".join(f"        {line}\n" for line in self.lines)
        return (
            f"def run(inputs, buffer):\n    at = 0\n    {each}:\n{body}"
            f"        pack(buffer, at, {row})\n        at += {8 * len(self.results)}\n"
        )

    def _operand(self, ref: Ref) -> str:
        if type(ref) is float:
            return repr(ref) if ref >= 0 else f"({ref!r})"
        return self.text[int(ref)]

    def _write(self, number: int) -> None:
        node = self.tape.nodes[number]
        text = self._expression(number)
        # Used once and short: the expression is inserted where it is used.
        once = self.count[number] <= 1 and number not in self.watch and node.kind in BINARY
        if once and len(text) < 120:
            self.text[number] = f"({text})"
            return
        if node.kind in ("input", "cosd", "sind"):
            self.text[number] = text
        else:
            self.text[number] = f"t{number}"
            self.lines.append(f"t{number} = {text}")
        if number in self.watch:
            limit = self.watch[number]
            self.lines.append(f"if not {self.text[number]} > {limit!r}: raise ImpossibleError")

    def _expression(self, number: int) -> str:
        kind, refs = self.tape.nodes[number]
        if kind == "input":
            return f"x{refs[0]}"
        said = [self._operand(ref) for ref in refs]
        if kind in BINARY:
            return f"{said[0]} {BINARY[kind]} {said[1]}"
        match kind:
            case "neg":
                return f"-{said[0]}"
            case "abs" | "sqrt" | "atan2":
                return f"{kind}({', '.join(said)})"
            case "max" | "min":
                sign = ">" if kind == "max" else "<"
                named = [self._named(ref) for ref in refs]
                return f"{named[0]} if {named[0]} {sign} {named[1]} else {named[1]}"
            case "degrees":
                angle = self._named(refs[0])
                whole = f"{angle} * {180.0 / math.pi!r}"
                return f"180.0 if {angle} <= {-math.pi!r} else {whole}"
            case "at_zero":
                return f"{said[1]} if {said[0]} == 0.0 else {said[2]}"
            case "above":
                return f"1.0 if {said[0]} > {said[1]} else 0.0"
            case "floor":
                return f"{said[0]} // 1.0"
            case _:  # cosd, sind
                c, s = self._write_angle(refs[0], said[0]).split()
                return c if kind == "cosd" else s

    def _named(self, ref: Ref) -> str:
        """Return an operand that is used twice: a variable name, not its expression."""
        phrase = self._operand(ref)
        if type(ref) is int and phrase.startswith("("):
            self.lines.append(f"t{ref} = {phrase}")
            phrase = self.text[ref] = f"t{ref}"
        return phrase

    def _write_angle(self, ref: Ref, degrees: str) -> str:
        """Write cosine and sine of an angle, exact at quadrants; return their names."""
        if ref not in self.angles:
            k = len(self.angles)
            self.lines += [
                f"r{k} = remainder({degrees}, 90.0)",
                f"q{k} = ({degrees} - r{k}) / 90.0 % 4.0",
                f"r{k} *= {math.pi / 180!r}",
                f"c{k} = cos(r{k}); s{k} = sin(r{k})",
                f"if q{k}: c{k}, s{k} = (-s{k}, c{k}) if q{k} == 1.0 else "
                f"(-c{k}, -s{k}) if q{k} == 2.0 else (s{k}, -c{k})",
            ]
            self.angles[ref] = f"c{k} s{k}"
        return self.angles[ref]


_TURN = """function turn(a) {
  const q = Math.round(a / 90), r = (a - 90 * q) * %r, c = Math.cos(r), s = Math.sin(r);
  return [[c, s], [-s, c], [-c, -s], [s, -c]][((q %% 4) + 4) %% 4] || [NaN, NaN];
}
""" % (math.pi / 180.0)  # exact at quadrants, as `unit_vectors` is


# no messages: source of a program
def javascript(
    tape: Tape,
    results: Sequence[Ref],
    guards: Sequence[Guard],
    depends: Sequence[frozenset[int]],
    inputs: int,
) -> str:
    """Print a tape as the source of a function.

    Parameters
    ----------
    results : sequence of Ref
    guards : sequence of Guard
        Margins to be watched.
    depends : sequence of frozenset of int
        Guards that each result depends on, by their place in ``guards``.
    inputs : int
        How many inputs the tape has.

    Returns
    -------
    str
        Of ``run(x0, x1, ...)``, which returns an array of the results and last the number of the
        first guard that does not hold, or -1; NaN for a result that depends on such a guard.
    """
    names = [f"x{number}" for number in range(inputs)]
    margins = [guard.margin for guard in guards]
    steps, told = _javascript_steps(tape, [*results, *margins], names)
    fails = [
        f"  if (!({margin} > {_number(guard.limit)})) bad.push({place});\n"
        for place, (guard, margin) in enumerate(zip(guards, told[len(results) :], strict=True))
    ]
    needs = [f"[{','.join(map(str, sorted(one)))}]" for one in depends]
    return (
        f"{_TURN}const NEEDS = [{','.join(needs)}];\n"
        f"function run({', '.join(names)}) {{\n"
        f"{steps}  const bad = [];\n{''.join(fails)}"
        f"  const out = [{', '.join(told[: len(results)])}];\n"
        "  if (bad.length) out.forEach((_, k) => {\n"
        "    if (NEEDS[k].some(g => bad.includes(g))) out[k] = NaN;\n  });\n"
        "  out.push(bad.length ? bad[0] : -1);\n  return out;\n}\n"
    )


# no messages: source of a program
def javascript_function(
    head: str, tape: Tape, results: Sequence[Ref], inputs: Sequence[str]
) -> str:
    """Print a tape without margins as the source of a function.

    Parameters
    ----------
    head : str
        Its name and arguments: ``loads(x, out)``.
    inputs : sequence of str
        What each input of the tape is there: ``x``, ``out[3]``.

    Returns
    -------
    str
        Of a function that returns an array of the results.
    """
    steps, told = _javascript_steps(tape, results, inputs)
    return f"function {head} {{\n{steps}  return [{', '.join(told)}];\n}}\n"


def _javascript_steps(
    tape: Tape, results: Sequence[Ref], inputs: Sequence[str]
) -> tuple[str, list[str]]:
    """Return the declarations that some results need, and what each result is called there."""
    said: dict[int, str] = {}
    lines: list[str] = []
    turned: dict[str, str] = {}

    def name(ref: Ref) -> str:
        return _number(ref) if type(ref) is float else said[int(ref)]

    for number in used_by(tape, results):
        kind, refs = tape.nodes[number]
        if kind == "input":
            said[number] = inputs[int(refs[0])]
            continue
        here = [name(ref) for ref in refs]
        if kind in ("cosd", "sind"):
            if here[0] not in turned:
                turned[here[0]] = f"r{len(turned)}"
                lines.append(f"{turned[here[0]]} = turn({here[0]})")
            said[number] = f"{turned[here[0]]}[{int(kind == 'sind')}]"
            continue
        said[number] = f"t{number}"
        lines.append(f"t{number} = {_expression(kind, here)}")
    steps = f"  const {', '.join(lines)};\n".replace(", t", ",\n    t") if lines else ""
    return steps, [name(ref) for ref in results]


def _number(value: float) -> str:
    if math.isnan(value):
        return "NaN"
    if math.isinf(value):
        return "Infinity" if value > 0 else "(-Infinity)"
    return repr(value) if value >= 0 else f"({value!r})"


def _expression(kind: str, refs: list[str]) -> str:
    if kind in BINARY:
        return f"{refs[0]} {BINARY[kind]} {refs[1]}"
    match kind:
        case "neg":
            return f"-{refs[0]}"
        case "degrees":
            angle = refs[0]
            whole = f"{angle} * {180.0 / math.pi!r}"
            return f"{angle} <= {_number(-math.pi)} ? 180.0 : {whole}"
        case "at_zero":
            return f"{refs[0]} === 0.0 ? {refs[1]} : {refs[2]}"
        case "above":
            return f"{refs[0]} > {refs[1]} ? 1.0 : 0.0"
        case _:  # abs, sqrt, min, max, atan2, floor
            return f"Math.{kind}({', '.join(refs)})"
