"""The scheme as a view of the sheet: letters, numbers, arrows of ω and ε, special points."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise
from math import inf

import numpy as np
from msgspec import Struct, field

from planmethod.construct.steps import LineName
from planmethod.mechanism.groups import triad_of
from planmethod.mechanism.model import FRAME
from planmethod.note.narrate.naming import point_name, spot_letters
from planmethod.note.numbers import is_noise
from planmethod.plans.draft import cis
from planmethod.plans.model import PlanKind
from planmethod.plans.motion.position import leg_points
from planmethod.problem.quantities import QuantityKind
from planmethod.render.ink.drawing import Arc, Disc, Ink, Item, Pen, Stroke
from planmethod.render.ink.pens import drawn_once
from planmethod.render.ink.typeset import arc_points, typeset
from planmethod.render.labels import Label
from planmethod.render.layout.block import Picture
from planmethod.render.pictures.lettered import lettered
from planmethod.render.pictures.planview import (
    USUAL_STYLE,
    Ellipses,
    PictureStyle,
    error_ellipses,
    scheme_traces,
)
from planmethod.render.pictures.scheme import Scheme
from planmethod.render.pictures.sizes import size_dimensions
from planmethod.render.pictures.springs import spring_labels
from planmethod.render.pictures.wheels import contacts
from planmethod.render.symbols import SIZES, angle_of, before_links, turn_arrow
from planmethod.solved.quantities import solution_peak
from planmethod.solved.reading import Complexes, Reals
from planmethod.solved.solution import Solution


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
_LETTER_COST = 4.0  # cost of a letter on a line
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
        sweep, name = self._sweep(radius), f"{kind.symbol} {link}"
        size = 3.5 * self.scheme.factor
        self.arrows += turn_arrow(
            centre, radius, sense, middle=middle, sweep=sweep, length=size, tag=name
        )
        aim = cis(middle - sense * sweep / 2)
        self.labels.append(
            Label(
                typeset(f"{kind.symbol}_{{{link}}}", self._height),
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
            + _LETTER_COST * nearness(letters[..., None], everything, 1.2 * height)[..., 0]
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


_EXTENSION = 4.0
"""Extension of a leg's line beyond the special point, mm."""

_MAX_UNUSED_DISTANCE = 1.0
"""Largest distance from the group of a drawn special point that no plan uses, in group sizes."""

_MAX_DISTANCE = 3.0
"""Largest distance of the point that the plans use: on paper it is found by its angles."""

_PARALLEL = 1e-3  # sine of the angle of lines that intersect too far away for any paper


def special_points(scheme: Scheme) -> tuple[list[Item], list[Label]]:
    """Return the special points of all triads, the legs' lines up to them, and their letters."""
    items: list[Item] = []
    labels: list[Label] = []
    construction = scheme.solution.construction
    for group in construction.structure.groups:
        triad = triad_of(group)
        if triad is None:
            continue
        special = construction.draft.special[triad.base]
        ends = [[scheme.at(point) for point in leg_points(*leg)] for leg in triad.legs]
        joints = [place for leg in ends for place in leg]
        middle = sum(joints) / len(joints)
        size = max(abs(place - middle) for place in joints)
        for third in range(3):
            pair = [k for k in range(3) if k != third]
            place = _intersect_lines(scheme, *(special.lines[k] for k in pair))
            used = third == special.third
            if (
                place is None
                or abs(place - middle)
                > (_MAX_DISTANCE if used else _MAX_UNUSED_DISTANCE) * size + size
            ):
                continue
            for k in pair:
                items += _line(ends[k], place)
            items.append(Disc(place, 0.8 * scheme.factor, Ink.BLACK, tag="special point"))
            letter = typeset(point_name(f"{special.point[:-1]}{3 - third}"), scheme.letter_height)
            labels.append(Label(letter, place, gap=1.5, priority=1, name="special point"))
    return items, labels


def _intersect_lines(scheme: Scheme, one: LineName, two: LineName) -> complex | None:
    paper, index = scheme.solution.paper, scheme.index
    (p, u), (q, v) = (
        (complex(paper.origin(line)[index]), complex(paper.line_vector(line)[index]))
        for line in (one, two)
    )
    across = (u.conjugate() * v).imag
    if abs(across) < _PARALLEL * abs(u) * abs(v):
        return None
    return p + u * ((q - p).conjugate() * v).imag / across


def _line(ends: list[complex], place: complex) -> list[Item]:
    """Return the line of a leg from its nearer joint to the special point, and a little on.

    Empty if it lies on the leg itself.
    """
    start = min(ends, key=lambda end: abs(end - place))
    away = place - start
    if abs(away) < 1.0:
        return []
    return [Stroke((start, place + away / abs(away) * _EXTENSION), Pen.THIN, tag="special line")]


class SchemeView(Struct):
    """A drawn scheme with its arrows and labels."""

    scheme: Scheme
    arrows: list[Item] = field(default_factory=list)
    labels: list[Label] = field(default_factory=list)

    @classmethod
    def drawn(cls, solution: Solution, index: int, style: PictureStyle = USUAL_STYLE) -> SchemeView:
        """Return the scheme in one position, without labels and ellipses yet."""
        scheme = Scheme(solution, index, style.letter_height)
        scheme.draw()
        scheme.draw_joints()
        scheme.guides += scheme_traces(solution, index, scheme.factor, style.traces)
        return cls(scheme)

    def items(self, marks: Sequence[Item] = ()) -> list[Item]:
        """Return the drawn items in order; ``marks`` are the joints of other positions."""
        s = self.scheme
        mechanism = before_links([*s.slider_items, *s.lines, *s.corners, *marks, *s.joints])
        return [*s.guides, *mechanism, *self.arrows]


def letter_points(view: SchemeView, points: Sequence[str] | None = None) -> None:
    """Letter the points of the scheme, or some of them."""
    scheme = view.scheme
    for point in scheme.named if points is None else points:
        place = scheme.at(point)
        lines = scheme.directions(place)
        view.labels.append(
            Label(
                typeset(spot_letters(scheme.solution.problem, point), scheme.letter_height),
                place,
                prefer=-sum(lines, 0j) if lines else 1 + 1j,
                gap=1.5 * scheme.factor + 1.2,
                priority=1,
                name=f"point {point}",
            )
        )


_LETTER = 6.0  # room of an axis's letter between the joints of other positions, mm


def axis_labels(scheme: Scheme, other_joints: Sequence[complex] = ()) -> Iterator[Label]:
    """Yield letters at the ends of the guides' axes, but for an end that lies on a link.

    Guides on moving links have letters at both ends, but an end at a point has only the point's
    letter. ``other_joints`` are the joints in other positions, among which a letter would be lost.
    """
    at = [scheme.at(point) for point in scheme.named]
    for label, low, high in scheme.slot_ends:
        text = typeset(label.partition("–")[0], scheme.letter_height)
        for end, other in ((low, high), (high, low)):
            if min((abs(end - place) for place in at), default=inf) > _LETTER:
                yield Label(text, end, prefer=end - other, gap=1.0)
    for label, low, high in scheme.axis_ends:
        names = label.split("-")
        if len(names) != 2:
            continue
        ends = [(names[0], low, low - high), (names[1], high, high - low)]
        free = [
            min([scheme.clearance(end), *(abs(end - place) - _LETTER for place in other_joints)])
            for _, end, _ in ends
        ]
        for (name, place, away), room in zip(ends, free, strict=True):
            if room > 4.0 or room == max(free):
                yield Label(typeset(name, scheme.letter_height), place, prefer=away, gap=1.0)


def letter_links(
    view: SchemeView,
    background: Sequence[Item] = (),
    *,
    senses: bool = True,
    driver_only: bool = False,
) -> list[Item]:
    """Add the links' numbers, and circular arrows for the senses of omega and epsilon.

    Among the lines of ``background``, the other positions, only the driver has arrows; in a single
    position also its angle. With ``driver_only`` only the driver has arrows in any case. Return the
    items that letters keep clear of.
    """
    scheme, own = view.scheme, Senses(view.scheme, background)
    drive = scheme.solution.problem.drive.link
    if senses and not background:
        own.angle()
    problem = scheme.solution.problem
    for link in (one for one in problem.mechanism.links if one not in contacts(problem)):
        view.labels.append(scheme.link_label(link, 5.5 * scheme.factor))
        if senses and (link == drive or not (background or driver_only)):
            own.of(link)
    view.arrows += own.arrows
    view.labels += [*own.labels, *spring_labels(scheme)]
    return own.clear


@drawn_once
def scheme_picture(
    solution: Solution,
    index: int,
    style: PictureStyle = USUAL_STYLE,
    *,
    hide_motion: bool = False,
    driver_only: bool = False,
    added: tuple[tuple[Item, ...], tuple[Label, ...]] = ((), ()),
) -> Picture:
    """Return the scheme in one position as a picture, mm.

    ``hide_motion`` leaves out the signs of the motion: arrows, the angle of the driver, letters of
    the axes; ``driver_only``, the arrows of all links but the driver, which an assignment asks to
    find. ``added`` are more items and their letters.
    """
    view = SchemeView.drawn(solution, index, style)
    special = special_points(view.scheme) if not hide_motion else ([], [])
    view.scheme.guides += special[0]
    view.labels += special[1]
    ellipses = error_ellipses(solution, PlanKind.POSITION, index) if style.errors else Ellipses()
    letter_points(view)
    if not hide_motion:
        view.labels += axis_labels(view.scheme)
    clear = letter_links(view, senses=not hide_motion, driver_only=driver_only)
    # The ellipses after the joints, whose white would cover them.
    items = [*view.items(), *added[0], *ellipses.strokes]
    ends = ends_of(items)
    corner = complex(float(ends.real.max()), float(ends.imag.min()))
    sizes, letters = size_dimensions(view.scheme, corner, small(view.scheme.letter_height))
    labels = [*view.labels, *added[1], *letters]
    return lettered([*sizes, *items], labels, clear=[*ellipses.grounds, *clear])
