"""Plans as students draw them in CAD programs, of any reading of a sheet (чертежи для проверок)."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import ezdxf
from doors import RATES, PlanKind, Sheet, Trace, normalize, plan_letters, single_point
from ezdxf.enums import TextEntityAlignment

ORIGINS = {PlanKind.VELOCITY: 100 + 150j, PlanKind.ACCELERATION: 300 + 150j}


def draw(
    sheet: Sheet,
    path: Path,
    trace: Trace | None = None,
    *,
    layers: Mapping[PlanKind, str] | None = None,
    turn: complex = 1.0,
    per_unit: float = 1.0,
    units: int = 4,
    polylines: bool = False,
    barbs: bool = False,
    in_block: bool = False,
    several: bool = False,
    without: tuple[str, ...] = (),
    moved: Mapping[str, complex] | None = None,
    scales: bool = True,
) -> Path:
    """Write the velocity and acceleration plans of a sheet as a DXF.

    Parameters
    ----------
    per_unit : float
        Drawing units of a millimetre; ``units`` is the unit stated in the file.
    without : tuple of str
        Letters that are not written.
    moved : mapping of str to complex
        How far the ends of vectors are moved, by the vector: ``p-d``.
    """
    library: Any = ezdxf  # its types are of the parts only
    document = library.new("R2010", units=units)
    space: Any = document.modelspace()
    if in_block:
        space.add_blockref("PLAN", (10 * per_unit, 0), dxfattribs={"rotation": 0.0})
        space = document.blocks.new("PLAN")
    value = (trace or sheet.exact_trace).value
    problem = sheet.questions.solution.problem
    for kind in RATES:
        layer = (layers or {PlanKind.VELOCITY: "velocity"}).get(kind, kind.value)
        plan, origin = sheet.questions.construction.plan(kind), ORIGINS[kind]
        assert plan.pole is not None
        pole = single_point(value[plan.pole])
        letters = {
            name: [one for one in own if normalize(one) not in without]
            for name, own in plan_letters(problem, plan).items()
        }
        pairs = [(vector.tail, vector.head) for vector in plan.vectors]
        pairs += [(plan.pole, name) for name in letters if name != plan.pole]
        vectors = {pair for pair in pairs if all(end in value for end in pair)}
        ends = sorted({end for pair in vectors for end in pair})

        def at(name: str, pole: complex = pole, origin: complex = origin) -> complex:
            return (origin + (single_point(value[name]) - pole) * turn) * per_unit  # type: ignore[index]

        for tail, head in sorted(vectors):
            said = f"{normalize(letters[tail][0])}-{normalize(letters[head][0])}" if (
                letters.get(tail) and letters.get(head)) else ""  # fmt: skip
            a, b = at(tail), at(head) + (moved or {}).get(said, 0j) * per_unit
            if abs(b - a) < 1e-6:
                continue
            attributes = {"layer": layer}
            if polylines:
                space.add_lwpolyline(
                    [_pair(a), _pair((a + b) / 2), _pair(b)], dxfattribs=attributes
                )
            else:
                space.add_line(_pair(a), _pair(b), dxfattribs=attributes)
            if barbs and abs(b - a) > 8 * per_unit:
                for side in (0.25j, -0.25j):
                    back = b - (b - a) / abs(b - a) * (1 + side) * 3 * per_unit
                    space.add_line(_pair(b), _pair(back), dxfattribs=attributes)
        _letter(space, {end: at(end) for end in ends}, letters, per_unit, several=several)
        if scales:
            symbol = "mu_v" if kind is PlanKind.VELOCITY else "mu_a"
            scale, place = sheet.scales[symbol], (origin - 90j) * per_unit
            text = f"{symbol} = {scale:.10g}"
            space.add_text(text, height=3.5 * per_unit).set_placement(_pair(place))
    document.saveas(path)
    return path


def _pair(place: complex) -> tuple[float, float]:
    return place.real, place.imag


def _letter(
    space: Any,
    at: Mapping[str, complex],
    letters: Mapping[Any, list[str]],
    per_unit: float,
    *,
    several: bool,
) -> None:
    """Write the letters outside of the figure, those of points that coincide as one text."""
    middle = sum(at.values()) / len(at)
    spots: list[tuple[complex, list[str]]] = []
    for name, place in at.items():
        own = [one.replace("_{", "").replace("}", "") for one in letters.get(name, [])]
        for other, found in spots:
            if abs(other - place) < 0.3 * per_unit:
                found += [one for one in own if one not in found]
                break
        else:
            spots.append((place, own))
    for place, own in spots:
        away = place - middle
        corner = place + (away / abs(away) if abs(away) > 1e-9 else 1.0) * 3 * per_unit
        if own and several:
            space.add_mtext(
                ", ".join(own),
                dxfattribs={
                    "char_height": 3.5 * per_unit,
                    "insert": _pair(corner),
                    "attachment_point": 5,
                    "layer": "letters",
                },
            )
        elif own:
            text = space.add_text(", ".join(own), height=3.5 * per_unit)
            text.set_placement(_pair(corner), align=TextEntityAlignment.MIDDLE_CENTER)
