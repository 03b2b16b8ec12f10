"""Arrows of ω and ε on a scheme, and the angle of its crank: their choice and places."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise

import numpy as np
from msgspec import Struct, field

from planmethod.mechanism.model import FRAME
from planmethod.note.narrate.statement import solution_peak
from planmethod.note.numbers import is_noise
from planmethod.plans.draft import cis
from planmethod.plans.legend import QuantityKind
from planmethod.render.ink.drawing import Arc, Item, Pen, Stroke
from planmethod.render.ink.extent import arc_points
from planmethod.render.ink.typeset import typeset
from planmethod.render.labels import Label
from planmethod.render.pictures.scheme import Scheme
from planmethod.render.symbols import SIZES, angle_of, turn_arrow
from planmethod.solved.reading import Complexes, Reals


def small(height: float) -> float:
    """Return the height of the smaller letters of a scheme, mm, beside the usual ones."""
    return max(3.5, 0.7 * height)


SWEEP, ARC = 70.0, 24.0
"""Largest angle of an arrow of ω or ε, degrees, and its length before ``factor``, mm."""

_MIN_RADIUS, _BETWEEN = 14.0, 11.0
"""Least radius about a pivot, and between two arrows there, before ``factor``, mm."""

_RADIUS = 8.0
"""Radius of both arrows of a link without a pivot, before ``factor``, mm."""

_CLEAR, _ARROW_SPACING = 4.0, 7.0
"""White to lines, joints and sliders, and to other arrows, before ``factor``, mm."""

_FURTHER = 0.03  # cost of a mm of radius: one place of an arc on a line costs 1
_TURN_COST = 0.8  # cost of half a turn from the link
_LETTER = 4.0  # cost of a letter on a line
_MAX_COST = 2.5  # cost from which an arrow is left out: the table of results shows the sense
_OFF_BAR = (2.0, 3.6, 8.0)  # mm from the zero line of φ, where letters are kept off its other side
_BAR = 8.0  # mm further than the line itself


class Senses(Struct):
    """Arrows of turns on a scheme (направления угловых скоростей и ускорений).

    An arrow is about the pivot of its link, ε well outside ω; on a link without a pivot the two
    have one centre on the link and cross it on both sides. An arrow takes the place most clear of
    lines, joints, sliders and other arrows; a crank's may be anywhere round the pivot. Its letter
    is behind its tail. An arrow without space is left out. ``background`` are the lines of other
    positions, among which the letters are small and ε, which the statement gives, is left out.
    """

    scheme: Scheme
    background: Sequence[Item] = ()
    arrows: list[Item] = field(default_factory=list)
    labels: list[Label] = field(default_factory=list)
    clear: list[Item] = field(default_factory=list)

    @property
    def _height(self) -> float:
        return small(self.scheme.letter_height) if self.background else self.scheme.letter_height

    def of(self, link: str) -> None:
        """Draw the arrows of a link: none if it has no length, or rotates with its guide."""
        scheme, problem = self.scheme, self.scheme.solution.problem
        motion, body = scheme.solution.links[link], problem.bodies[link].points
        part = scheme.longest(link)
        if part is None or (link in problem.slides and len(body) == 1):
            return
        values = {
            QuantityKind.OMEGA: float(motion.omega[scheme.index]),
            **(
                {}
                if self.background
                else {QuantityKind.EPSILON: float(motion.epsilon[scheme.index])}
            ),
        }
        senses = {
            kind: 1 if value > 0 else -1
            for kind, value in values.items()
            if not is_noise(value, solution_peak(scheme.solution, kind))
        }
        pivot = next((p for p in body if p in problem.bodies[FRAME].points), None)
        if pivot is None:
            self._draw_across_link(link, part, senses)
        else:
            self._draw_about_pivot(link, part, scheme.at(pivot), senses)

    def _draw_about_pivot(
        self, link: str, part: tuple[complex, complex], pivot: complex,
        senses: dict[QuantityKind, int],
    ) -> None:  # fmt: skip
        """Draw the arrows of a link about its pivot, on the link or, of the driver, beside it."""
        far = max(part, key=lambda end: abs(end - pivot))
        along, f = angle_of(far - pivot), self.scheme.factor
        least, most = _MIN_RADIUS * f, max(abs(far - pivot), (_MIN_RADIUS + _BETWEEN) * f)
        is_driver = link == self.scheme.solution.problem.drive.link
        for kind, sense in senses.items():
            ways = np.arange(least, max(most, least + 7.0 * f), 2.0 * f)
            sweeps = np.minimum(SWEEP, np.degrees(ARC * f / ways))
            offs = np.arange(-180.0, 180.0, 15.0) if is_driver else np.linspace(-0.25, 0.25, 5)
            turns = along + offs[None, :] * (np.ones_like(ways) if is_driver else sweeps)[:, None]
            radii = np.broadcast_to(ways[:, None], turns.shape)
            costs = self._costs(np.full(turns.shape, pivot), radii, turns, sense, link)
            costs += _FURTHER * (radii - least) + _TURN_COST * np.abs(turns - along) / 180.0
            best = np.unravel_index(int(np.argmin(costs)), costs.shape)
            if costs[best] > _MAX_COST:
                continue
            self._draw(link, kind, pivot, float(radii[best]), float(turns[best]), sense)
            least = float(radii[best]) + _BETWEEN * f

    def _draw_across_link(
        self, link: str, part: tuple[complex, complex], senses: dict[QuantityKind, int]
    ) -> None:
        """Draw the arrows of a link without a pivot on both sides of a place of it."""
        start, end = part
        length, along, radius = (
            abs(end - start),
            angle_of(end - start),
            _RADIUS * self.scheme.factor,
        )
        ways = np.linspace(0.0, length, max(12, int(length / 2)))
        inside = ways[(ways >= radius) & (ways <= length - radius)]
        ways = inside if len(inside) else np.array([length / 2])
        centres = (start + (end - start) / length * ways)[:, None]
        offs = np.linspace(-0.25, 0.25, 5)[None, :] * SWEEP
        whole = 0.01 * np.abs(ways - 0.45 * length)
        found = {}
        for side, (kind, sense) in enumerate(senses.items()):
            turns = np.broadcast_to(along + 180.0 * side + offs, (len(ways), offs.size))
            shape = turns.shape
            costs = self._costs(
                np.broadcast_to(centres, shape), np.full(shape, radius), turns, sense, link
            ) + _TURN_COST * np.abs(offs) / 180.0  # fmt: skip
            found[kind] = turns[np.arange(len(ways)), np.argmin(costs, axis=1)]
            whole = whole + costs.min(axis=1)
        best = int(np.argmin(whole))
        if whole[best] > _MAX_COST * len(senses):
            return
        for kind, sense in senses.items():
            centre = complex(centres[best, 0])
            self._draw(link, kind, centre, radius, float(found[kind][best]), sense)

    def _draw(
        self, link: str, kind: QuantityKind, centre: complex, radius: float, middle: float,
        sense: int,
    ) -> None:  # fmt: skip
        """Draw an arrow, and add the label of its letter behind its tail."""
        sweep, name = self._sweep(radius), f"{kind.sign} {link}"
        size = 3.5 * self.scheme.factor
        self.arrows += turn_arrow(
            centre, radius, sense, middle=middle, sweep=sweep, length=size, tag=name
        )
        aim = cis(middle - sense * sweep / 2)
        self.labels.append(
            Label(
                typeset(f"{kind.sign}_{{{link}}}", self._height),
                centre + radius * aim,
                prefer=-1j * sense * aim,
                gap=0.8,
                priority=2,
                name=name,
            )
        )

    def _sweep(self, radius: float) -> float:
        return min(SWEEP, float(np.degrees(ARC * self.scheme.factor / radius)))

    # Room ------------------------------------------------------------------------------------

    def _costs(
        self, centres: Complexes, radii: Reals, turns: Reals, sense: int, link: str
    ) -> Reals:
        """Return the costs of places of an arrow by the items near its arc and its letter.

        ``turns`` are the directions of the arc's middle, degrees; all have one shape, as the costs.
        """
        scheme, f, own = self.scheme, self.scheme.factor, f"link {link}"
        firm = [*scheme.slider_items, *scheme.lines, *scheme.joints]
        joints: list[Item] = [Stroke((p, p + 1e-6)) for p in map(scheme.at, scheme.named)]
        strange = ends_of([*(item for item in firm if item.tag != own), *joints])
        half = np.minimum(SWEEP, np.degrees(ARC * f / radii)) / 2
        steps = np.linspace(-1.0, 1.0, 9)
        arcs = centres[..., None] + radii[..., None] * _cis(
            turns[..., None] + half[..., None] * steps
        )
        height = self._height
        beyond = half + np.degrees(height / radii)
        letters = centres + radii * _cis(turns - sense * beyond)
        everything = ends_of([*firm, *joints, *self.arrows, *self.background, *self.clear])
        costs: Reals = (
            nearness(arcs, strange, _CLEAR * f).sum(axis=-1)
            + 2.0 * nearness(arcs, ends_of(self.arrows), _ARROW_SPACING * f).sum(axis=-1)
            + _LETTER * nearness(letters[..., None], everything, 1.2 * height)[..., 0]
        )
        return costs

    # The crank's angle -----------------------------------------------------------------------

    def angle(self) -> None:
        """Draw the crank's angle phi from the horizontal, which letters keep clear of."""
        scheme = self.scheme
        drive = scheme.solution.problem.drive
        if drive.pivot is None:
            return
        phi = _swept(
            scheme.solution.problem.display_position(float(scheme.solution.positions[scheme.index]))
        )
        if not 8 < abs(phi) < 352:
            return
        centre, radius = scheme.at(drive.pivot), 6.0 * scheme.factor + 2
        support = angle_of(scheme.free_direction(centre)) % 360.0
        if support < phi or support - 360.0 > phi:
            radius = (SIZES.support_height + SIZES.hatch_stroke + 4.0) * scheme.factor
            pins = [scheme.at(p) for p in scheme.solution.problem.bodies[drive.link].points]
            if max(abs(pin - centre) for pin in pins) < radius + 4.0:
                return  # no space for an arc around the support: the statement gives the angle
        end = centre + radius + 6
        drawn = [
            Stroke((centre, end), Pen.THIN, tag="phi"),
            *turn_arrow(
                centre,
                radius,
                1 if phi > 0 else -1,
                middle=phi / 2,
                sweep=abs(phi),
                length=2.5,
                tag="phi",
            ),
        ]
        scheme.guides += drawn
        # Over the line and under it letters would read as a fraction.
        offs = [-1j * off * (1 if 0.0 < phi < 180.0 else -1) for off in _OFF_BAR]
        bars: list[Item] = [Stroke((centre + off, end + _BAR + off), Pen.THIN) for off in offs]
        size = small(scheme.letter_height)
        reach = radius + 1.0 + 1.4 * size
        letter = Stroke((centre + (radius + 1.0) * cis(phi / 2), centre + reach * cis(phi / 2)))
        self.clear += [*drawn, *bars, letter]
        self.labels.append(
            Label(
                typeset(f"φ_{{{drive.link}}}", size),
                centre + radius * cis(phi / 2),
                prefer=cis(phi / 2),
                gap=1.0,
                name="phi",
            )
        )


def _swept(phi: float) -> float:
    """Return the angle of an arc: a negative one above -180° is laid off clockwise."""
    return phi if -180.0 < phi < 0.0 else phi % 360.0


def _cis(degrees: Reals) -> Complexes:
    return np.asarray(np.exp(1j * np.radians(degrees)))


def ends_of(items: Iterable[Item]) -> Complexes:
    """Return the ends of the straight parts of items, shape (n, 2), mm."""
    pairs: list[tuple[complex, complex]] = []
    for item in items:
        if isinstance(item, Stroke):
            pairs += pairwise([*item.points, *item.points[: 1 if item.closed else 0]])
        elif isinstance(item, Arc):
            pairs += pairwise(arc_points(item))
    return np.asarray(pairs, dtype=complex).reshape(-1, 2)


def nearness(places: Complexes, ends: Complexes, clear: float) -> Reals:
    """Return the nearness of places to lines: 1 on one, 0 from ``clear`` mm on; the places' shape.

    Places along the last axis lie together; lines too far from all of them are not measured.
    """
    groups = places.reshape(-1, places.shape[-1])
    middles, centres = groups.mean(axis=-1), ends.mean(axis=-1)
    reach = np.abs(groups - middles[:, None]).max(axis=-1)[:, None] + clear + 1e-6
    near, line = np.nonzero(
        np.abs(middles[:, None] - centres) < reach + np.abs(ends[:, 1] - centres)
    )
    found = np.zeros(groups.shape)
    if len(near):
        starts = ends[line, :1]
        ways = ends[line, 1:] - starts + 1e-9
        offs = groups[near] - starts
        room = np.abs(offs - ways * np.clip((offs / ways).real, 0.0, 1.0))
        first = np.flatnonzero(np.diff(near, prepend=-1))
        least = np.minimum.reduceat(room, first, axis=0)
        found[near[first]] = np.maximum(0.0, 1.0 - least / clear)
    return found.reshape(places.shape)
