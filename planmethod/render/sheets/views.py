"""Views of a sheet with their scales and segments, of one position or several; its texts."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from itertools import combinations
from types import MappingProxyType

import numpy as np
import numpy.typing as npt
from msgspec.structs import replace

from planmethod.construct.scale import Scale
from planmethod.construct.steps import PointName
from planmethod.mechanism.model import FRAME
from planmethod.note.document import Caption, Equations, Formula, GivenFact, plain_text
from planmethod.note.narrate.cycle import extremes_named
from planmethod.note.narrate.equations import known_directions, stated_equations
from planmethod.note.narrate.figure import figure_sentences
from planmethod.note.narrate.naming import (
    detail_view_letter,
    direction_text,
    plan_letters,
    point_name,
    scale_inscription,
    view_name,
)
from planmethod.note.narrate.statement import NBSP, given_facts, motion_unknowns, unbroken
from planmethod.note.narrate.steps import calculation
from planmethod.note.numbers import Notation, is_negligible, with_unit
from planmethod.note.wording import Language
from planmethod.plans.model import RATES, PlanKind, Vector
from planmethod.render.ink.drawing import Arc, Disc, Item, Pen, Span, Stroke
from planmethod.render.ink.typeset import typeset, vector_markup
from planmethod.render.labels import Label, Segment
from planmethod.render.labels.model import as_segments, inside
from planmethod.render.layout.block import (
    Alternatives,
    Block,
    Column,
    Line,
    Picture,
    Row,
    Spacer,
    heading,
    make_alternatives,
    paragraph,
    titled,
)
from planmethod.render.layout.text_blocks import blocks_of
from planmethod.render.pictures.collinear import drawn_vectors
from planmethod.render.pictures.lettered import (
    ENLARGED,
    letter_of_view,
    placed_in,
    with_hatching,
)
from planmethod.render.pictures.paths import Paths
from planmethod.render.pictures.planview import (
    POLE,
    SHORTEST_NAMED,
    SIMILAR,
    PictureStyle,
    detail_pictures,
    detail_views_in,
    ellipse_inscription,
    has_vectors_apart,
    names_all_vectors,
    plan_picture,
    plan_places,
    shown_traces,
    similar_lines,
    similar_triangles,
    vector_label,
)
from planmethod.render.pictures.schemeview import scheme_picture
from planmethod.render.pictures.seriesview import POSITION_PRIMES, series_picture, shows_extremes
from planmethod.render.sheets.composer import ViewBlock
from planmethod.render.sheets.model import BlockStyle
from planmethod.solved.extents import OUTLIER, median, sizes, typical
from planmethod.solved.legibility import FEW, min_enlarged, short_readings
from planmethod.solved.reading import Reals, memoized
from planmethod.solved.solution import Solution
from planmethod.solved.turn.cycle import crank_cycle_of
from planmethod.solved.view_space import BETWEEN, column_widths, per_row

_MIN_SINE = 0.3  # sine of the least angle between joined links of the clearest one
_SMALL = 0.15  # part of its usual size that a velocity has in the clearest one at least
_COVERS, _COVERED = 2.0, 0.4  # mm between links that look like one, along this part of the shorter
_JOINTS = 3.0  # mm of paper between two joints of a clear one
_MIN_VECTOR = 1.0  # mm that a vector of its plans has at least


def clear_position(solution: Solution) -> int:
    """Return the position to draw in full and calculate if the file does not specify it.

    See `clearest_position`; positions count from 0.
    """
    return clearest_position(solution, tuple(range(len(solution.positions))))


@memoized
def clearest_position(solution: Solution, indices: tuple[int, ...]) -> int:
    """Return the position that shows the mechanism best.

    It is in proportion to the others, no two of its joints lie within 3 mm of paper and no vector
    of its plans vanishes; if possible, no link covers another one; if possible, no two joined links
    lie nearly in one line, no velocity nearly vanishes, as it does where the output turns back, and
    no plan is much larger than the others. Among several, it has the fewest segments too short to
    be read well; among those, it is the furthest from a dead position.
    """
    solution, chosen = solution.origin, list(indices)  # whatever scales a sheet tries
    clear, bare = is_clear(solution), _links_uncovered(solution)
    drawable = solution.extents.on_scheme[chosen]
    better = sum(f(solution)[chosen].astype(int) for f in (_moving, _links_angled, _usual))
    short = -short_readings(solution.construction, solution.paper)[chosen]
    ranks = zip(
        drawable.tolist(), clear[chosen].tolist(), bare[chosen].tolist(),
        np.asarray(better).tolist(), short.tolist(), solution.margin[chosen].tolist(), strict=True,
    )  # fmt: skip
    ranked = dict(zip(indices, ranks, strict=True))
    return max(indices, key=lambda index: ranked[index])


@memoized
def is_clear(solution: Solution) -> npt.NDArray[np.bool_]:
    """Return in which positions no two joints lie together on the paper and no vector vanishes."""
    return _joints_separate(solution.origin) & _vectors_visible(solution.origin)


def _vectors(solution: Solution, kind: PlanKind) -> list[Reals]:
    """Return the sizes of the vectors of a plan that are ever something, in its unit."""
    plan = solution.construction.plan(kind)
    found = [np.abs(solution.si.vector(v.tail, v.head)) for v in plan.vectors]
    return [size for size in found if size.any()]


def _joints_separate(solution: Solution) -> npt.NDArray[np.bool_]:
    """Return in which positions all joints that ever lie apart on the paper do so."""
    problem, paper = solution.problem, solution.paper
    names = {joint.point for joint in problem.mechanism.revolutes}
    names |= {slide.pin for slide in problem.slides.values()}
    places = [paper.point(PointName(name)) for name in sorted(names)]
    apart = np.ones(len(solution.positions), dtype=bool)
    for one, other in combinations(places, 2):
        distance = np.abs(one - other)
        if distance.max() >= _JOINTS:
            apart &= distance >= _JOINTS
    return apart


def _vectors_visible(solution: Solution) -> npt.NDArray[np.bool_]:
    """Return in which positions no vector of a plan vanishes, except those that mostly do."""
    seen = np.ones(len(solution.positions), dtype=bool)
    for kind in RATES:
        per_mm = solution.scales[kind].per_mm
        for size in _vectors(solution, kind):
            seen &= size >= min(_MIN_VECTOR * per_mm, _SMALL * median(size))
    return seen


def _moving(solution: Solution) -> npt.NDArray[np.bool_]:
    """Return in which positions no velocity is much smaller than it usually is."""
    found = [
        size >= _SMALL * median(size[size > 0]) for size in _vectors(solution, PlanKind.VELOCITY)
    ]
    return np.all(found, axis=0) if found else np.ones(len(solution.positions), dtype=bool)


def _links_angled(solution: Solution) -> npt.NDArray[np.bool_]:
    """Return in which positions no two joined links lie nearly in one line."""
    apart = np.ones(len(solution.positions), dtype=bool)
    axes = {
        link: np.exp(1j * np.radians(motion.phi_deg))
        for link, motion in solution.links.items()
        if len(solution.problem.bodies[link].points) > 1
    }
    for joint in solution.problem.mechanism.revolutes:
        for one, two in combinations([link for link in joint.links if link in axes], 2):
            apart &= np.abs((axes[one] * np.conj(axes[two])).imag) > _MIN_SINE
    return apart


def _links_uncovered(solution: Solution) -> npt.NDArray[np.bool_]:
    """Return in which positions no link lies along another one, apart from those that always do."""
    problem, paper = solution.problem, solution.paper
    ends = {
        (link, *pair)
        for link, body in problem.bodies.items()
        if link != FRAME
        for pair in combinations(sorted(set(body.points) - problem.centres), 2)
    }
    ends |= {
        (slide.host, slide.through, slide.pin)
        for slide in problem.slides.values()
        if slide.host != FRAME and slide.through is not None
    }
    lines = [
        (link, paper.point(PointName(one)), paper.point(PointName(other)))
        for link, one, other in sorted(ends)
    ]
    bare = np.ones(len(solution.positions), dtype=bool)
    for (one, a, b), (other, c, d) in combinations(lines, 2):
        if one == other:
            continue
        way, zero = d - c, np.zeros(len(bare))
        turned, size = np.conj(way) / np.maximum(np.abs(way), 1e-9), np.abs(way)
        boxes = np.stack([zero, zero - _COVERS, size, zero + _COVERS], axis=1)
        common = inside(as_segments((a - c) * turned, (b - c) * turned), boxes)
        covered = common >= _COVERED * np.minimum(size, np.abs(b - a))
        if not covered.all():
            bare &= ~covered
    return bare


def _usual(solution: Solution) -> npt.NDArray[np.bool_]:
    """Return in which positions no plan is much larger than the others."""
    usual = np.ones(len(solution.positions), dtype=bool)
    for kind in RATES:
        size = np.maximum(*sizes(solution.construction, solution.si, kind))
        usual &= size <= OUTLIER * typical(size)
    return usual


POINT = 1e-6
"""Length on a plan, mm, below which a segment is a rounding error of a mechanism at rest."""

NO_VIEWS: Mapping[int, complex] = MappingProxyType({})

LARGER = (1.0, 1.5, 2.2)
"""Enlargements of a polar diagram where there is space."""


class PlanViewBlock(ViewBlock, frozen=True):
    """Plans of some positions, in the order in which they are drawn."""

    solution: Solution
    kind: PlanKind
    position_indices: tuple[int, ...]
    use_ruler: bool = False

    def spans(self, items: Sequence[Item], corner: complex) -> Iterable[Span]:
        """Return the segments of the plans."""
        poles = [item.centre for item in items if isinstance(item, Disc) and item.tag == POLE]
        views = {
            int(item.tag.split()[1]): item.centre
            for item in items
            if isinstance(item, Arc) and item.tag.startswith(ENLARGED) and item.tag[-1].isdigit()
        }
        for pole, index in zip(poles, self.position_indices, strict=False):
            yield from plan_spans(
                self.solution, self.kind, index, pole, use_ruler=self.use_ruler, views=views
            )


def plan_spans(
    solution: Solution,
    kind: PlanKind,
    index: int,
    pole: complex,
    *,
    use_ruler: bool = False,
    views: Mapping[int, complex] = NO_VIEWS,
) -> list[Span]:
    """Return the measured segments of a plan whose pole lies at ``pole`` on the sheet.

    A vector negligible against the plan is zero by nature and is not a segment. ``views`` are the
    middles of the enlarged views by the numbers of their knots: their segments are measured there.
    """
    plan = solution.construction.plan(kind)
    at = plan_places(solution, kind, index, use_ruler=use_ruler)
    sizes = [abs(at[vector.head] - at[vector.tail]) for vector in plan.vectors]
    letters = plan_letters(solution.problem, plan)
    position = index if len(solution.positions) > 1 else None
    named = {
        frozenset((vector.tail, vector.head)): vector
        for vector, size in zip(plan.vectors, sizes, strict=True)
        if size > POINT and not is_negligible(size, max(sizes))
    }
    knots = [
        detail_view
        for detail_view in detail_views_in(solution, kind, index, at)
        if detail_view.number in views
    ]
    shown = {frozenset(pair): detail_view for detail_view in knots for pair in detail_view.ends}
    drawn: dict[int | None, dict[Vector, Segment]] = {None: dict(drawn_vectors(plan, at))}
    drawn |= {knot.number: dict(drawn_vectors(plan, placed_in(knot, at))) for knot in knots}
    spans: list[Span] = []
    alone, least = len(solution.positions) == 1, min_enlarged(solution.profile.ruler)
    for ends, vector in named.items():
        knot = shown.get(ends)
        if alone and knot is None and abs(at[vector.head] - at[vector.tail]) < least:
            continue  # listed as zero
        times, middle = (1.0, pole) if knot is None else (knot.times, views[knot.number])
        tail, head = drawn[None if knot is None else knot.number][vector]
        share = solution.scales[kind].per_mm / solution.plan_scale(kind, index).per_mm
        name = plain_text(letters[vector.tail][0] + letters[vector.head][0])
        label = "" if knot is not None else vector_label(f"{kind.value} {index}", vector)
        spans.append(Span(name, position, middle + tail, middle + head, share * times, label))
    return spans


def _picture_style(solution: Solution, style: BlockStyle) -> PictureStyle:
    """Return the style of the pictures of a block."""
    traces = shown_traces(solution, style.entry.traces, has_space=style.options.traces)
    return PictureStyle(style.letter, style.options.errors, traces, style.entry.hatched)


def _with_triangles(
    solution: Solution,
    index: int,
    style: PictureStyle,
    draw: Callable[[tuple[tuple[Item, ...], tuple[Label, ...]]], Picture],
) -> Picture:
    """Return a scheme with the links' triangles of the similarity theorem, if requested."""
    if not style.hatched:
        return draw(((), ()))
    triangles = similar_triangles(solution, PlanKind.POSITION, index)
    sides = [Stroke((*three, three[0]), Pen.THIN, tag=SIMILAR) for three in triangles]
    return with_hatching(draw((tuple(sides), ())), triangles)


def scheme_view(
    solution: Solution, position_indices: Sequence[int], style: BlockStyle
) -> ViewBlock:
    """Return the scheme in one position; `scheme_views` shows several."""
    (index,) = position_indices
    own, kind = _picture_style(solution, style), PlanKind.POSITION
    picture = _with_triangles(
        solution, index, own, lambda added: scheme_picture(solution, index, own, added=added)
    )
    block = with_scale(solution, kind, picture, style, position_indices)
    return ViewBlock(block, kind.value, solution.scales[kind])


def plan_view(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return a plan with its enlarged views; `plan_views` shows those of several positions.

    It is drawn with the readings of the ruler, so that a ruler finds the numbers of the
    calculation; with error ellipses, which are around the exact points, it is exact.
    """
    kind = style.entry.of
    assert kind is not None
    ways = plan_with_details(
        solution, kind, position_indices[0], style.language, _picture_style(solution, style)
    )
    return plans_viewed(solution, ways, position_indices, style)


def plans_viewed(
    solution: Solution,
    pictures: Sequence[Block],
    position_indices: Sequence[int],
    style: BlockStyle,
    more: Sequence[str] = (),
) -> Block:
    """Return the plans of some positions, in several layouts, under their name.

    ``more`` are lines under the scale.
    """
    kind = style.entry.of
    assert kind is not None
    blocks = [
        with_scale(solution, kind, picture, style, position_indices, more) for picture in pictures
    ]
    scale, by_hand = solution.scales[kind], not style.options.errors
    return make_alternatives(
        PlanViewBlock(block, kind.value, scale, solution, kind, tuple(position_indices), by_hand)
        for block in blocks
    )


def plan_with_details(
    solution: Solution,
    kind: PlanKind,
    index: int,
    language: Language,
    style: PictureStyle,
) -> list[Block]:
    """Return a plan with its enlarged views, in all layouts, the smallest first."""
    knots, by_hand = solution.detail_views_at(kind, index), not style.errors
    letter_height = style.letter_height
    letters = tuple(detail_view_letter(detail_view, language) for detail_view in knots)
    picture = plan_picture(solution, kind, index, style, use_ruler=by_hand, detail_letters=letters)
    if style.hatched:
        picture = with_hatching(
            picture, similar_triangles(solution, kind, index, use_ruler=by_hand)
        )
    if not knots:
        return [picture]
    pictures = detail_pictures(
        solution, kind, index, letter_height=letter_height, use_ruler=by_hand, whole=picture
    )
    larger = letter_of_view(letter_height)
    views = [
        Column([Line(typeset(view_name(detail_view, language), larger)), one], 2.5, "centre")
        for detail_view, one in zip(knots, pictures, strict=True)
    ]
    ways: list[Block] = []
    for step in range(1, len(views) + 1):
        found = range(0, len(views), step)
        rows = Column([Row(views[k : k + step], 8.0, "centre") for k in found], 6.0, "centre")
        ways.append(Row([picture, rows], 8.0, "centre"))
        ways.append(Column([picture, rows], 6.0, "centre"))
    return sorted(ways, key=lambda way: way.width * way.height)


def shown_position(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> int:
    """Return the representative position: the requested or calculated one, else the clearest."""
    for asked in (style.entry.position, solution.problem.calculated):
        if asked is not None and asked in position_indices:
            return asked
    return (
        position_indices[0]
        if len(position_indices) == 1
        else clearest_position(solution, tuple(position_indices))
    )


def position_text(solution: Solution, index: int, notation: Notation) -> str:
    """Return the text of a driver position: an angle within one turn, two decimals.

    If all are within a turn, negative angles stay negative.
    """
    value = float(solution.positions[index])
    if not solution.problem.drive.goes_round:
        return notation.as_input(value)
    if value in solution.problem.numbered:
        return notation.as_input(solution.problem.display_position(value))
    if value < 0.0 and (np.abs(solution.positions) < 360.0).all():
        return notation.as_input(round(value, 2))
    return notation.crank_angle(value)


def drawn_positions(
    solution: Solution, position_indices: Sequence[int], style: BlockStyle
) -> tuple[list[int], list[str]]:
    """Return the positions in proportion to others, or requested, and notes on those left out."""
    drawable = solution.origin.extents.drawable
    asked = (style.entry.position, solution.problem.calculated)
    found = [index for index in position_indices if drawable[index] or index in asked]
    drawn = found or list(position_indices)
    note = style.language.sheets.position_not_drawn
    return drawn, [note.format(number=i) for i in position_indices if i not in drawn]


def positions_on_scheme(
    solution: Solution, drawn: Sequence[int], main: int, language: Language
) -> tuple[list[int], list[str]]:
    """Return those of the drawn positions that the scheme shows, and a note on the others.

    The main one is always there.
    """
    near = solution.origin.extents.on_scheme
    shown = [index for index in drawn if near[index] or index == main]
    far = [str(index) for index in drawn if index not in shown]
    one, many = language.sheets.position_too_far, language.sheets.positions_too_far
    note = one if len(far) == 1 else many
    return shown, [note.format(numbers=", ".join(far))] if far else []


def with_scale(
    solution: Solution,
    kind: PlanKind,
    picture: Block,
    style: BlockStyle,
    drawn: Sequence[int],
    more: Sequence[str] = (),
) -> Column:
    """Return a picture of the ``drawn`` positions with its name and scale.

    ``more`` are lines under the scale.
    """
    language = style.language
    one, many = language.sheets["views"][kind.value]
    title = style.entry.title or (one if len(drawn) == 1 else many)
    said = []
    if solution.has_common(kind):
        said.append(
            scale_inscription(
                solution.scales[kind], solution.problem.scales.convention, language.notation
            )
        )
    said += more
    by_hand = not style.options.errors
    if kind is not PlanKind.POSITION and any(
        has_vectors_apart(solution, kind, index, use_ruler=by_hand) for index in drawn
    ):
        said.append(language.sheets.apart)
    if kind is not PlanKind.POSITION and len(solution.positions) > 1:
        said += _named_by_ends(solution, kind, drawn, _series_style(style.options.errors), language)
    if style.options.errors:
        of_scheme = kind is PlanKind.POSITION  # which has ellipses in one position only
        shown = (shown_position(solution, drawn, style),) if of_scheme else drawn
        said += ellipse_inscription(solution, kind, shown, language)
    return named(picture, title, said, style)


def at_scales(views: Iterable[ViewBlock]) -> Block:
    """Return a view with layouts at several scales, the usual one first."""
    found: dict[Scale | None, ViewBlock] = {}
    for way in views:
        found.setdefault(way.scale, way)
    return make_alternatives(found.values(), grows=True)


def named(
    picture: Block,
    title: str,
    notes: Iterable[str | Block],
    style: BlockStyle,
    *,
    is_wrapped: bool = False,
) -> Column:
    """Return a picture under its name and notes, in the letters of a style: see `titled`."""
    heights = style.title, style.text(style.sizes.text)
    return titled(picture, title, notes, heights, is_wrapped=is_wrapped)


CAPTION = 3.5
"""Height of the letters of one of many plans, and of its caption, mm."""


def scheme_views(
    solution: Solution, position_indices: Sequence[int], style: BlockStyle
) -> ViewBlock:
    """Return the scheme of many positions: one in full, the others thin."""
    bold, kind = shown_position(solution, position_indices, style), PlanKind.POSITION
    drawn, left_out = drawn_positions(solution, position_indices, style)
    shown, far = positions_on_scheme(solution, drawn, bold, style.language)
    own = _picture_style(solution, style)

    def draw(added: tuple[tuple[Item, ...], tuple[Label, ...]]) -> Picture:
        if len(position_indices) == 1:
            return scheme_picture(solution, bold, own, added=added)
        overlay = tuple(shown)
        return series_picture(solution, bold, overlay, own, turn=style.options.turn, added=added)

    picture = _with_triangles(solution, bold, own, draw)
    said = [*_extremes(solution, position_indices, style), *left_out, *far]
    block = with_scale(solution, kind, picture, style, position_indices, said)
    return ViewBlock(block, kind.value, solution.scales[kind])


def _extremes(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> list[str]:
    """Return the notes on the extreme positions of a scheme that shows both."""
    if not shows_extremes(solution, position_indices):
        return []
    paths = Paths(solution)
    if paths.output is None or len(paths.extremes) < len(POSITION_PRIMES):
        return []
    letter = point_name(paths.output[1])
    names = ", ".join(f"{letter}{prime}" for prime in POSITION_PRIMES)
    whole = paths.driver_path.closed and solution.problem.drive.revolves and not style.options.turn
    return extremes_named(crank_cycle_of(solution) if whole else None, names, style.language)


def plan_views(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the plans of several positions in rows, drawn like those of one."""
    kind = style.entry.of
    assert kind is not None
    if style.entry.position is not None:
        position_indices = (style.entry.position,)
    drawn, left_out = drawn_positions(solution, position_indices, style)
    alike, errors = _group_repeated(solution, drawn), style.options.errors
    pictures = plan_grid(
        solution, kind, alike, style.language, in_row=style.entry.per_row,
        errors=errors, hatched=style.entry.hatched,
    )  # fmt: skip
    return plans_viewed(solution, pictures, tuple(alike), style, left_out)


def _group_repeated(solution: Solution, position_indices: Sequence[int]) -> dict[int, list[int]]:
    """Return positions with those of the cycle's second turn at the same crank angle."""
    found: dict[float, list[int]] = {}
    two = solution.repeated > 1 and solution.problem.drive.goes_round
    for i in position_indices:
        place = round(float(solution.positions[i]) % 360.0, 6) % 360.0 if two else float(i)
        found.setdefault(place, []).append(i)
    return {numbers[0]: numbers for numbers in found.values()}


def _series_style(errors: bool) -> PictureStyle:
    """Return the style of the plans of several positions."""
    return PictureStyle(CAPTION, errors)


def _named_by_ends(
    solution: Solution,
    kind: PlanKind,
    drawn: Sequence[int],
    style: PictureStyle,
    language: Language,
) -> list[str]:
    """Return the line that explains vectors and lines on plans without the names of vectors.

    Each component that is drawn there has an example: its ends, its symbol and its name.
    """
    plan, by_hand = solution.construction.plan(kind), not style.errors
    if names_all_vectors(solution, kind, style):
        return []
    letters, words = plan_letters(solution.problem, plan), language.sheets
    places = [plan_places(solution, kind, index, use_ruler=by_hand) for index in drawn]

    def is_drawn(tail: PointName, head: PointName) -> bool:
        return any(abs(at[head] - at[tail]) >= SHORTEST_NAMED for at in places)

    found: dict[str, str] = {}
    for vector in plan.vectors:
        name = words["components"][kind.value][vector.kind.value]
        if name not in found and is_drawn(vector.tail, vector.head):
            ends = letters[vector.tail][0] + letters[vector.head][0]
            told = words.by_ends_of.format(ends=ends, vector=vector_markup(vector.symbol))
            found[name] = f"{told}, {name}".replace(" ", NBSP)
    if not found:
        return []
    told = words.by_ends.format(vectors="; ".join(found.values()))
    similar = any(is_drawn(*side) for side in similar_lines(solution, plan))
    return [f"{told}; {words.without_arrow}" if similar else told]


def plan_grid(
    solution: Solution,
    kind: PlanKind,
    positions: Mapping[int, Sequence[int]],
    language: Language,
    *,
    in_row: int | None = None,
    errors: bool = False,
    hatched: bool = False,
) -> list[Block]:
    """Return the plans of many positions in rows and columns, each with its number.

    ``positions`` has for each of them the numbers of all that share its plan. There is a layout for
    each number of plans in a row, the usual one first; ``in_row`` selects one.
    """
    coordinate, notation = solution.problem.drive.coordinate, language.notation
    cells: list[Block] = []
    common, style = solution.has_common(kind), _series_style(errors)
    named = names_all_vectors(solution, kind, style)
    style = replace(style, named=named, hatched=hatched)
    convention = solution.problem.scales.convention
    for i, own_numbers in positions.items():
        unit = notation.units[coordinate.unit]
        places = dict.fromkeys(position_text(solution, k, notation) for k in own_numbers)
        values = ", ".join(with_unit(place, unit) for place in places)
        phrase = f"{', '.join(map(str, own_numbers))}: {coordinate.symbol} = {values}"
        own = solution.plan_scale(kind, i)
        caption: Block = Line(typeset(phrase, CAPTION))
        if own != solution.scales[kind] or not common:
            scale = Line(typeset(scale_inscription(own, convention, notation), CAPTION))
            caption = Column([caption, scale], gap=2.0, align="centre")
        picture, *_ = plan_with_details(solution, kind, i, language, style)
        cells.append(Column([picture, caption], gap=3.0, align="centre"))
    count, usual = len(cells), in_row or per_row(len(cells))
    steps = (usual,) if in_row else (usual, 4, 3, 2, 1) if count <= FEW else (usual, 4, 3)
    return [_rows(cells, step) for step in dict.fromkeys(min(step, count) for step in steps)]


def _rows(cells: Sequence[Block], step: int) -> Block:
    """Return blocks in rows of ``step``, in columns if these are not much wider."""
    columns = column_widths([cell.width for cell in cells], step)
    if columns:
        wide = [Spacer(width, 0.0) for width in columns]
        cells = [Column([c, wide[k % step]], 0.0, "centre") for k, c in enumerate(cells)]
    found = range(0, len(cells), step)
    return Column([Row(cells[k : k + step], gap=BETWEEN, align="bottom") for k in found], BETWEEN)


NARROW = 0.7
"""Part of the usual width for a narrower layout of a text."""


def statement_block(
    solution: Solution, position_indices: Sequence[int], style: BlockStyle
) -> Block:
    """Return "Дано" and "Определить"."""
    facts = given_facts(solution.problem, style.language, list(solution.positions))
    wanted = style.language.sheets.wanted.format(wanted=motion_unknowns(solution))
    shown = " ".join(figure_sentences(solution, style.language))
    return stated(facts, wanted, style, *([shown] if shown else []))


def stated(facts: Sequence[GivenFact], task: str, style: BlockStyle, *more: str) -> Block:
    """Return "Дано" with its facts, the task, and further paragraphs, in two widths."""
    height, column = style.text(style.sizes.text), style.width(style.sizes.column)
    told = unbroken(fact.text for fact in facts)
    texts = [style.language.note.given.format(given=told), task, *more]
    ways = []
    for width in (column, NARROW * column):
        lines: list[Block] = [paragraph(text, height, width=width) for text in texts]
        if style.entry.title:
            lines.insert(0, heading(style.entry.title, height, width=width))
        ways.append(Column(lines, gap=3.0))
    return Alternatives(tuple(ways))


def equations_block(
    solution: Solution, position_indices: Sequence[int], style: BlockStyle
) -> Block:
    """Return the vector equations of a plan, one under another."""
    kind = style.entry.of
    assert kind is not None
    size = style.text(style.sizes.text)
    height, width = max(3.5, min(5.0, size)), style.width(style.sizes.column)
    title = heading(style.entry.title or style.language.sheets["equations"][kind.value], size)
    directed = partial(direction_text, notation=style.language.notation)
    known = known_directions(solution.construction, solution.problem, kind)
    stated = stated_equations(solution.construction, solution.problem, kind)
    equations = Equations(tuple(one.written(directed, known) for one in stated))
    return Column([title, *blocks_of([equations], height, width=width)], gap=4.0)


def calculation_block(
    solution: Solution, position_indices: Sequence[int], style: BlockStyle
) -> Block:
    """Return the formulas with the read segments, of one position only."""
    kind = style.entry.of
    assert kind is not None
    index = shown_position(solution, position_indices, style)
    height = style.text(min(3.5, style.sizes.text))
    texts = style.language.sheets
    title = style.entry.title or texts["calculation"][kind.value]
    if len(solution.positions) > 1:
        title = texts.of_position.format(title=title, number=index)
    lines = map(Formula, calculation(solution, kind, index, style.language))
    blocks = list(blocks_of([Caption(title), *lines], height))
    whole, half = Column(blocks, gap=2.2), -(-len(blocks) // 2)
    columns = [Column(some, gap=2.2) for some in (blocks[:half], blocks[half:])]
    return Alternatives((whole, Row(columns, gap=2.0 * height)))


def text_block(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return a text of the composition itself."""
    height, width = style.text(style.sizes.text), style.width(style.sizes.column)
    lines: list[Block] = [paragraph(style.entry.text, height, width=width)]
    if style.entry.title:
        lines.insert(0, heading(style.entry.title, height, width=width))
    return Column(lines, gap=3.0)
