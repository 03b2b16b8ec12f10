"""Plans as students draw them in CAD programs, of any reading of a sheet (чертежи для проверок)."""

from __future__ import annotations

import math
import random
from cmath import exp
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import ezdxf
from doors import RATES, PlanKind, Sheet, Trace, normalize, plan_letters, single_point
from ezdxf.enums import TextEntityAlignment

ORIGINS = {PlanKind.VELOCITY: 100 + 150j, PlanKind.ACCELERATION: 300 + 150j}
HIGH = 3.5

UNITS = {"mm": (1.0, 4), "cm": (0.1, 5), "m": (1e-3, 6), "inches": (1 / 25.4, 1)}
"""Drawing units of a millimetre, and what ``$INSUNITS`` then states."""

LINES = ("line", "polyline", "chain", "old polyline", "spatial polyline", "back", "leader")
LETTERS = ("text", "middle", "paragraph", "stack", "small stack", "font", "back")


class Insert(NamedTuple):
    """A block reference: its content is scaled, perhaps mirrored, rotated and moved."""

    scale: float = 1.0
    mirrored: bool = False
    degrees: float = 0.0
    at: complex = 0j

    def inside(self, place: complex) -> complex:
        """A place of the drawing, in the block."""
        place = (place - self.at) * exp(-1j * math.radians(self.degrees)) / self.scale
        return -place.conjugate() if self.mirrored else place


class Style(NamedTuple):
    """How somebody draws (манера черчения).

    ``inserts`` are nested blocks, the outermost first. ``turn`` rotates the whole drawing,
    ``mirror`` reflects it.
    """

    lines: str = "line"
    letters: str = "middle"
    inserts: tuple[Insert, ...] = ()
    turn: complex = 1.0
    mirror: bool = False
    per_unit: float = 1.0
    units: int = 4
    barbs: bool = False

    @classmethod
    def random(cls, seed: int) -> Style:
        """Any manner that leaves right plans right."""
        rng = random.Random(seed)
        per_unit, units = rng.choice((*UNITS.values(), (0.1, 0), (1e-3, 0), (1.0, 6), (1.0, 0)))
        inserts = tuple(
            Insert(
                rng.choice((1.0, 0.5, 2.0, 10.0)),
                rng.random() < 0.5,
                rng.choice((0.0, 90.0, -37.0)),
                complex(rng.uniform(-50, 50), rng.uniform(-50, 50)) * per_unit,
            )
            for _ in range(rng.choice((0, 0, 1, 2, 3)))
        )
        return cls(
            rng.choice(LINES),
            rng.choice(LETTERS),
            inserts,
            exp(1j * math.radians(rng.choice((0.0, 0.0, 90.0, 180.0, rng.uniform(3, 357))))),
            rng.random() < 0.25,
            per_unit,
            units,
            rng.random() < 0.3,
        )


def draw(
    sheet: Sheet,
    path: Path,
    trace: Trace | None = None,
    style: Style = Style(),  # noqa: B008 - it is frozen
    *,
    layers: Mapping[PlanKind, str] | None = None,
    larger: Mapping[PlanKind, float] | None = None,
    without: tuple[str, ...] = (),
    moved: Mapping[str, complex] | None = None,
    scales: bool = True,
    note: str = "",
) -> Path:
    """Write the velocity and acceleration plans of a sheet as a DXF.

    Parameters
    ----------
    larger : mapping
        How much larger than to scale plans are drawn.
    without : tuple of str
        Letters that are not written.
    moved : mapping of str to complex
        How far points of plans are moved, mm, by the plan and the letter: ``velocity d``.
    note : str
        Another inscription.
    """
    hand = _Hand(style)
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
        vectors = sorted({pair for pair in pairs if all(end in value for end in pair)})
        size = (larger or {}).get(kind, 1.0)
        places = {
            end: origin
            + (single_point(value[end]) - pole) * size
            + sum(
                (moved or {}).get(f"{kind.value} {normalize(one)}", 0j)
                for one in letters.get(end, [])
            )
            for pair in vectors
            for end in pair
        }
        for tail, head in vectors:
            a, b = places[tail], places[head]
            if abs(b - a) > 1e-6:
                hand.line(a, b, layer)
        for place, text in _inscriptions(places, letters):
            hand.write(text, place)
        if scales:
            symbol = "mu_v" if kind is PlanKind.VELOCITY else "mu_a"
            hand.write(f"{symbol} = {sheet.scales[symbol]:.10g}", origin - 90j)
    if note:
        hand.write(note, 20 + 20j)
    hand.document.saveas(path)
    return path


def _inscriptions(
    places: Mapping[Any, complex], letters: Mapping[Any, list[str]]
) -> list[tuple[complex, str]]:
    """Letters outside of the figure, those of points that coincide as one text."""
    middle = sum(places.values()) / len(places)
    spots: list[tuple[complex, list[str]]] = []
    for name, place in sorted(places.items()):
        for other, found in spots:
            if abs(other - place) < 0.3:
                found += [one for one in letters.get(name, []) if one not in found]
                break
        else:
            spots.append((place, list(letters.get(name, []))))
    written = []
    for place, own in spots:
        away = place - middle
        if own:
            written.append((place + 3 * away / (abs(away) or 1.0), ", ".join(own)))
    return written


class _Hand:
    """A drawing, in the space where a style puts its entities."""

    def __init__(self, style: Style) -> None:
        library: Any = ezdxf  # its types are of the parts only
        self.document = library.new("R2010", units=style.units)
        self.space, self.style, self.high = self.document.modelspace(), style, HIGH * style.per_unit
        for number, one in enumerate(style.inserts):
            attributes = {
                "xscale": -one.scale if one.mirrored else one.scale,
                "yscale": one.scale, "zscale": one.scale, "rotation": one.degrees,
            }  # fmt: skip
            self.space.add_blockref(f"PLAN{number}", _pair(one.at), dxfattribs=attributes)
            self.space = self.document.blocks.new(f"PLAN{number}")
            self.high /= one.scale

    def at(self, place: complex) -> complex:
        """Where a place of the sheet is in the space."""
        place = (place.conjugate() if self.style.mirror else place) * self.style.turn
        place *= self.style.per_unit
        for one in self.style.inserts:
            place = one.inside(place)
        return place

    def line(self, start: complex, end: complex, layer: str) -> None:
        """Draw a vector."""
        a, b = self.at(start), self.at(end)
        at = {"layer": layer}
        corners = [_pair(a), _pair((a + b) / 2), _pair(b)]
        match self.style.lines:
            case "line":
                self.space.add_line(_pair(a), _pair(b), dxfattribs=at)
            case "polyline":
                self.space.add_lwpolyline([_pair(a), _pair(b)], dxfattribs=at)
            case "chain":
                self.space.add_lwpolyline(corners, dxfattribs=at)
            case "old polyline":
                self.space.add_polyline2d(corners, dxfattribs=at)
            case "spatial polyline":
                self.space.add_polyline3d([(x, y, 0) for x, y in corners], dxfattribs=at)
            case "back":  # drawn in a plane that is seen from behind
                at |= {"extrusion": (0, 0, -1)}  # type: ignore[dict-item]
                self.space.add_lwpolyline([(-x, y) for x, y in corners], dxfattribs=at)
            case "leader":
                self.space.add_leader([_pair(a), _pair(b)], dxfattribs=at)
        if self.style.barbs and abs(end - start) > 8:
            for side in (0.25j, -0.25j):
                back = end - (end - start) / abs(end - start) * (1 + side) * 3
                self.space.add_line(_pair(b), _pair(self.at(back)), dxfattribs=at)

    def write(self, text: str, place: complex) -> None:
        """Write an inscription round a place."""
        plain, (x, y) = text.replace("_{", "").replace("}", ""), _pair(self.at(place))
        space, manner = self.space, self.style.letters
        if manner == "text":  # from its lower left corner, as one is typed
            x, y = x - self.high * 0.3 * len(plain), y - self.high / 2
            space.add_text(plain, height=self.high).set_placement((x, y))
        elif manner == "middle":
            entity = space.add_text(plain, height=self.high)
            entity.set_placement((x, y), align=TextEntityAlignment.MIDDLE_CENTER)
        elif manner == "back":
            entity = space.add_text(plain, height=self.high, dxfattribs={"extrusion": (0, 0, -1)})
            entity.set_placement((-x, y), align=TextEntityAlignment.MIDDLE_CENTER)
        else:
            attributes = {"char_height": self.high, "insert": (x, y), "attachment_point": 5}
            space.add_mtext(_formatted(text, plain, manner), dxfattribs=attributes)


def _formatted(text: str, plain: str, manner: str) -> str:
    """An inscription as an editor of paragraphs writes it; indices are stacks."""
    if manner == "paragraph" or "=" in text:
        return plain
    if manner == "font":
        return rf"\pxqc;{{\fISOCPEUR|b0|i1|c204|p34;\H{HIGH:g};{plain}}}"
    head, tail = ("", ";") if manner == "stack" else ("{\\H0.7x;", ";}")
    caret = "^" if manner == "stack" else "^ "
    text = text.replace("_{", f"{head}\\S{caret}").replace("}", tail)
    return rf"{{\fISOCPEUR|b0|i1|c204|p0;\A1;{text}}}"


def _pair(place: complex) -> tuple[float, float]:
    return place.real, place.imag
