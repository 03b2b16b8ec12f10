"""What is said of a choice of teeth: text, record, problem file of a set (результат подбора)."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from planmethod.gears.choice import Chosen, TeethSet
from planmethod.gears.conditions import RING_LESS
from planmethod.note.numbers import MINUS
from planmethod.note.plaintext import fixed, found, given
from planmethod.note.wording import language
from planmethod.note.writers.plain import table, wrap


def chosen_text(chosen: Chosen, lang: str) -> str:
    """Tell what was asked, the bounds, how many combinations were tried, and the sets."""
    words = language(lang)
    say, wanted = words.teeth, chosen.wanted
    scheme = wanted.scheme
    carried = say.satellites.format(k=wanted.satellites) if scheme.carried else ""
    rows = "" if wanted.modules is None else _modules(chosen, lang)
    rings = say.rings.format(ring_most=wanted.ring_most) if scheme.rings else ""
    texts = [
        say.title.format(scheme=say.schemes[scheme.name]),
        say.wanted.format(
            ratio=given(float(wanted.ratio), words.note),
            within=given(100 * float(wanted.within), words.note),
            satellites=carried,
            modules=rows,
        ),
        say.bounds.format(
            least=wanted.least, most=wanted.most, rings=rings, looked=chosen.looked_at
        ),
        say.conditions.format(difference=RING_LESS, carried=say.carried if carried else ""),
    ]
    if not chosen.sets:
        texts.append(say.none)
    else:
        texts.append(say.found.format(found=chosen.found, shown=len(chosen.sets)))
    lines = [line for text in texts for line in wrap(text)]
    if not chosen.sets:
        return "\n".join(lines)
    number, *others = say.columns
    head = [number, *(f"z_{label}" for label in scheme.wheels), *others]
    cells = [
        [
            str(at),
            *map(str, one.teeth),
            found(float(one.ratio), words.note),
            str(one.ratio).replace("-", MINUS),
            fixed(100 * float(one.error), words.note).replace("-", MINUS),
            given(float(one.size), words.note),
        ]
        for at, one in enumerate(chosen.sets, 1)
    ]
    return "\n".join([*lines, *table(head, cells, left=0)])


def _modules(chosen: Chosen, lang: str) -> str:
    words, (one, other) = language(lang), chosen.wanted.modules or (Fraction(1), Fraction(1))
    first, second = (given(float(module), words.note) for module in (one, other))
    return words.teeth.modules.format(first=first, second=second)


def chosen_record(chosen: Chosen) -> dict[str, Any]:
    """Return what JSON says of a choice: what was asked, bounds, counts, the sets."""
    wanted = chosen.wanted
    return {
        "schema": 1,
        "scheme": wanted.scheme.name,
        "ratio": {"name": wanted.scheme.asked, "value": float(wanted.ratio)},
        "within": float(wanted.within),
        "satellites": wanted.satellites if wanted.scheme.carried else None,
        "modules_mm": None if wanted.modules is None else [float(m) for m in wanted.modules],
        "bounds": {
            "z_min": wanted.least,
            "z_max": wanted.most,
            "ring_max": wanted.ring_most if wanted.scheme.rings else None,
        },
        "looked_at": chosen.looked_at,
        "found": chosen.found,
        "sets": [
            {
                "teeth": dict(zip(wanted.scheme.wheels, one.teeth, strict=True)),
                "value": float(one.ratio),
                "exact": f"{one.ratio.numerator}/{one.ratio.denominator}",
                "error": float(one.error),
                "size": float(one.size),
            }
            for one in chosen.sets
        ],
    }


def problem_text(chosen: Chosen, number: int, lang: str) -> str:
    """Return the problem file of the set with this number, counted from 1.

    Rows of different modules are written as radii: a train has one module.
    """
    wanted, one = chosen.wanted, chosen.sets[number - 1]
    scheme, say = wanted.scheme, language(lang).teeth
    lines = [f'title = "{say.file.format(number=number)}"', ""]
    lines += [f"# {line}" for line in wrap(say.schemes[scheme.name])]
    teeth = ", ".join(f"z_{x} = {z}" for x, z in zip(scheme.wheels, one.teeth, strict=True))
    lines += [f"# {teeth}", "[gears]", f"wheels = {{ {_wheels(chosen, one)} }}", "meshes = ["]
    carried = ', carrier = "H"' if scheme.carried else ""
    rim = "2'" if "2'" in scheme.wheels else "2"
    for kind, of in zip(scheme.kinds, (("1", "2"), (rim, "3")), strict=False):
        lines.append(f'  {{ of = ["{of[0]}", "{of[1]}"], kind = "{kind.value}"{carried} }},')
    lines.append("]")
    if not scheme.carried and len(scheme.kinds) == 2:
        lines.append('coaxial = [["1", "3"]]')
    if scheme.carried:
        lines += ['fixed = ["3"]', f"satellites = {wanted.satellites}"]
    if wanted.modules is not None and len(set(wanted.modules)) == 1:
        lines.append(f"module = {float(wanted.modules[0]):g}")
    source = scheme.asked.split("_")[1]
    lines += [f"n = {{ {source} = 1 }}", f'ask = ["W", "{scheme.asked}"]', ""]
    return "\n".join(lines)


def _wheels(chosen: Chosen, one: TeethSet) -> str:
    modules = chosen.wanted.modules
    cells = []
    for label, z in zip(chosen.wanted.scheme.wheels, one.teeth, strict=True):
        told = str(z)
        if modules is not None and modules[0] != modules[1]:
            told = f"{{ r = {float(z * modules[label not in ('1', '2')] / 2000):.9g} }}"
        cells.append(f'"{label}" = {told}')
    return ", ".join(cells)
