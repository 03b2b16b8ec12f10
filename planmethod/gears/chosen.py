"""A choice of teeth: document, record, problem file of a set (результат подбора)."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from planmethod.gears.conditions import RING_LESS
from planmethod.gears.teeth import Chosen, TeethSet, Wanted
from planmethod.note.document import Node, Paragraph, table_of
from planmethod.note.formula import escape
from planmethod.note.numbers import MINUS
from planmethod.note.wording import Language, language


def chosen_document(chosen: Chosen, words: Language) -> Iterator[Node]:
    """Yield the requirements, the bounds, the number of combinations tried, and the sets."""
    say, wanted, number = words.teeth, chosen.wanted, words.say.given
    scheme = wanted.scheme
    carried = say.satellites.format(k=wanted.satellites) if scheme.carried else ""
    rings = say.rings.format(ring_most=wanted.ring_most) if scheme.rings else ""
    modules = ""
    if wanted.modules is not None:
        first, second = (number(float(module)) for module in wanted.modules)
        modules = say.modules.format(first=first, second=second)
    yield Paragraph(say.title.format(scheme=escape(say["schemes"][scheme.name])))
    yield Paragraph(
        say.wanted.format(
            ratio=number(float(wanted.ratio)),
            within=number(100 * float(wanted.within)),
            satellites=carried,
            modules=modules,
        )
    )
    yield Paragraph(
        say.bounds.format(
            least=wanted.least, most=wanted.most, rings=rings, looked=chosen.looked_at
        )
    )
    told = say.conditions.format(difference=RING_LESS, carried=say.carried if carried else "")
    yield Paragraph(escape(told))
    if not chosen.sets:
        yield Paragraph(say.none)
        return
    yield Paragraph(say.found.format(found=chosen.found, shown=len(chosen.sets)))
    first, *others = say["columns"]
    yield table_of(
        [first, *(escape(f"z_{label}") for label in scheme.wheels), *others],
        [
            [
                str(at),
                *map(str, one.teeth),
                words.say.found(float(one.ratio)),
                str(one.ratio).replace("-", MINUS),
                words.say.number(f"{100 * float(one.error) + 0.0:.2f}"),
                number(float(one.size)),
            ]
            for at, one in enumerate(chosen.sets, 1)
        ],
        names=0,
    )


def chosen_record(chosen: Chosen) -> dict[str, Any]:
    """Return the JSON record of a selection: requirements, bounds, counts, sets."""
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
    lines.append(f"# {say['schemes'][scheme.name]}")
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
    lines += [f"n = {{ {source} = 1 }}", f'ask = ["W", "{scheme.asked}"]', *_design(wanted), ""]
    return "\n".join(lines)


def _design(wanted: Wanted) -> list[str]:
    """Return the requirements from which the sheet compares variants; none if it cannot."""
    if not wanted.scheme.carried or len(set(wanted.rows)) != 1:
        return []
    k = wanted.satellites
    bounds = f"z_min = {wanted.least}, z_max = {wanted.most}, ring_max = {wanted.ring_most}"
    shown = f"k_min = {max(1, k - 1)}, k_max = {min(24, k + 2)}"
    asked = f"U = {float(wanted.ratio)!r}, within = {min(float(wanted.within), 0.5)!r}"
    return [f"design = {{ {asked}, {bounds}, {shown} }}"]


def _wheels(chosen: Chosen, one: TeethSet) -> str:
    modules = chosen.wanted.modules
    cells = []
    for label, z in zip(chosen.wanted.scheme.wheels, one.teeth, strict=True):
        told = str(z)
        if modules is not None and modules[0] != modules[1]:
            told = f"{{ r = {float(z * modules[label not in ('1', '2')] / 2000):.9g} }}"
        cells.append(f'"{label}" = {told}')
    return ", ".join(cells)
