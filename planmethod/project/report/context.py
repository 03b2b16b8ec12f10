"""Context of the chapters of a note: project, texts, calculated position, pictures."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import cached_property
from typing import Any, TypeAlias

from msgspec import Struct, field

from planmethod.construct.drafting import Profile
from planmethod.construct.steps import Compute, NumberName
from planmethod.mechanism.structure import LinkKind, kind_of_motion
from planmethod.note.accounts.voice import sentences
from planmethod.note.compared import DRAWN
from planmethod.note.document import Figure, Item, Node, Paragraph, input_text, plain_text
from planmethod.note.formula import Rich, capitalized, escape
from planmethod.note.narrate.naming import Formulas, Names, scale_inscription
from planmethod.note.narrate.steps import Narrator
from planmethod.note.numbers import Notation, with_unit
from planmethod.note.tables.results import other_places
from planmethod.note.wording import Language, MessageTable
from planmethod.plans.forces.polygons import reaction_symbol
from planmethod.plans.model import FACTS, PlanKind, Vector
from planmethod.problem.model import Drive, GearDrive
from planmethod.problem.records import KindProblem
from planmethod.project.parts import PartName
from planmethod.project.settle import Project, ProjectPart
from planmethod.render.backends.view import DrawingView
from planmethod.render.ink.drawing import Drawing
from planmethod.render.ink.pens import PenSet, pens_in_use, using_pens
from planmethod.render.layout.block import Block, Column, Row
from planmethod.render.sheets.blocks import maker_of
from planmethod.render.sheets.composer import Sizes, ViewBlock
from planmethod.render.sheets.model import BlockOptions, BlockSpec, BlockStyle
from planmethod.solved.forces.statics import JointForce
from planmethod.solved.solution import Solution

NBSP = "\u00a0"


class NoteFormulas(Formulas):
    """Formulas as a note displays them: each on a line of its own, without exact values."""

    shown_angle: float | None = None
    """Angle of the driver as the positions are numbered, degrees."""

    def number(self, name: NumberName) -> float:
        """Return a number with the drafting precision; the driver's angle as displayed."""
        if name == "phi" and self.shown_angle is not None:
            return self.shown_angle
        return super().number(name)

    def laid_off_formulas(
        self, step: Compute, segment: str, kind: PlanKind, vector: Vector | None
    ) -> list[str]:
        """Return the formulas of a length to be laid off: of the quantity, and of the length."""
        (value, _), (scale, _) = step.powers
        length, mu = abs(self.number(step.out)), self.per_mm(kind)
        symbol = vector.symbol if vector else self.names.symbol(value)
        made, lines = self.names.step[value], []
        size = float(f"{length * mu:.4g}")
        if isinstance(made, Compute):
            sides = self.product(made.powers, made.factor)
            lines.append(self.formula(symbol, sides, length * mu, FACTS[kind].unit))
        sides = self.fraction([(symbol, size, 1, False), (self.names.symbol(scale), mu, -1, True)])
        lines.append(self.formula(segment, sides, length, "mm"))
        return lines


class NoteContext:
    """What the chapters on trains, meshings, cams and points need, in a note of any kind.

    Attributes
    ----------
    language : Language
    texts : MessageTable
        The sentences of notes.
    problem : KindProblem
    project_parts : tuple of ProjectPart
    profile : Profile
        The hand that draws.
    """

    def __init__(
        self,
        problem: KindProblem,
        project_parts: tuple[ProjectPart, ...],
        profile: Profile,
        language: Language,
    ) -> None:
        self.problem, self.project_parts, self.profile = problem, project_parts, profile
        self.language, self.texts = language, language.report

    @property
    def gear_drive(self) -> GearDrive | None:
        """The train that drives the crank, or None."""
        return None

    @property
    def books(self) -> Sequence[str]:
        """Books of ``[project]``."""
        return ()

    @property
    def notation(self) -> Notation:
        """Numbers, units and symbols."""
        return self.language.notation

    def has(self, name: PartName) -> bool:
        """Return whether the project has a part."""
        return self.part(name) is not None

    def part(self, name: PartName) -> ProjectPart | None:
        """Return a part; None if the file does not have it."""
        return next((part for part in self.project_parts if part.name is name), None)

    @property
    def sources(self) -> dict[str, Rich]:
        """Entries of the list of sources by their keys, in the order of their numbers.

        The first is what the file names as its source, under ``own``, then come its books.
        """
        source = self.problem.source
        standards: MessageTable = self.texts["back"]["standards"]
        needed = {key: str(text) for key, text in standards.items() if key != "rack"}
        if self.has(PartName.MESHING):
            needed["rack"] = str(standards["rack"])
        return {**({"own": escape(source)} if source else {}), **self._books, **needed}

    @property
    def _books(self) -> dict[str, Rich]:
        return {f"book {k}": escape(book) for k, book in enumerate(self.books, 1)}

    def cited_books(self) -> Rich:
        """Return the numbers of the books of the file; empty if it names none."""
        cited = self.cited()
        return ",".join(cited[key] for key in self._books)

    def cited(self) -> dict[str, Rich]:
        """Return the numbers of sources as texts refer to them, in brackets after a blank."""
        return {key: f"{NBSP}[{k}]" for k, key in enumerate(self.sources, 1)}

    # Texts ---------------------------------------------------------------------------------------

    def unit(self, name: str) -> str:
        """Return the letters of a unit."""
        return self.notation.units[name]

    def mark_note(self, rows: Iterable[Sequence[Rich]]) -> Iterator[Node]:
        """Yield what the mark of an error means, where a row of a table has one."""
        if any(cell.endswith(DRAWN) for row in rows for cell in row):
            yield sentences(self.language.note.drawn_note)

    def quantity(self, value: float, unit: str) -> Rich:
        """Return a computed number with its unit."""
        return with_unit(self.notation.computed(value), self.unit(unit))

    def listed(self, parts: Sequence[Rich]) -> Rich:
        """Return a list in a sentence: ``a, b и c``."""
        *first, last = parts
        return f"{', '.join(first)}{self.texts['and']}{last}" if first else last


class Report(NoteContext):
    """Context that the chapters of a note of a linkage share (общее для глав записки).

    Attributes
    ----------
    project : Project
    every, one : Solution
        All positions, and the calculated one alone.
    names : Names
        As sheets letter them.
    formulas : NoteFormulas
        Of the calculated position.
    narrator : Narrator
    described : set of str
        Letters that were explained.
    """

    def __init__(self, project: Project, language: Language) -> None:
        self.project = project
        self.every: Solution = project.solution
        self.one: Solution = project.loaded
        super().__init__(project.problem, project.parts, self.one.profile, language)
        self.described: set[str] = set()
        self.names = Names(self.one, self.language.note, on_sheet=True)
        self.formulas = NoteFormulas(self.one, self.names, 0, in_full=True)
        if self.one.problem.drive.is_crank:
            self.formulas.shown_angle = round(self.displayed_places[project.calculated], 2)
        self.narrator = Narrator(self.one, self.names, 0, self.formulas)

    @property
    def gear_drive(self) -> GearDrive | None:
        """The train that drives the crank."""
        return self.one.problem.drive.gear_drive

    @property
    def books(self) -> Sequence[str]:
        """Books of ``[project]``."""
        task = self.project.problem.project
        return () if task is None else task.sources

    @property
    def is_series(self) -> bool:
        """True if there are several positions."""
        return len(self.project.positions) > 1

    def area(self, value: float) -> Rich:
        """Return an area, m², as the file gives it."""
        return with_unit(self.notation.as_input(value), f"{self.unit('m')}^{{2}}")

    def degrees(self, value: float) -> Rich:
        """Return an angle, two decimals at the most."""
        return with_unit(input_text(round(value, 2) + 0.0, self.language.note), "°")

    def mm(self, value: float) -> Rich:
        """Return a length that is measured on paper, with its unit."""
        return with_unit(self.notation.measured(value), self.unit("mm"))

    def parts(self, count: int) -> Rich:
        """Return the phrase for ``count`` equal parts, with the plural of the language."""
        last, teens = count % 10, 10 < count % 100 < 20
        form = "many" if teens or not 0 < last < 5 else "one" if last == 1 else "few"
        return str(self.texts["counts"]["parts"][form]).format(count=count)

    def scale(self, kind: PlanKind) -> Rich:
        """Return the scale of a plan of the calculated position as it is inscribed."""
        convention = self.one.problem.scales.convention
        return scale_inscription(self.one.plan_scale(kind, 0), convention, self.notation)

    # Positions -----------------------------------------------------------------------------------

    @property
    def place(self) -> Rich:
        """Position of the driver in the calculated position."""
        return self.place_of(self.project.calculated)

    def place_of(self, number: int) -> Rich:
        """Return the driver's coordinate in a position; after it those of others, with letters."""
        value, others = self.displayed_places[number], other_places(self.every, number)
        shown = self._place_text(value, self.one.problem.drive)
        for other, place in others:
            shown += f"; {other.coordinate.symbol} = {self._place_text(place, other)}"
        return shown

    def _place_text(self, value: float, drive: Drive) -> Rich:
        if drive.coordinate.unit == "m":
            return with_unit(self.notation.as_input(value), self.unit("m"))
        return self.degrees(value)

    @property
    def displayed_places(self) -> list[float]:
        """Coordinates of the driver in all positions, as in tables."""
        return [
            round(self.one.problem.display_position(value), 4) for value in self.project.positions
        ]

    @property
    def of_position(self) -> Rich:
        """Phrase "of the calculated position", after a blank; empty where it is the only one."""
        return self._for_position(self.texts.of_position)

    @property
    def in_position(self) -> Rich:
        """Phrase "in the calculated position", after a blank; empty where it is the only one."""
        return self._for_position(self.texts.in_position)

    @property
    def for_position(self) -> Rich:
        """For the calculated position, after a blank."""
        return self._for_position(self.texts.for_position) or self.texts.for_only.format()

    def _for_position(self, template: str) -> Rich:
        return template.format(number=self.project.calculated) if self.is_series else ""

    @property
    def coordinate(self) -> Rich:
        """Letter of the driver's coordinate, with its link."""
        drive = self.one.problem.drive
        return f"φ_{{{drive.link}}}" if drive.is_crank else drive.coordinate.symbol

    def reaction(self, joint: JointForce) -> Rich:
        """Return the letter of a reaction, the frame by its number."""
        return reaction_symbol(joint.on, self.one.problem.mechanism.called(joint.by))

    # Links ---------------------------------------------------------------------------------------

    @property
    def kinds(self) -> list[LinkKind]:
        """Roles of the links, the frame first."""
        return kind_of_motion(self.one.problem.mechanism)

    def link(self, link: str, case: str = "who") -> Rich:
        """Return the name of a link with its number, in a case of the language."""
        return self.texts.of_link.format(role=self.role(link, case), link=link)

    def role(self, link: str, case: str = "who") -> Rich:
        """Return the name of a link, in a case of the language."""
        kind = next(kind for kind in self.kinds if kind.link == link)
        roles: MessageTable = self.texts["roles"][case]
        return str(roles[kind.role.value])


def items(texts: Iterable[Rich]) -> list[Item | Paragraph]:
    """Return the entries of a numbered list; one alone as a sentence."""
    told = list(texts)
    if len(told) == 1:
        return [sentences(f"{capitalized(told[0])}.")]
    return [
        Item(f"{text}{'.' if k == len(told) else ';'}", f"{k})") for k, text in enumerate(told, 1)
    ]


PictureDrawer: TypeAlias = Callable[[float], Block]
"""Makes a picture with letters of a height, mm."""

WIDTH = 165.0
"""Greatest width of a figure in a note, mm."""

LETTER, ON_SHEETS = 3.2, 3.5
"""Heights of the letters of a figure as it is shown, and as it is drawn at first, mm."""

WISHED, MOST = 120.0, 1.35
"""Target size of a small picture, mm, and its maximum enlargement factor."""

MARGIN = 2.0
"""White around the ink, mm."""

SHRINK_TOLERANCE = 0.05
"""Relative reduction of a picture above which its letters are drawn larger."""


class FittedView(Struct, frozen=True, dict=True):
    """A picture of the sheets fitted to an area, made when a writer needs it (вид по ширине).

    Attributes
    ----------
    drawer : callable
        Makes the picture with letters of a height, mm.
    name : Rich
    area : tuple of float, mm
        Greatest width and height.
    grows : bool
        A small picture is enlarged.
    pens : PenSet
    """

    drawer: PictureDrawer
    name: Rich
    area: tuple[float, float]
    grows: bool = True
    pens: PenSet = field(default_factory=pens_in_use)

    @cached_property
    def scaled_view(self) -> tuple[DrawingView, float]:
        """The picture, and the ratio of its displayed to its drawn size."""
        with using_pens(self.pens):
            block = self.drawer(ON_SHEETS)
            factor = self._factor(block)
            if abs(factor - 1.0) > SHRINK_TOLERANCE:
                block = self.drawer(round(LETTER / factor, 1))
                factor = self._factor(block)
            drawing = Drawing(*_padded_size(block), plain_text(self.name))
            drawing.extend(block.place(complex(MARGIN, drawing.height - MARGIN)))
        return DrawingView(drawing), factor

    def _factor(self, block: Block) -> float:
        wide, high = _padded_size(block)
        most = min(self.area[0] / wide, self.area[1] / high)
        return min(most, max(1.0, min(WISHED / max(wide, high), MOST)) if self.grows else 1.0)

    @property
    def size(self) -> tuple[float, float]:
        """Width and height, mm."""
        view, factor = self.scaled_view
        width, height = view.size
        return width * factor, height * factor

    def svg(self) -> str:
        """Return an SVG element."""
        width, height = self.size
        head, end, rest = self.scaled_view[0].svg().partition(">")
        head = re.sub(r'\bwidth="[^"]*"', f'width="{width:.2f}mm"', head, count=1)
        head = re.sub(r'\bheight="[^"]*"', f'height="{height:.2f}mm"', head, count=1)
        return head + end + rest

    def draw(self, canvas: Any) -> None:
        """Draw on a canvas of reportlab whose unit is the millimetre, the lower left at zero."""
        view, factor = self.scaled_view
        canvas.scale(factor, factor)
        view.draw(canvas)

    def png(self, dpi: float) -> bytes:
        """Return a PNG file with a resolution in dots per inch."""
        view, factor = self.scaled_view
        return view.png(dpi * factor)


def _padded_size(block: Block) -> tuple[float, float]:
    """Return width and height of a picture with its margin, mm."""
    return block.width + 2 * MARGIN, block.height + 2 * MARGIN


def figure(
    drawer: PictureDrawer, caption: Rich, key: str, *, height: float = 120.0, grows: bool = True
) -> Figure:
    """Return a picture of the sheets as a figure with a number.

    Parameters
    ----------
    drawer : callable
        Makes the picture with letters of a height, mm; they are the larger the more it is shrunk.
    caption : Rich
    key : str
        By which texts refer to it.
    height : float, mm
        Greatest height.
    grows : bool
        A small picture is enlarged.
    """
    view = FittedView(drawer, caption, (WIDTH, height), grows)
    return Figure(view, caption, numbered=True, key=key)


def without_heading(view: Block) -> Block:
    """Return a view of a sheet without its name and scale: in a note the caption has them."""
    column = view.block if isinstance(view, ViewBlock) else view
    if isinstance(column, Row) and len(column.blocks) == 1:
        return without_heading(column.blocks[0])
    return column.blocks[-1] if isinstance(column, Column) else column


def of_sheet(kind: str, solution: Solution, language: Language, *, column: float) -> PictureDrawer:
    """Return the function that makes a block of the sheets by its kind, without its name, mm.

    ``column`` is the width of the texts of the sheet, which diagrams are measured by.
    """

    def draw(letter: float) -> Block:
        entry, sizes = BlockSpec(kind, letter=letter), Sizes(letter, letter, letter, column)
        indices = tuple(range(len(solution.positions)))
        return without_heading(
            maker_of(kind)(
                solution, indices, BlockStyle(entry, sizes, column, BlockOptions(language))
            )
        )

    return draw
