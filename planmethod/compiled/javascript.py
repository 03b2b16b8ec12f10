"""A tape as one straight function of JavaScript: the same numbers in a browser, for any position.

Nothing of a problem file comes into the source: temporaries are ``t`` and a number, inputs ``x``
and a number, constants are floats written by ``repr``.
"""

# no messages: source of a program

from __future__ import annotations

import math
from collections.abc import Sequence

from planmethod.compiled.pysource import BINARY, used_by
from planmethod.compiled.symbolic import Guard
from planmethod.compiled.tape import Ref, Tape

_TURN = """function turn(a) {
  const q = Math.round(a / 90), r = (a - 90 * q) * %r, c = Math.cos(r), s = Math.sin(r);
  return [[c, s], [-s, c], [-c, -s], [s, -c]][((q %% 4) + 4) %% 4] || [NaN, NaN];
}
""" % (math.pi / 180.0)  # exact at quadrants, as `unit_vectors` is


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
    said: dict[int, str] = {}
    lines: list[str] = []
    turned: dict[str, str] = {}

    def name(ref: Ref) -> str:
        return _number(ref) if type(ref) is float else said[int(ref)]

    for number in used_by(tape, [*results, *(guard.margin for guard in guards)]):
        kind, refs = tape.nodes[number]
        if kind == "input":
            said[number] = f"x{refs[0]}"
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
    fails = [
        f"  if (!({name(guard.margin)} > {_number(guard.limit)})) bad.push({place});\n"
        for place, guard in enumerate(guards)
    ]
    needs = [f"[{','.join(map(str, sorted(one)))}]" for one in depends]
    steps = f"  const {', '.join(lines)};\n".replace(", t", ",\n    t") if lines else ""
    return (
        f"{_TURN}const NEEDS = [{','.join(needs)}];\n"
        f"function run({', '.join(f'x{k}' for k in range(inputs))}) {{\n"
        f"{steps}  const bad = [];\n{''.join(fails)}"
        f"  const out = [{', '.join(name(ref) for ref in results)}];\n"
        "  if (bad.length) out.forEach((_, k) => {\n"
        "    if (NEEDS[k].some(g => bad.includes(g))) out[k] = NaN;\n  });\n"
        "  out.push(bad.length ? bad[0] : -1);\n  return out;\n}\n"
    )


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
        case _:  # abs, sqrt, min, max, atan2
            return f"Math.{kind}({', '.join(refs)})"
