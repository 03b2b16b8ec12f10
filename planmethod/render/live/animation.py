"""A mechanism as it moves, for slides: scheme and velocity plan in frames (анимация)."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from html import escape
from io import BytesIO

import numpy as np
import numpy.typing as npt
from msgspec import Struct, field
from msgspec.structs import replace
from PIL import Image

from planmethod.construct.scale import Scale, choose_scale
from planmethod.errors import AssemblyError
from planmethod.languages import translate
from planmethod.mechanism.model import FRAME
from planmethod.note.narrate.naming import scale_inscription
from planmethod.note.wording import get_language
from planmethod.plans.draft import cis
from planmethod.plans.model import PlanKind
from planmethod.problem.model import Problem
from planmethod.problem.quantities import QuantityKind
from planmethod.render.backends import render
from planmethod.render.backends.canvas import Options
from planmethod.render.backends.svg import SvgCanvas
from planmethod.render.ink.drawing import Drawing, Fill, Item, Pen, Stroke, placed
from planmethod.render.ink.pens import PenSet
from planmethod.render.ink.typeset import typeset
from planmethod.render.live.scene import LETTER, RUNS_OUT, LiveScene, LiveView, Ref
from planmethod.render.pictures.collinear import shifts_apart
from planmethod.render.symbols import vector_arrow
from planmethod.solved.extents import typical

Complexes = npt.NDArray[np.complex128]
Reals = npt.NDArray[np.float64]
_Ends = tuple[Complexes, Complexes]
_Box = tuple[Complexes, complex]
"""Middle in every frame, mm, and half of width and height of an occupied box."""

_FINER = 4  # times as many places of the lines that points move along
_LARGEST_PLAN = (160.0, 120.0)  # mm: the largest plan of all frames
_MARGIN = 15.0  # mm around a view for its symbols and letters
_GAP = 1.2  # mm between an inscription and its point; of the scheme's joints twice that
_CAPTION = 18.0  # mm of paper over a view: its name, and its scale on the paper of the SVG
_BOTTOM_STRIP = 9.0  # mm of paper under a view: the driver's position
_NEAR = 1e-9
_SMALL = 0.8 * LETTER  # mm: titles, and the letters of plans
_LABEL_DISTANCES = (1.0, 4.0, 8.0, 12.0)
_LABEL_OFFSETS = np.array(
    [far * np.exp(1j * np.pi / 8 * k) for far in _LABEL_DISTANCES for k in range(16)]
)
"""Offsets of inscriptions from their points in all directions, mm: 1 is the gap alone."""

_MOVE_COST = 3.0  # cost of a move by a unit of these
_COVERS = 8.0  # cost of covering another inscription at all
_LETTER_SPACE = 0.8  # mm between two inscriptions
_ROUNDS = 3
_GLIDE = 0.02  # half of the part of a cycle in which an inscription moves to another place


class DrawnBody(Struct, frozen=True):
    """Items in their own axes, and the places, mm, and angles, degrees, of these in every frame."""

    items: tuple[Item, ...]
    places: Complexes
    turns: Reals


class AnimatedSegment(Struct, frozen=True):
    """Segment between two points, mm in every frame, with an arrowhead at its head or without.

    Only its part between the lower left and the upper right corner of ``bounds`` is drawn.
    """

    tails: Complexes
    heads: Complexes
    pen: Pen
    arrow: bool
    bounds: tuple[complex, complex]

    def drawn(self, k: int) -> list[Item]:
        """Return it in a frame."""
        tail, head = complex(self.tails[k]), complex(self.heads[k])
        part = _clip(tail, head, self.bounds)
        if part is None:
            return []
        if self.arrow and part[1] == head:
            return vector_arrow(part[0], head, pen=self.pen)
        return [Stroke(part, self.pen)]


# no messages: SVG
class Animation(Struct):
    """Frames of a moving mechanism (кадры); all is mm, y up, from the lower left corner.

    Attributes
    ----------
    positions : ndarray of shape (n,)
        Driver positions of the frames.
    total : int
        Number of tried positions; ``closed``: all of them exist, and the first follows the last.
    static_items : list of Item
    segments, drawn_bodies : list
        Moving items, the lowest layer first.
    readings : list of list of Item
        The inscription of the driver's position in every frame.
    """

    title: str
    positions: Reals
    total: int
    closed: bool
    pens: PenSet = PenSet()
    width: float = 0.0
    height: float = 0.0
    static_items: list[Item] = field(default_factory=list)
    segments: list[AnimatedSegment] = field(default_factory=list)
    drawn_bodies: list[DrawnBody] = field(default_factory=list)
    readings: list[list[Item]] = field(default_factory=list)

    @property
    def skipped(self) -> str:
        """Note on the range if some of the tried positions do not exist; otherwise empty."""
        there = len(np.unique(self.positions))
        if there == self.total:
            return ""
        low, high = float(self.positions.min()), float(self.positions.max())
        turns = 360.0 * round((low + high) / 720.0)
        low, high = low - turns, high - turns
        text = (
            "{} of {} positions do not exist and are skipped; the driver moves to and fro "
            "from {:.6g} to {:.6g}."
        )
        return translate(text, self.total - there, self.total, low, high)

    def frames(self) -> Iterator[Drawing]:
        """Yield the frames as drawings."""
        for k in range(len(self.positions)):
            items = [*self.static_items, *(one for each in self.segments for one in each.drawn(k))]
            for body in self.drawn_bodies:
                items += placed(body.items, complex(body.places[k]), float(body.turns[k]))
            items += self.readings[k]
            yield Drawing(self.width, self.height, self.title, items, pens=self.pens)

    # SVG -----------------------------------------------------------------------------------------

    def svg(self, seconds: float) -> bytes:
        """Return an SVG that plays by itself and repeats after ``seconds``."""
        canvas = SvgCanvas(Options())
        canvas.open(Drawing(0.0, 0.0, pens=self.pens))
        times = f'dur="{seconds:g}s" repeatCount="indefinite"'
        ring = [*range(len(self.positions)), *([0] if self.closed else [])]

        def moving(name: str, values: list[str], more: str = "") -> str:
            text = ";".join(values[k] for k in ring)
            if len(set(values)) == 1:
                return ""
            return f'<animate attributeName="{name}" values="{text}" {times}{more}/>'

        def turning(kind: str, values: list[str]) -> str:
            text = ";".join(values)
            return (
                f'<g transform="{kind}({values[0]})"><animateTransform attributeName="transform" '
                f'type="{kind}" values="{text}" {times}/>'
            )

        parts = [canvas.parts(self.static_items)]
        for segment in self.segments:
            pieces: dict[str, list[str]] = {"line": [], "head": []}
            for k in range(len(self.positions)):
                drawn = segment.drawn(k)
                tail = complex(segment.tails[k])
                line = next((i.points for i in drawn if isinstance(i, Stroke)), (tail, tail))
                head = next((i.points for i in drawn if isinstance(i, Fill)), (tail,) * 4)
                pieces["line"].append(_path(line))
                pieces["head"].append(_path(head) + "Z")
            items: list[Item] = [Stroke((0j, 1 + 0j), segment.pen)]
            if segment.arrow:
                items.append(Fill((0j, 1 + 0j, 1j), pen=segment.pen))
            drawn_parts = canvas.parts(items)
            for name in ("line", "head")[: len(items)]:  # the canvas has pens, here are places
                start = drawn_parts.index("<path d=")
                end = drawn_parts.index("/>", start)
                path = f'<path d="{pieces[name][0]}">{moving("d", pieces[name])}</path>'
                parts.append(drawn_parts[:start] + path)
                drawn_parts = drawn_parts[end + 2 :]
            parts.append(drawn_parts)
        for body in self.drawn_bodies:
            # A rotation keeps its full angle, not the shorter one between two frames.
            turns = np.degrees(np.unwrap(np.radians(body.turns[ring])))
            there = turning("translate", [f"{p.real:.3f} {-p.imag:.3f}" for p in body.places[ring]])
            turned = turning("rotate", [f"{-turn:.3f}" for turn in turns]) if turns.any() else ""
            parts.append(f"{there}{turned}{canvas.parts(body.items)}</g>{'</g>' * bool(turned)}")
        count = len(self.positions)
        for k, items_ in enumerate(self.readings):
            shown = ["hidden"] * count
            shown[k] = "visible"
            text = f'<animate attributeName="visibility" calcMode="discrete" {times} '
            keys = [(k / count, "visible"), ((k + 1) / count, "hidden")]
            keys = [(0.0, "hidden"), *keys] if k else keys
            keys = [key for key in keys if key[0] < 1.0]
            text += f'values="{";".join(v for _, v in keys)}" '
            text += f'keyTimes="{";".join(f"{t:.6g}" for t, _ in keys)}"/>'
            parts.append(f'<g visibility="{shown[0]}">{text}{canvas.parts(items_)}</g>')
        size = f"{self.width:.3f} {self.height:.3f}"
        return (
            '<?xml version="1.0" encoding="UTF-8"?>\n'
            '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" '
            f'viewBox="0 {-self.height:.3f} {size}" width="{self.width:.3f}mm" '
            f'height="{self.height:.3f}mm"><title>{escape(self.title)}</title>'
            f"<defs>{canvas.letters()}</defs>"
            f'<rect y="{-self.height:.3f}" width="{self.width:.3f}" height="{self.height:.3f}" '
            f'fill="#ffffff"/>{"".join(parts)}</svg>\n'
        ).encode()


def _clip(
    tail: complex, head: complex, bounds: tuple[complex, complex]
) -> tuple[complex, complex] | None:
    """Return the part of a segment in a rectangle, or None (Liang and Barsky)."""
    way, low, high = head - tail, bounds[0] - tail, bounds[1] - tail
    first, last = 0.0, 1.0
    for step, start, end in ((way.real, low.real, high.real), (way.imag, low.imag, high.imag)):
        if step:
            enter, leave = sorted((start / step, end / step))
            first, last = max(first, enter), min(last, leave)
        elif start > 0 or end < 0:
            return None
    if first > last:
        return None
    return tail + first * way, head if last == 1.0 else tail + last * way


def _path(points: tuple[complex, ...]) -> str:
    return "M" + "L".join(f"{p.real:.2f} {-p.imag:.2f}" for p in points)


def make_animation(problem: Problem, lang: str, *, frames: int, plans: bool) -> Animation:
    """Return the film of a mechanism: a turn of its crank, or its driver's travel to and fro.

    Positions that do not exist are left out: a crank that does not turn fully goes to and fro
    through the range of its first position.

    Parameters
    ----------
    frames : int
        Positions of a turn, or of the travel one way.
    plans : bool
        The velocity plan beside the scheme.

    Raises
    ------
    StructureError, ProblemError, AssemblyError, SelfCheckError
    """
    language = get_language(lang)
    scene = LiveScene(replace(problem, dynamics=None, machine=None), language, is_round=True)
    shown = ("scheme", *([PlanKind.VELOCITY.value] if plans else []))
    return _AnimationBuilder(
        scene, [view for view in scene.views if view.id in shown], frames
    ).build()


class _AnimationBuilder:
    """Builder of a film: its frames, and the items and their places in them."""

    def __init__(self, scene: LiveScene, views: list[LiveView], frames: int) -> None:
        self.scene, self.views, self.frames = scene, views, frames
        self.drive = scene.problem.drive
        self.origin = scene.construction.draft.origin
        self.positions, self.closed = self._exist()
        self.values = scene.sweep.run(self.positions)

    def _tried(self) -> Reals:
        """Return positions of a turn, of turns until the motion repeats, or of the travel."""
        if not self.drive.goes_round:
            return np.linspace(*self.scene.driver_range, self.frames)
        sense = -1.0 if self.drive.rate < 0 else 1.0
        return self.scene.start + sense * self.scene.period * np.arange(self.frames) / self.frames

    def _exist(self) -> tuple[Reals, bool]:
        tried = self._tried()
        values = self.scene.sweep.run(tried)
        rows = self.scene.rows_of(lambda kind: kind is QuantityKind.PLACE)
        for view in self.views[1:]:
            rows = rows + [ref[0] + k for ref in _refs(view) for k in (0, 1)]
        there = np.asarray(np.isfinite(values[rows]).all(axis=0))
        if there.all() and self.drive.goes_round:
            return tried, True
        if not there.all() and self.drive.goes_round:  # a range that begins after a gap
            tried = np.concatenate([tried, tried + (tried[1] - tried[0]) * len(tried)])
            there = np.tile(there, 2)
        cuts = np.flatnonzero(np.diff(there.astype(int))) + 1
        runs = [r for r in np.split(np.arange(len(tried)), cuts) if there[r[0]]]
        if not runs:
            raise AssemblyError(
                "None of {} positions of the driver exists, so no animation is possible. "
                "Give more --frames, or change the lengths.",
                self.frames,
            )
        # In the doubled turn, the first position is again in the middle.
        longest = max(runs, key=lambda r: (self.frames in r, len(r)))
        way = tried[longest]
        return np.concatenate([way, way[-2:0:-1]]), len(way) > 2

    def build(self) -> Animation:
        scene, problem = self.scene, self.scene.problem
        pens = PenSet(is_coloured=bool(problem.sheet.colour))
        name = problem.title or problem.name
        made = Animation(name, self.positions, self.frames, self.closed, pens)
        for view in self.views:
            self._fit_view(view)
        left = 0.0
        made.height = max(view.box[3] for view in self.views) + _CAPTION + _BOTTOM_STRIP
        for view in self.views:
            corner = complex(left - view.box[0], view.box[1] + view.box[3])
            corner += 1j * (made.height - _CAPTION + _BOTTOM_STRIP - view.box[3]) / 2
            text = typeset(view.title, _SMALL)
            at = complex(left + (view.box[2] - text.width) / 2, made.height - 0.5 * _CAPTION)
            made.static_items += text.at(at)
            mu = Scale(view.scale.symbol, view.per_mm, view.scale.unit)
            convention = problem.scales.convention
            told = typeset(scale_inscription(mu, convention, scene.language.notation), 0.6 * LETTER)
            middle = left + (view.box[2] - told.width) / 2
            made.static_items += told.at(complex(middle, made.height - 0.9 * _CAPTION))
            self._view(made, view, corner)
            left += view.box[2]
        made.width = left
        unit, symbol = (
            scene.language.notation.units[self.drive.coordinate.unit],
            self.drive.coordinate.symbol,
        )
        space = "" if self.drive.goes_round else " "
        for position in self.positions:
            turn = position % 360.0 if self.drive.goes_round else position
            digits = f"{turn:.1f}" if self.drive.goes_round else f"{turn:.4f}"
            text = typeset(
                f"{symbol} = {scene.language.notation.number(digits)}{space}{unit}", LETTER
            )
            made.readings.append(list(text.at(complex(4.0, 4.0))))
        return made

    def _fit_view(self, view: LiveView) -> None:
        """Give a view the bounds that it takes over the whole motion, and a plan its scale.

        Plans much larger than the typical one, next to a dead position, run out of it.
        """
        refs = _refs(view) or [label["at"] for label in view.labels]
        places = np.array([self._places(view, ref) for ref in refs])
        if view.id != "scheme":
            sizes = np.maximum(np.ptp(places.real, axis=0), np.ptp(places.imag, axis=0))
            places = places[:, sizes <= RUNS_OUT * typical(sizes)] if sizes.any() else places
            extent = float(np.ptp(places.real)), float(np.ptp(places.imag))
            view.per_mm = choose_scale(extent, _LARGEST_PLAN)
        places = places / view.per_mm
        low = complex(places.real.min(), places.imag.min()) - complex(_MARGIN, _MARGIN)
        high = complex(places.real.max(), places.imag.max()) + complex(_MARGIN, _MARGIN)
        wide = max(high.real - low.real, typeset(view.title, _SMALL).width + _MARGIN)
        left = (low.real + high.real - wide) / 2
        view.box = left, -high.imag, wide, high.imag - low.imag

    def _places(self, view: LiveView, ref: Ref, values: Reals | None = None) -> Complexes:
        """Return the places of a point from the origin of its view, in units of its scale."""
        values = self.values if values is None else values
        place = values[ref[0]] + 1j * values[ref[0] + 1]
        place = 1j * place if ref[1:] else place - (self.origin if view.id == "scheme" else 0)
        return np.asarray(place, dtype=complex)

    def _separate_vectors(self, view: LiveView, ends: list[_Ends]) -> list[_Ends]:
        """Return the segments of a plan with vectors on one line beside one another."""
        arrows = [k for k, one in enumerate(view.segments) if one.get("arrow")]
        sizes = [float(np.median(np.abs(head - tail))) for tail, head in ends]
        # In all frames it is the same one that keeps its place, as on sheets.
        arrows.sort(key=lambda k: (-sizes[k], view.segments[k]["style"] == Pen.COMPONENT))
        shifts = np.zeros((len(ends), len(self.positions)), complex)
        for frame in range(len(self.positions)):
            lines = [(complex(ends[k][0][frame]), complex(ends[k][1][frame])) for k in arrows]
            shifts[arrows, frame] = shifts_apart(lines, always=True, turning=True)
        # They move apart, and together again, within the frames before and after.
        wider = shifts.copy()
        for step in (-1, 1):
            wider = np.where(wider == 0, np.roll(shifts, step, axis=1), wider)
        around = [np.roll(wider, step, axis=1) for step in (-1, 0, 1)]
        even = np.mean(around, axis=0)
        return [(a + by, b + by) for (a, b), by in zip(ends, even, strict=True)]

    def _view(self, animation: Animation, view: LiveView, corner: complex) -> None:
        scene = self.scene

        def at(ref: Ref, values: Reals | None = None) -> Complexes:
            return self._places(view, ref, values) / view.per_mm + corner

        low = corner + complex(view.box[0], -view.box[1] - view.box[3])
        bounds = low, low + complex(view.box[2], view.box[3])
        lines = [(at(one["a"]), at(one["b"])) for one in view.segments]
        if view.id == "scheme":
            animation.static_items += self._traces(view, at)
            for part in scene.parts:
                if part.link == FRAME:
                    animation.static_items += placed(part.items, corner, 0.0)
                    continue
                start, turn = scene.axes(part)
                own = tuple(placed(part.items, -start * cis(-turn), -turn))
                turns = self.values[scene.row(f"{part.link}.phi_deg")]
                animation.drawn_bodies.append(
                    DrawnBody(own, at(scene.place(scene.anchor_point(part.link))), turns)
                )
        else:
            lines = self._separate_vectors(view, lines)
            for one, ends in zip(view.segments, lines, strict=True):
                arrow = bool(one.get("arrow"))
                pen = Pen(one["style"]) if arrow else Pen.THIN
                animation.segments.append(AnimatedSegment(*ends, pen, arrow, bounds))
        animation.drawn_bodies += self._labels(view, at, corner, lines, bounds)

    def _traces(self, view: LiveView, at: Callable[..., Complexes]) -> Iterator[Item]:
        """Yield the lines that the points move along."""
        count = len(self.positions)
        ends = [*range(count), *([0] if self.closed else [])]
        way = self.positions[ends].astype(float)
        if self.drive.goes_round and self.closed and count == self.frames:
            way[-1] = way[-2] + (way[1] - way[0])
        knots = np.arange(len(way))
        fine = np.interp(np.linspace(0, len(way) - 1, _FINER * (len(way) - 1) + 1), knots, way)
        values = self.scene.sweep.run(fine)
        for label in view.labels:
            if "at" in label:
                places = at(label["at"], values)
                if np.ptp(places.real) + np.ptp(places.imag) > _NEAR and np.isfinite(places).all():
                    yield Stroke(tuple(map(complex, places)), Pen.PALE)

    # Inscriptions --------------------------------------------------------------------------------

    def _labels(
        self,
        view: LiveView,
        at: Callable[..., Complexes],
        corner: complex,
        lines: list[_Ends],
        bounds: tuple[complex, complex],
    ) -> Iterator[DrawnBody]:
        """Yield the inscriptions in places that cover least and seldom change."""
        still = np.ones(len(self.positions), complex)
        is_scheme = view.id == "scheme"
        if is_scheme:
            fixed = self.scene.fixed
            ends = [[(complex(x, -y) + corner) * still for x, y in line] for line in fixed]
            lines += [(tail, head) for tail, head in ends]
            for part in self.scene.parts:
                if part.link != FRAME:
                    foot = at(self.scene.place(self.scene.anchor_point(part.link)))
                    turns = np.radians(self.values[self.scene.row(f"{part.link}.phi_deg")])
                    way = np.exp(1j * turns)
                    lines += [(foot + a * way, foot + b * way) for a, b in self.scene.bars(part)]
        tails, heads = (np.array([line[k] for line in lines]) for k in (0, 1))
        # Occupied boxes: their middles in every frame, half their widths and heights.
        taken: list[_Box] = []
        for ref, side in self.scene.blocks if is_scheme else []:
            taken.append((at(ref), complex(side, side)))
        for x0, y0, x1, y1 in self.scene.supports if is_scheme else []:
            middle = complex(x0 + x1, y0 + y1) / 2 + corner
            taken.append((middle * still, complex(x1 - x0, y1 - y0) / 2))
        gap = _GAP * (2.0 if is_scheme else 1.0)
        texts, tries, places = [], [], []
        for label in view.labels:
            text = typeset(label["text"], label.get("height", LETTER if is_scheme else _SMALL))
            half = complex(text.width, text.ascent + text.descent) / 2
            refs = [at(ref) for ref in label.get("on") or [label["at"]]]
            place = _kept_inside(sum(refs[1:], refs[0]) / len(refs), half, bounds)
            reaches = gap + np.abs(_LABEL_OFFSETS) - 1.0
            offs = _LABEL_OFFSETS.real * (reaches + half.real) + 1j * _LABEL_OFFSETS.imag * (
                reaches + half.imag
            )
            centres = place + (offs / np.abs(_LABEL_OFFSETS))[:, None]
            costs = np.abs(_LABEL_OFFSETS)[:, None] - 1.0 + np.zeros(centres.shape)
            for k, centre in enumerate(centres):
                costs[k] += 14.0 * _covered(centre, half, tails, heads)
            for other in taken:
                costs += 1.5 * _overlap(centres, half, other)
            costs += 9.0 * np.abs(centres - _kept_inside(centres, half, bounds))
            texts.append((text, half))
            tries.append((centres, costs))
            places.append(place)
        found: list[_Box | None] = [None] * len(texts)
        for _ in range(_ROUNDS):  # those before know nothing of those after in the first
            for number, (centres, costs) in enumerate(tries):
                half, whole = texts[number][1], costs.copy()
                for k, one in enumerate(found):
                    if one is not None and k != number:
                        area = _overlap(centres, half + complex(_LETTER_SPACE, _LETTER_SPACE), one)
                        whole += np.where(area > 0, _COVERS, 0.0) + 1.5 * area
                chosen = centres[_quiet(whole), np.arange(len(self.positions))]
                found[number] = chosen, half
        for (text, half), place, box in zip(texts, places, found, strict=True):
            assert box is not None
            start = complex(-half.real, text.descent - half.imag)
            centres = _kept_inside(place + self._gliding(box[0] - place), half, bounds)
            yield DrawnBody(tuple(text.at(start)), centres, np.zeros(len(centres)))

    def _gliding(self, offsets: Complexes) -> Complexes:
        """Return the offsets of an inscription from its point, mm, without jumps between frames."""
        frames = 2 * int(_GLIDE * len(offsets)) + 1
        around = np.pad(offsets, frames // 2, mode="wrap" if self.closed else "edge")
        return np.convolve(around, np.full(frames, 1.0 / frames), mode="valid")


def _overlap(centres: Complexes, half: complex, cover: _Box) -> Reals:
    """Return the area of boxes that another one covers in every frame, mm²."""
    away = centres - cover[0]
    across = half.real + cover[1].real - np.abs(away.real)
    up = half.imag + cover[1].imag - np.abs(away.imag)
    return np.asarray(np.clip(across, 0, None) * np.clip(up, 0, None))


def _kept_inside(centres: Complexes, half: complex, bounds: tuple[complex, complex]) -> Complexes:
    """Return the middles of boxes moved into the bounds, mm."""
    low, high = bounds[0] + half, bounds[1] - half
    return np.asarray(
        np.clip(centres.real, low.real, high.real) + 1j * np.clip(centres.imag, low.imag, high.imag)
    )


def _quiet(costs: Reals) -> npt.NDArray[np.intp]:
    """Return the number of an inscription's place in every frame of a cycle.

    The sum of the costs of the places and of the moves between them is least.
    """
    count = costs.shape[1]
    moved = _MOVE_COST * np.abs(_LABEL_OFFSETS[:, None] - _LABEL_OFFSETS[None, :])
    best, back = costs[:, 0], []
    for k in range(1, 2 * count):  # in the second round the start is known
        reached = best[:, None] + moved
        back.append(np.argmin(reached, axis=0))
        best = reached.min(axis=0) + costs[:, k % count]
    found = [int(np.argmin(best))]
    for came in reversed(back):
        found.append(int(came[found[-1]]))
    return np.array(found[::-1][count:])


def _covered(centre: Complexes, half: complex, tails: Complexes, heads: Complexes) -> Reals:
    """Return a measure of the segments that a box covers in every frame."""
    if not tails.size:
        return np.zeros(len(centre))
    way = heads - tails
    along = ((centre - tails) * np.conj(way)).real / np.maximum(np.abs(way) ** 2, 1e-12)
    off = centre - tails - np.clip(along, 0, 1) * way
    # Distance in boxes: 1 on the edge of the box.
    far = np.maximum(np.abs(off.real) / (half.real + 0.6), np.abs(off.imag) / (half.imag + 0.6))
    return np.asarray(np.clip(1.2 - far, 0.0, None).sum(axis=0))


def _refs(view: LiveView) -> list[Ref]:
    return [one[end] for one in view.segments for end in ("a", "b")]


_SHADES = 8  # levels with which the edges of lines are smooth


def gif(animation: Animation, seconds: float, dpi: float) -> bytes:
    """Return a GIF that repeats endlessly, ``seconds`` a cycle."""
    options = Options(dpi=dpi)
    inks = sorted({animation.pens.colour(pen) for pen in Pen if animation.pens.is_coloured})
    shades = np.linspace(0.0, 1.0, _SHADES)[:, None]
    colours = np.vstack([255 * shades + (1 - shades) * ink for ink in inks or [(0, 0, 0)]])
    colours = colours.round().astype(np.uint8)
    table = Image.new("P", (1, 1))
    table.putpalette(colours.tobytes())
    frames = []
    for drawing in animation.frames():
        with Image.open(BytesIO(render(drawing, "png", options=options))) as picture:
            frames.append(picture.convert("RGB").quantize(palette=table, dither=Image.Dither.NONE))
    file = BytesIO()
    # Viewers count hundredths of a second, and slow down frames shorter than two of them.
    each = max(2, round(100 * seconds / len(frames))) * 10
    frames[0].save(
        file, "gif", save_all=True, append_images=frames[1:], duration=each, loop=0, optimize=False
    )
    return file.getvalue()
