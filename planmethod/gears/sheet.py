"""Sheet of a train: both views of the scheme, both diagrams, formulas, tables (лист передачи)."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import chain, islice, pairwise, product
from typing import TYPE_CHECKING

from msgspec import Struct
from msgspec.structs import replace

from planmethod.construct.drafting import Profile
from planmethod.construct.scale import Scale, series_near
from planmethod.errors import LayoutError
from planmethod.gears.comparison import PlanetaryComparison, compare
from planmethod.gears.construction import GearDrawing, GearReading, construct, read
from planmethod.gears.model import DiagramSettings, GearProblem, MeshKind
from planmethod.gears.motion import TrainMotion, draw, solve_motion
from planmethod.gears.scheme import ColumnOrder, SchemeData, arrange, best_order, scheme_parts
from planmethod.gears.sheet_texts import calculation, results, train_facts
from planmethod.gears.side_view import SideView
from planmethod.gears.text import compared_sentences, compared_table, no_diagrams
from planmethod.gears.velocities import by_velocities
from planmethod.gears.views import (
    RAYS_POLE,
    PointVelocity,
    angular,
    angular_spans,
    enlarged_rays,
    enlarged_velocity,
    front,
    linear,
    linear_spans,
    linear_views,
    ray_views,
)
from planmethod.languages import LANGUAGES, translate
from planmethod.note.formula import Rich
from planmethod.note.narrate.naming import detail_view_letter, view_name
from planmethod.note.narrate.statement import unbroken
from planmethod.note.numbers import half_up
from planmethod.note.wording import Language, MessageTable, get_language
from planmethod.paper import DEFAULT_SERIES, STAMP_WIDTH
from planmethod.render.frame import Furniture
from planmethod.render.ink.drawing import Arc, Disc, Drawing, Item, Span, View, shifted
from planmethod.render.ink.pens import PenSet
from planmethod.render.ink.typeset import ink_bounds, typeset
from planmethod.render.labels import Label
from planmethod.render.layout.block import (
    TITLE_WIDTH,
    Block,
    Column,
    Line,
    Picture,
    Row,
    heading,
    paragraph,
)
from planmethod.render.layout.formula_blocks import formula_blocks
from planmethod.render.layout.groups import Group, LayoutItem
from planmethod.render.layout.pack import largest_hole
from planmethod.render.layout.text_blocks import TableColumn, TableForm, table_block
from planmethod.render.pictures.lettered import ENLARGED, lettered
from planmethod.render.sheets.composer import (
    NoFitAdvice,
    Packing,
    SheetLayout,
    Sizes,
    TrialPaper,
    ViewBlock,
    compose,
    find_layout,
    view_of,
)

if TYPE_CHECKING:
    from planmethod.options import PlanRequest
    from planmethod.solved.legibility import DetailView

TARGETS = (210.0, 165.0, 130.0, 105.0, 85.0, 65.0)
"""Target heights of the scheme, mm, for scales that the sheet chooses."""

MIN_TARGET, MAX_A3 = 85.0, 130.0
"""The least of these where a larger paper can be taken, the most on A3, mm."""

MIN_HEIGHT, MAX_HEIGHT = 75.0, 260.0
"""Heights of the scheme, mm, between which the scale of the file is kept."""

WIDEST, WIDEST_A3 = 240.0, 170.0
"""Widths of the angular velocity diagram above which the sheet chooses a coarser scale, mm."""

MAX_FRONT = 130.0
"""Height of the view along the axes, mm, where it has a coarser scale than the side view."""

WIDTHS = (STAMP_WIDTH - 10.0, 140.0)
"""Widths of the texts, mm."""

POLES = ((90, 1.0), (75, 1.0), (60, 1.0), (60, 1.5), (75, 1.5), (90, 1.5))
"""Pole distances of the rays, mm, each with a factor of the widest diagram."""

LOW_POLES = tuple((pole, 1.0) for pole in (50, 40, 30, 25, 20, 15, 10))
"""Those that are tried when the diagrams with the others fit no paper but the largest."""

READABLE = 55.0
"""Least pole distance of the former, mm: the slopes of the rays are then read."""

COLUMN_PARTS = (1.2, 2.2, 1.1, 1.1, 0.7, 0.8)
"""Widths of the columns of the results, in parts."""

GAP = 12.0
"""Space between the side view and the diagram beside it, mm."""


def drawings(problem: GearProblem, request: PlanRequest) -> list[Drawing]:
    """Draw the sheet of a train (лист зубчатого механизма).

    Raises
    ------
    ProblemError
        The train cannot be, or its inputs do not fit.
    LayoutError
        It does not fit the paper.
    """
    strategy = _Train(problem, solve_motion(problem), request.profile)
    furniture = Furniture.of(problem.sheet, before=request.before, total=request.total)
    return compose(
        problem, strategy, _no_space_advice(strategy), fields=request.fields, furniture=furniture
    )


def inscribe_scale(language: Language, key: str, value: float, **more: str) -> Rich:
    """Return the inscription of a scale of the diagrams: ``mu_l``, ``mu_v`` or that of the rays."""
    phrase: Rich = language.gears["sheet"]["inscriptions"][key]
    return phrase.format(value=language.notation.short(value, 4), **more)


def as_drawn(problem: GearProblem, profile: Profile) -> TrainMotion:
    """Return the motion of a train with the scales that its sheet has: so a picture is read once.

    Where the train fits no paper, the scales are those of the file.

    Raises
    ------
    ProblemError
        The train cannot be, or its inputs do not fit.
    """
    motion = solve_motion(problem)
    if draw(motion) is None:
        return motion
    strategy = _Train(problem, motion, profile)
    try:
        _, laid = find_layout(
            problem, strategy, _no_space_advice(strategy), Furniture.of(problem.sheet)
        )
    except LayoutError:
        return motion
    scales = {name: Fraction(repr(value)) for name, value in laid.scales.items()}
    settings = replace(motion.train.picture, **scales)
    return replace(motion, train=replace(motion.train, picture=settings))


def _no_space_advice(strategy: _Train) -> NoFitAdvice:
    wheels = len(strategy.motion.train.wheels)
    return NoFitAdvice(
        lambda paper, advice: LayoutError(
            "{}: the sheet of {} wheels does not fit {}. {}",
            strategy.problem.name,
            wheels,
            paper,
            advice,
        ),
        translate("Request fewer quantities in gears.ask."),
    )


def draw_views(
    motion: TrainMotion, profile: Profile, language: Language, sizes: Sizes
) -> tuple[Block, Block | None]:
    """Return the side view with the linear velocity diagram, and the angular one."""
    settings = motion.train.picture
    scheme = SchemeData(motion, float(motion.train.unit_m / settings.mu_l))
    order = None if scheme.undrawn else best_order(scheme)
    sheet = _Sheet(motion, settings, profile, language, sizes, order, None)
    return sheet.views()


class _Train(Struct, frozen=True):
    """Search for the layout of the sheet of a train, by the scale of the side view."""

    problem: GearProblem
    motion: TrainMotion
    profile: Profile

    formats = DEFAULT_SERIES

    def proposals(self, papers: Sequence[TrialPaper]) -> Iterator[_Grown]:
        """Yield the blocks at a scale in several orders of reading, paper by paper."""
        made: dict[tuple[PenSet, DiagramSettings, Sizes], list[tuple[LayoutItem, ...]]] = {}
        language = get_language(self.problem.sheet.lang or LANGUAGES[0])
        train, compared = self.motion.train, compare(self.problem, self.motion)
        plain = SchemeData(self.motion, float(train.unit_m / train.picture.mu_l))
        order = None if plain.undrawn else best_order(plain)
        for paper, settings, sizes in self._scales(papers):
            notation = self.problem.sheet.notation
            sheet = _Sheet(
                self.motion, settings, self.profile, language, sizes, order, notation, compared
            )
            with paper.using_pens() as pens:
                if (pens, settings, sizes) not in made:
                    made[pens, settings, sizes] = list(sheet.orders())
            for number, parts in enumerate(made[pens, settings, sizes]):
                yield _Grown(paper, sheet, number, parts)

    def _scales(
        self, papers: Sequence[TrialPaper]
    ) -> Iterator[tuple[TrialPaper, DiagramSettings, Sizes]]:
        """Yield papers and scales: first the scale of the file, where the scheme suits it."""
        stages = (papers,) if papers[-1].is_required else (papers[:-1], papers[-1:])
        for some, poles in product(stages, (POLES, LOW_POLES)):
            for paper, settings, sizes in self._scales_on(some):
                tried = _with_pole(self.motion, settings, paper, poles)
                if tried is not None:
                    yield paper, tried, replace(sizes, title=min(sizes.title, paper.title))

    def _scales_on(
        self, papers: Sequence[TrialPaper]
    ) -> Iterator[tuple[TrialPaper, DiagramSettings, Sizes]]:
        """Yield scales for papers, the larger ones first."""
        motion, asked = self.motion, papers[-1].is_required
        own = motion.train.picture
        extent = _extent(motion) * float(motion.train.unit_m)
        if MIN_HEIGHT <= extent / float(own.mu_l) <= MAX_HEIGHT:
            yield from ((paper, own, USUAL) for paper in papers)
        for sizes, paper in product((USUAL, DENSE) if asked else (USUAL,), papers):
            for target in TARGETS:
                most = MAX_A3 if paper.name == "A3" else TARGETS[0]
                if not (asked or MIN_TARGET <= target <= most):
                    continue
                mu_l = series_near(extent / target, up=True)
                if (
                    not asked and extent / mu_l < MIN_HEIGHT
                ):  # from 5 to 10 the series makes a wide step
                    mu_l = series_near(extent / target, up=False)
                yield paper, replace(own, mu_l=Fraction(repr(mu_l))), sizes


def _with_pole(
    motion: TrainMotion,
    settings: DiagramSettings,
    paper: TrialPaper,
    poles: Iterable[tuple[int, float]],
) -> DiagramSettings | None:
    """Return scales with the first pole distance that keeps the rays within a width; None if none.

    Of a train without diagrams, and with the file's pole distance, the scales are as they are.
    """
    widest = WIDEST_A3 if paper.name in ("A3", "A4") else WIDEST
    least = 0.0 if poles is LOW_POLES else READABLE
    for pole, factor in poles:
        tried = replace(settings, near_mm=Fraction(pole))
        picture = draw(motion, tried)
        if picture is None or settings.pole_mm is not None:
            return settings
        ends = [Fraction(0), *(segment for _, segment in picture.rays)]
        if max(ends) - min(ends) <= factor * widest and picture.pole_mm >= least:
            return tried
    return tried if poles is LOW_POLES else None


def _extent(motion: TrainMotion) -> float:
    """Return how high the scheme is, in sizes: that of its highest part."""
    heights = []
    for part in scheme_parts(motion):
        scheme = SchemeData(part, 1.0)
        if scheme.undrawn:
            return 100.0
        rims = [rim for column in scheme.columns for rim in column]
        rims += [cone.rim for one in scheme.transverse_bodies for cone in one.cones]
        ends = [rim.centre + way * rim.reach(way) for rim in rims for way in (1, -1)]
        heights.append(max(ends) - min(ends) if ends else 100.0)
    return max(heights)


GROWN = {"longest_mm": 130, "near_mm": 120}
"""Sizes of the diagrams that grow into the free paper, mm, and how large they become."""

GROWTH = Fraction(6, 5)
"""Factor of one step of this growth."""


class _Grown(Struct, frozen=True):
    """Blocks in one order of reading, whose diagrams grow into the free paper (`Proposal`)."""

    paper: TrialPaper
    sheet: _Sheet
    number: int
    parts: tuple[LayoutItem, ...]

    def arrange(self) -> SheetLayout | None:
        """Return the sheet with the largest diagrams that fit, or None."""
        settings = self.sheet.settings
        laid = self._with_settings(self.parts, settings)
        if laid is None or draw(self.sheet.motion, settings) is None:
            return laid
        growing = [key for key in GROWN if key not in settings.file_keys]
        if settings.pole_mm is not None:
            growing.remove("near_mm")
        while growing:
            key = growing.pop(0)
            size = GROWTH * getattr(settings, key)
            if size > GROWN[key]:
                continue
            tried = replace(settings, **{key: size})
            orders = replace(self.sheet, settings=tried).orders()
            *before, own = islice(orders, self.number + 1)  # the order stays where it fits
            each = chain([own], before, orders)
            fitting = (self._with_settings(parts, tried) for parts in each)
            larger = next((one for one in fitting if one and self._is_filled(one, laid)), None)
            if larger is not None:
                laid, settings = larger, tried
                growing.append(key)
        return laid

    def _is_filled(self, layout: SheetLayout, old: SheetLayout) -> bool:
        """Return whether no hole is larger, no row higher and no view of wheels smaller."""

        def measured(each: SheetLayout) -> tuple[float, float, float]:
            placed = each.pages[0].placed
            rise = max(corner.imag for _, corner in placed) - placed[0][1].imag
            views = [one for one, _ in placed if isinstance(one, ViewBlock)]
            scales = [one.scale.per_mm for one in views if one.scale and one.name == "position"]
            return largest_hole(placed, self.paper.drawing_area()), rise, max(scales, default=0.0)

        pairs = zip(measured(layout), measured(old), strict=True)
        return all(new <= before + 1e-9 for new, before in pairs)

    def _with_settings(
        self, parts: tuple[LayoutItem, ...], settings: DiagramSettings
    ) -> SheetLayout | None:
        scales = {key: float(getattr(settings, key)) for key in ("mu_l", *GROWN)}
        return Packing(self.paper, (Group(parts),), scales=scales).arrange()


USUAL = Sizes(5.0, 7.0, 3.5, STAMP_WIDTH)
"""Sizes of letters and tables."""

DENSE = Sizes(3.5, 3.5, 2.5, STAMP_WIDTH, row=5.5)
"""Sizes where the format was specified and larger ones do not fit."""


class _MeasuredView(ViewBlock, frozen=True):
    """A view of the train; its segments are known from its upper left corner."""

    measured: Sequence[Span]

    def spans(self, items: Sequence[Item], corner: complex) -> Iterator[Span]:
        """Yield the segments at their places on the sheet."""
        for one in self.measured:
            yield replace(one, start=one.start + corner, end=one.end + corner)


class _Rays(ViewBlock, frozen=True):
    """The angular velocity diagram with its detail views."""

    drawn: GearDrawing
    reading: GearReading

    def spans(self, items: Sequence[Item], corner: complex) -> Iterator[Span]:
        """Yield the segments at their places on the sheet."""
        (pole,) = (one.centre for one in items if isinstance(one, Disc) and one.tag == RAYS_POLE)
        views = [
            next(item.centre for item in items
                 if isinstance(item, Arc) and item.tag == f"{ENLARGED} {detail_view.number}")
            for detail_view in ray_views(self.reading)
        ]  # fmt: skip
        yield from angular_spans(self.drawn, self.reading, pole, views)


class _Strip(_MeasuredView, frozen=True):
    """The side view, and beside it the measured linear velocity diagram."""

    diagram_scale: Scale
    at: float  # where it begins, mm from the left

    def views(self, items: Sequence[Item], corner: complex) -> list[View]:
        """Return both views."""
        low, high = corner.imag - self.height, corner.imag
        edges = (corner.real, corner.real + self.at, corner.real + self.width)
        scheme, velocities = ((left, low, right, high) for left, right in pairwise(edges))
        return [
            view_of(self.name, self.scale, scheme, ()),
            view_of("velocity", self.diagram_scale, velocities, self.spans(items, corner)),
        ]


class _Sheet(Struct, frozen=True):
    """Blocks of a sheet."""

    motion: TrainMotion
    settings: DiagramSettings
    profile: Profile
    language: Language
    sizes: Sizes
    order: ColumnOrder | None
    pair_notation: str | None
    compared: PlanetaryComparison | None = None

    def orders(self) -> Iterator[tuple[LayoutItem, ...]]:
        """Yield the blocks in orders of reading; the last is placed on the title block."""
        picture = draw(self.motion, self.settings)
        drawn = None if picture is None else construct(self.motion, picture)
        seen = None if drawn is None else read(drawn, self.profile)
        scheme = SchemeData(self.motion, float(self.motion.train.unit_m / self.settings.mu_l))
        strip, results = LayoutItem(self._strip(scheme, drawn, seen)), self._results(drawn, seen)
        last = LayoutItem(results if self.compared is None else self._compared(self.compared))
        shown = [] if drawn is None or seen is None else [
            LayoutItem(self._angular(drawn, seen)),
            LayoutItem(self._segments(drawn, seen), text=True),
        ]  # fmt: skip
        for view, width in product(self._fronts(drawn), WIDTHS):
            views = [strip] if view is None else [strip, LayoutItem(view)]
            texts = [LayoutItem(self._calculation_block(width), text=True)]
            if self.compared is not None:  # as wide as the title block, on which it is placed
                texts.append(LayoutItem(results, text=True))
            if not shown:
                yield (*views, *texts, last)
                continue
            rays = shown[0]
            texts.insert(1, shown[1])
            yield (*views, rays, *texts, last)
            yield (*views, *texts, rays, last)
            yield (strip, *texts, *views[1:], rays, last)
            yield (strip, rays, *views[1:], *texts, last)

    def views(self) -> tuple[Block, Block | None]:
        """Return the side view with the linear velocity diagram, and the angular one."""
        picture = draw(self.motion, self.settings)
        drawn = None if picture is None else construct(self.motion, picture)
        seen = None if drawn is None else read(drawn, self.profile)
        scheme = SchemeData(self.motion, float(self.motion.train.unit_m / self.settings.mu_l))
        strip = self._strip(scheme, drawn, seen)
        return strip, None if drawn is None or seen is None else self._angular(drawn, seen)

    # Views ---------------------------------------------------------------------------------------

    def _head(self, title: str, width: float, *scales: str) -> Block:
        wrapped = max(width, TITLE_WIDTH * self.sizes.title)
        lines: list[Block] = [paragraph(title, self.sizes.title, wrapped)]
        lines += [Line(typeset(scale, self.sizes.text)) for scale in scales]
        return Column(lines, gap=2.5)

    def _scale(self, key: str, value: float, **more: str) -> str:
        return inscribe_scale(self.language, key, value, **more)

    def _strip(
        self, scheme: SchemeData, drawn: GearDrawing | None, reading: GearReading | None
    ) -> Block:
        """Return the side view and, at the same heights, the linear velocity diagram."""
        texts: MessageTable = self.language.gears["sheet"]
        if scheme.undrawn:
            parts = scheme_parts(self.motion)
            if parts[1:]:
                return self._parts(parts)
            kinds = ", ".join(texts["kinds"][kind] for kind in scheme.undrawn)
            return paragraph(texts.no_scheme.format(kinds=kinds), self.sizes.text, STAMP_WIDTH)
        spots = () if drawn is None else drawn.spots
        side = SideView(arrange(scheme, self.order), {spot.contact: spot.letter for spot in spots})
        items, labels = side.items(), list(side.labels(self.sizes.letter))
        left, _, right, _ = ink_bounds(items)
        mu_l = self._scale("mu_l", float(self.settings.mu_l))
        heads = [(self._head(texts.scheme, right - left, mu_l), (left + right) / 2)]
        middle = right
        origin = 0.0
        if drawn is not None and reading is not None:
            own = linear_views(reading)
            letters = [detail_view_letter(one, self.language) for one in own]
            lines, named = linear(drawn, reading, self.sizes.letter, letters)
            box = ink_bounds(lines)
            mu_v = self._scale("mu_v", drawn.diagrams.mu_v)
            head = self._head(texts.linear, box[2] - box[0], mu_v)
            room = max(0.0, (head.width - (box[2] - box[0])) / 2)
            end = max(right, heads[0][1] + heads[0][0].width / 2)
            origin = end + GAP + room - box[0]
            middle = end + GAP / 2
            items += [*side.projections(origin), *shifted(lines, origin)]
            labels += [_shift_label(label, origin) for label in named]
            heads.append((head, origin + (box[0] + box[2]) / 2))
        whole = lettered(items, labels)
        top = whole.bounds[3] + 5.0 + max(head.height for head, _ in heads)
        titles = [
            item for head, x in heads for item in head.place(complex(x - head.width / 2, top))
        ]
        placed = [*whole.items, *titles]
        centres: dict[int, complex] = {}
        if drawn is not None and reading is not None and linear_views(reading):
            pictures = self._enlarged(drawn, reading, linear_views(reading), enlarged_velocity)
            beside_it = Column(pictures, 6.0, "centre")
            corner = complex(ink_bounds(placed)[2] + GAP, whole.bounds[3])
            added = beside_it.place(corner)
            placed += added
            for item in added:
                if isinstance(item, Arc) and item.tag.startswith(f"{ENLARGED} "):
                    centres[int(item.tag.split()[1])] = item.centre
        bounds = ink_bounds(placed)
        bounds = (min(bounds[0], heads[0][1] - heads[0][0].width / 2), *bounds[1:])
        x, y = -bounds[0], -bounds[3]
        strip, mu = Picture(tuple(placed), bounds), Scale("mu_l", float(self.settings.mu_l), "m")
        if drawn is None or reading is None:
            return ViewBlock(strip, "position", mu)
        shift = complex(x, y)
        views = {number: at + shift for number, at in centres.items()}
        spans = linear_spans(drawn, reading, origin + shift, views)
        beside = Scale("mu_v", drawn.diagrams.mu_v, "m/s")
        return _Strip(strip, "position", mu, tuple(spans), beside, middle + x)

    def _parts(self, parts: Sequence[TrainMotion]) -> Block:
        """Return the views of a train whose axes are not in one plane, each with its meshes."""
        mm = float(self.motion.train.unit_m / self.settings.mu_l)
        views = []
        for part in parts:
            scheme = SchemeData(part, mm)
            side = SideView(arrange(scheme), {})
            pictures = [lettered(side.items(), list(side.labels(self.sizes.letter)))]
            if any(mesh.kind not in (MeshKind.BEVEL, MeshKind.WORM) for mesh in part.train.meshes):
                pictures.append(front(scheme, self.sizes.letter, self._planets()))
            name = ", ".join(mesh.name for mesh in part.train.meshes)
            label = Line(
                typeset(self.language.gears["sheet"].part.format(names=name), self.sizes.text)
            )
            views.append(Column([Row(pictures, 2 * GAP, "centre"), label], 4.0, "centre"))
        mu_l = self._scale("mu_l", float(self.settings.mu_l))
        row = Row(views, 2 * GAP, "bottom")
        head = self._head(self.language.gears["sheet"].scheme, row.width, mu_l)
        scale = Scale("mu_l", float(self.settings.mu_l), "m")
        return ViewBlock(Column([head, row], 5.0, "centre"), "position", scale)

    def _fronts(self, drawn: GearDrawing | None) -> Iterator[ViewBlock | None]:
        """Yield the view along the axes at the scale of the side view, then at a coarser one.

        None where no axes are parallel.
        """
        if self._lacks_front_view():
            yield None
            return
        extent = _extent(self.motion) * float(self.motion.train.unit_m)
        own = float(self.settings.mu_l)
        coarse = series_near(extent / MAX_FRONT, up=True)
        for mu_l in (own, coarse) if coarse > own else (own,):
            scheme = SchemeData(self.motion, float(self.motion.train.unit_m) / mu_l)
            title = self.language.gears["sheet"].front
            scales = [self._scale("mu_l", mu_l)]
            moving = list(self._velocities(drawn, own / mu_l))
            if drawn is not None and moving:
                scales.append(self._scale("mu_v", drawn.diagrams.mu_v))
            view = front(scheme, self.sizes.letter, self._planets(), moving)
            yield self._titled(view, title, "position", Scale("mu_l", mu_l, "m"), scales)

    def _velocities(self, drawn: GearDrawing | None, factor: float) -> Iterator[PointVelocity]:
        """Yield the velocities of the method of instantaneous velocities, its letters with them.

        ``factor`` is the size of the view, compared with the side view.
        """
        if drawn is None or not by_velocities(self.motion, self.language):
            return
        for spot in drawn.spots:
            if spot.speed:
                letter, height = spot.letter.upper(), factor * float(spot.height)
                yield PointVelocity(letter, height, float(spot.speed))

    def _planets(self) -> Mapping[str, int]:
        """Return the number of planets of each carrier: from the file, else as compared."""
        train = self.motion.train
        common = (
            {} if self.compared is None else dict.fromkeys(train.carriers, self.compared.planets)
        )
        return {**common, **train.planets}

    def _lacks_front_view(self) -> bool:
        scheme = SchemeData(self.motion, 1.0)
        return bool(scheme.undrawn) or not scheme.columns

    def _titled(
        self,
        view: Picture,
        title: str,
        kind: str,
        scale: Scale,
        scales: Sequence[str],
    ) -> ViewBlock:
        """Return a view under its title."""
        head = self._head(title, view.width, *scales)
        return ViewBlock(Column([head, view], gap=5.0), kind, scale)

    def _angular(self, drawn: GearDrawing, reading: GearReading) -> ViewBlock:
        picture = drawn.diagrams
        pole = self.language.notation.as_input(half_up(float(picture.pole_mm), 2))
        name, per_mm = picture.ray_scale(self.motion.train.unit)
        scales = [self._scale(name, per_mm, pole=pole)]
        title, letter = self.language.gears["sheet"].angular, self.sizes.letter
        letters = [detail_view_letter(one, self.language) for one in ray_views(reading)]
        view = angular(drawn, reading, letter, letters)
        head = self._head(title, view.width, *scales)
        views = self._enlarged(drawn, reading, ray_views(reading), enlarged_rays)
        whole: Block = view
        if views:
            whole = Column([view, Row(views, 8.0, "centre")], gap=5.0, align="centre")
        block = Column([head, whole], gap=5.0)
        scale = Scale({"mu_omega": "mu_ω"}.get(name, name), per_mm, "1/s")
        return _Rays(block, "velocity", scale, drawn, reading)

    def _enlarged(
        self,
        drawn: GearDrawing,
        reading: GearReading,
        detail_views: Sequence[DetailView],
        picture: Callable[[GearDrawing, GearReading, DetailView, float], Picture],
    ) -> list[Block]:
        """Return detail views with their names and scales."""
        letter = self.sizes.letter
        return [
            Column(
                [Line(typeset(view_name(one, self.language), letter)),
                 picture(drawn, reading, one, letter)],
                2.5, "centre",
            )
            for one in detail_views
        ]  # fmt: skip

    # Texts ---------------------------------------------------------------------------------------

    def _calculation_block(self, width: float) -> Block:
        """Return the given data and the calculation."""
        facts = unbroken(fact.text for fact in train_facts(self.motion, self.language))
        text = self.language.note.given.format(given=facts)
        blocks: list[Block] = [paragraph(text, self.sizes.text, width)]
        blocks.append(heading(self.language.gears["sheet"].calculation, self.sizes.text))
        lines = calculation(self.motion, self.language, self.pair_notation, in_short=True)
        blocks += formula_blocks(lines, self.sizes.text, width=width)
        return Column(blocks, gap=2.4)

    def _compared(self, compared: PlanetaryComparison) -> Block:
        """Return the variants that the train is compared with."""
        lines = [
            paragraph(line, self.sizes.text, STAMP_WIDTH)
            for line in compared_sentences(compared, self.language)
        ]
        told = compared_table(compared, self.language)
        table = _table(told.head, told.rows, STAMP_WIDTH, self.sizes)
        title = heading(self.language.teeth["compared"]["title"], self.sizes.text)
        return Column([title, *lines, table], gap=2.5)

    def _segments(self, drawn: GearDrawing, reading: GearReading) -> Block:
        notation, rows, read_on = self.language.notation, [], drawn.read_on(reading.detail_views)
        on_views = drawn.spots_on(reading.detail_views)
        for spot in drawn.spots:
            length = float(spot.speed)
            knot = on_views.get(spot.end)
            letter = "" if knot is None else f", {detail_view_letter(knot, self.language)}"
            shown = (float(spot.height), length)
            text = (
                "—"
                if spot.read is None
                else notation.measured(float(reading.read.value[spot.read]))
            )
            rows.append((f"{spot.base}{spot.letter}{letter}", *map(self._mm, shown), text))
        for body, name in drawn.segments.items():
            exact, ruled = (float(trace.value[name]) for trace in (reading.exact, reading.read))
            view = (
                f", {detail_view_letter(read_on[body], self.language)}" if body in read_on else ""
            )
            rows.append(
                (f"o({drawn.label(body)}){view}", "—", self._mm(exact), notation.measured(ruled))
            )
        columns = self.language.gears["sheet"]["columns_segments"]
        table = _table(columns, rows, 27.0 * self.sizes.text, self.sizes)
        return Column(
            [Line(typeset(self.language.gears["sheet"].segments, self.sizes.text)), table], gap=2.5
        )

    def _mm(self, value: float) -> str:
        return self.language.notation.number(f"{value + 0.0:.2f}")

    def _results(self, drawn: GearDrawing | None, reading: GearReading | None) -> Block:
        whole = list(results(self.motion, drawn, reading, self.language))
        texts: MessageTable = self.language.gears["sheet"]
        columns = texts["columns_results"] if drawn is not None else texts["columns_results"][:3]
        rows = [row[: len(columns)] for row in whole]
        table = _table(columns, rows, STAMP_WIDTH, self.sizes, COLUMN_PARTS)
        title = texts.results if drawn is not None else self.language.gears.asked
        blocks: list[Block] = [Line(typeset(title, self.sizes.text)), table]
        if drawn is None:
            why = no_diagrams(self.motion, self.language)
            blocks.append(paragraph(why, self.sizes.text, table.width))
        return Column(blocks, gap=2.5)


def _shift_label(label: Label, by: float) -> Label:
    along = None if label.segment is None else (label.segment[0] + by, label.segment[1] + by)
    return replace(label, anchor=label.anchor + by, segment=along)


def _table(
    heads: Sequence[str],
    rows: Sequence[Sequence[str]],
    width: float,
    sizes: Sizes,
    parts: Sequence[float] = (),
) -> Block:
    parts = parts[: len(heads)] or [1.0] * len(heads)
    columns = [
        TableColumn(head, tuple(cells), width=width * share / sum(parts))
        for head, cells, share in zip(heads, zip(*rows, strict=True), parts, strict=True)
    ]
    return table_block(
        columns, TableForm(sizes.text, units="none", row_height=sizes.row), width=width
    )
