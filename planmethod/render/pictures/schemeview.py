"""The scheme as a view of the sheet: the drawn mechanism with its letters, numbers and arrows."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import inf

from msgspec import Struct, field

from planmethod.note.narrate.statement import point_name
from planmethod.plans.model import PlanKind
from planmethod.render.ink.drawing import Item
from planmethod.render.ink.typeset import typeset
from planmethod.render.labels import Label
from planmethod.render.layout.block import Picture
from planmethod.render.pictures.ellipses import Ellipses, error_ellipses
from planmethod.render.pictures.lettered import lettered
from planmethod.render.pictures.scheme import Scheme
from planmethod.render.pictures.senses import Senses
from planmethod.render.pictures.special import special_points
from planmethod.render.pictures.traces import Shown, scheme_traces
from planmethod.render.symbols import before_links
from planmethod.solved.reading import memoized
from planmethod.solved.solution import Solution


class SchemeView(Struct):
    """A drawn scheme with its arrows and labels."""

    scheme: Scheme
    arrows: list[Item] = field(default_factory=list)
    labels: list[Label] = field(default_factory=list)

    @classmethod
    def drawn(
        cls, solution: Solution, index: int, letter_height: float, traces: Shown = False
    ) -> SchemeView:
        """Return the scheme in one position, without labels yet."""
        scheme = Scheme(solution, index, letter_height)
        scheme.draw()
        scheme.draw_joints()
        scheme.guides += scheme_traces(solution, index, scheme.factor, traces)
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
                typeset(point_name(point), scheme.letter_height),
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
    for link in scheme.solution.problem.mechanism.links:
        view.labels.append(scheme.link_label(link, 5.5 * scheme.factor))
        if senses and (link == drive or not (background or driver_only)):
            own.of(link)
    view.arrows += own.arrows
    view.labels += own.labels
    return own.clear


@memoized
def scheme_picture(
    solution: Solution,
    index: int,
    *,
    letter_height: float = 5.0,
    errors: bool = False,
    hide_motion: bool = False,
    driver_only: bool = False,
    traces: Shown = False,
    added: tuple[tuple[Item, ...], tuple[Label, ...]] = ((), ()),
) -> Picture:
    """Return the scheme in one position as a picture, mm.

    ``errors`` draws the ellipses of the drafting error around the moving points. ``hide_motion``
    leaves out the signs of the motion: arrows, the angle of the driver, letters of the axes;
    ``driver_only``, the arrows of all links but the driver, which an assignment asks to find.
    ``traces`` is explained by `planmethod.render.pictures.traces`. ``added`` are more items and
    their letters.
    """
    view = SchemeView.drawn(solution, index, letter_height, traces)
    special = special_points(view.scheme) if not hide_motion else ([], [])
    view.scheme.guides += special[0]
    view.labels += special[1]
    ellipses = error_ellipses(solution, PlanKind.POSITION, index) if errors else Ellipses()
    letter_points(view)
    if not hide_motion:
        view.labels += axis_labels(view.scheme)
    clear = letter_links(view, senses=not hide_motion, driver_only=driver_only)
    # The ellipses after the joints, whose white would cover them.
    items = [*view.items(), *added[0], *ellipses.strokes]
    return lettered(items, [*view.labels, *added[1]], clear=[*ellipses.grounds, *clear])
