"""A choice of teeth: document, record, problem file of a set (результат подбора)."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from planmethod.gears.conditions import RING_LESS
from planmethod.gears.teeth import TeethSelection, TeethSet, TeethSpecification
from planmethod.note.compared import percent_text
from planmethod.note.document import Node, Paragraph, table_of
from planmethod.note.formula import escape
from planmethod.note.numbers import MINUS
from planmethod.note.wording import Language, get_language


def selection_document(selection: TeethSelection, language: Language) -> Iterator[Node]:
    """Yield the requirements, the bounds, the number of combinations tried, and the sets."""
    texts, wanted, number = language.teeth, selection.spec, language.notation.as_input
    scheme = wanted.scheme
    carried = texts.satellites.format(k=wanted.planets) if scheme.is_planetary else ""
    rings = texts.rings.format(ring_most=wanted.max_ring_teeth) if scheme.rings else ""
    modules = ""
    if wanted.modules is not None:
        first, second = (number(float(module)) for module in wanted.modules)
        modules = texts.modules.format(first=first, second=second)
    yield Paragraph(texts.title.format(scheme=escape(texts["schemes"][scheme.name])))
    yield Paragraph(
        texts.wanted.format(
            ratio=number(float(wanted.ratio)),
            within=number(100 * float(wanted.tolerance)),
            satellites=carried,
            modules=modules,
        )
    )
    yield Paragraph(
        texts.bounds.format(
            least=wanted.min_teeth, most=wanted.max_teeth, rings=rings, looked=selection.tried_count
        )
    )
    text = texts.conditions.format(difference=RING_LESS, carried=texts.carried if carried else "")
    yield Paragraph(escape(text))
    if not selection.sets:
        yield Paragraph(texts.none)
        return
    yield Paragraph(texts.found.format(found=selection.match_count, shown=len(selection.sets)))
    first, *others = texts["columns"]
    yield table_of(
        [first, *(escape(f"z_{label}") for label in scheme.wheels), *others],
        [
            [
                str(at),
                *map(str, one.teeth),
                language.notation.computed(float(one.ratio)),
                str(one.ratio).replace("-", MINUS),
                language.notation.number(percent_text(100 * float(one.error), 2)),
                number(float(one.size)),
            ]
            for at, one in enumerate(selection.sets, 1)
        ],
        names=0,
    )


def selection_record(selection: TeethSelection) -> dict[str, Any]:
    """Return the JSON record of a selection: requirements, bounds, counts, sets."""
    wanted = selection.spec
    return {
        "schema": 1,
        "scheme": wanted.scheme.name,
        "ratio": {"name": wanted.scheme.ratio_name, "value": float(wanted.ratio)},
        "within": float(wanted.tolerance),
        "satellites": wanted.planets if wanted.scheme.is_planetary else None,
        "modules_mm": None if wanted.modules is None else [float(m) for m in wanted.modules],
        "bounds": {
            "z_min": wanted.min_teeth,
            "z_max": wanted.max_teeth,
            "ring_max": wanted.max_ring_teeth if wanted.scheme.rings else None,
        },
        "looked_at": selection.tried_count,
        "found": selection.match_count,
        "sets": [
            {
                "teeth": dict(zip(wanted.scheme.wheels, one.teeth, strict=True)),
                "value": float(one.ratio),
                "exact": f"{one.ratio.numerator}/{one.ratio.denominator}",
                "error": float(one.error),
                "size": float(one.size),
            }
            for one in selection.sets
        ],
    }


def problem_text(selection: TeethSelection, number: int, lang: str) -> str:
    """Return the problem file of the set with this number, counted from 1.

    Rows of different modules are written as radii: a train has one module.
    """
    wanted, one = selection.spec, selection.sets[number - 1]
    scheme, texts = wanted.scheme, get_language(lang).teeth
    lines = [f'title = "{texts.file.format(number=number)}"', ""]
    lines.append(f"# {texts['schemes'][scheme.name]}")
    teeth = ", ".join(f"z_{x} = {z}" for x, z in zip(scheme.wheels, one.teeth, strict=True))
    lines += [f"# {teeth}", "[gears]", f"wheels = {{ {_wheels(selection, one)} }}", "meshes = ["]
    carried = ', carrier = "H"' if scheme.is_planetary else ""
    rim = "2'" if "2'" in scheme.wheels else "2"
    for kind, of in zip(scheme.kinds, (("1", "2"), (rim, "3")), strict=False):
        lines.append(f'  {{ of = ["{of[0]}", "{of[1]}"], kind = "{kind.value}"{carried} }},')
    lines.append("]")
    if not scheme.is_planetary and len(scheme.kinds) == 2:
        lines.append('coaxial = [["1", "3"]]')
    if scheme.is_planetary:
        lines += ['fixed = ["3"]', f"satellites = {wanted.planets}"]
    if wanted.modules is not None and len(set(wanted.modules)) == 1:
        lines.append(f"module = {float(wanted.modules[0]):g}")
    source = scheme.ratio_name.split("_")[1]
    lines += [
        f"n = {{ {source} = 1 }}",
        f'ask = ["W", "{scheme.ratio_name}"]',
        *_design_table(wanted),
        "",
    ]
    return "\n".join(lines)


def _design_table(spec: TeethSpecification) -> list[str]:
    """Return the requirements from which the sheet compares variants; none if it cannot."""
    if not spec.scheme.is_planetary or len(set(spec.rows)) != 1:
        return []
    k = spec.planets
    bounds = f"z_min = {spec.min_teeth}, z_max = {spec.max_teeth}, ring_max = {spec.max_ring_teeth}"
    shown = f"k_min = {max(1, k - 1)}, k_max = {min(24, k + 2)}"
    asked = f"U = {float(spec.ratio)!r}, within = {min(float(spec.tolerance), 0.5)!r}"
    return [f"design = {{ {asked}, {bounds}, {shown} }}"]


def _wheels(selection: TeethSelection, one: TeethSet) -> str:
    modules = selection.spec.modules
    cells = []
    for label, z in zip(selection.spec.scheme.wheels, one.teeth, strict=True):
        text = str(z)
        if modules is not None and modules[0] != modules[1]:
            text = f"{{ r = {float(z * modules[label not in ('1', '2')] / 2000):.9g} }}"
        cells.append(f'"{label}" = {text}')
    return ", ".join(cells)
