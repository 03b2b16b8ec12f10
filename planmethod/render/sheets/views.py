"""Views of a sheet (виды): a picture with its name and scale, and what is measured on it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from planmethod.construct.scale import Scale
from planmethod.note.narrate.letters import shown_letters
from planmethod.note.numbers import Notation, is_nothing, with_unit
from planmethod.note.plaintext import plain_text
from planmethod.plans.model import PlanKind
from planmethod.problem.model import Convention
from planmethod.render.ink.drawing import Disc, Item, Span, View
from planmethod.render.ink.typeset import typeset
from planmethod.render.layout.block import Block, Column, Line, Row
from planmethod.render.pictures.ellipses import ellipse_inscription
from planmethod.render.pictures.planview import POLE, plan_picture, plan_places
from planmethod.render.pictures.positions import bold_position
from planmethod.render.pictures.schemeview import scheme_picture
from planmethod.render.sheets.model import Manner
from planmethod.render.sheets.results import position_text
from planmethod.solved.solution import Solution

PER_ROW = {2: 2, 3: 3, 4: 4, 5: 5}
"""Plans in a row by their number; of more there are six."""

CAPTION = 3.5
"""Height of the letters of one of many plans, and of its caption, mm."""


def scale_inscription(scale: Scale, convention: Convention, say: Notation) -> str:
    """Return the inscription under a view: ``μ_v = 0,05 (м/с)/мм`` or ``μ_v = 20 мм/(м/с)``."""
    letter = scale.symbol.removeprefix("mu_")
    unit, mm = say.units[scale.unit], say.units["mm"]
    grouped = f"({unit})" if "/" in unit or "·" in unit else unit
    if convention is Convention.MM_PER_UNIT:
        return f"μ_{{{letter}}} = {say.given(1.0 / scale.per_mm)} {mm}/{grouped}"
    return f"μ_{{{letter}}} = {say.given(scale.per_mm)} {grouped}/{mm}"


@dataclass(frozen=True)
class Viewed:
    """A view among the blocks of a sheet (вид): it knows what is measured on it.

    ``indices`` are the positions whose plans it shows, in the order in which they are drawn.
    """

    block: Block
    solution: Solution
    kind: PlanKind
    indices: tuple[int, ...]

    @property
    def width(self) -> float:
        """Width, mm."""
        return self.block.width

    @property
    def height(self) -> float:
        """Height, mm."""
        return self.block.height

    def place(self, corner: complex) -> list[Item]:
        """Return the items of the view."""
        return self.block.place(corner)

    def view(self, items: Sequence[Item], corner: complex) -> View:
        """Return what is told of the view whose items were placed at a corner."""
        left, top = corner.real, corner.imag
        scale = self.solution.scales[self.kind]
        letter = scale.symbol.removeprefix("mu_")
        poles = [item.centre for item in items if isinstance(item, Disc) and item.tag == POLE]
        return View(
            self.kind.value,
            (left, top - self.height, left + self.width, top),
            f"μ_{{{letter}}}",
            scale.per_mm,
            tuple(
                span
                for pole, index in zip(poles, self.indices, strict=False)
                for span in plan_spans(self.solution, self.kind, index, pole)
            ),
        )


@dataclass(frozen=True)
class Scaled(Viewed):
    """A view in a scale of its own on which no segment is measured: a scheme, a diagram."""

    name: str
    scale: Scale

    def view(self, items: Sequence[Item], corner: complex) -> View:
        """Return what is told of the view."""
        box = (corner.real, corner.imag - self.height, corner.real + self.width, corner.imag)
        letter = self.scale.symbol.removeprefix("mu_")
        return View(self.name, box, f"μ_{{{letter}}}", self.scale.per_mm)


def plan_spans(solution: Solution, kind: PlanKind, index: int, pole: complex) -> list[Span]:
    """Return the measured segments of a plan whose pole lies at ``pole`` on the sheet.

    A vector that is nothing beside the plan is zero by nature and no segment.
    """
    plan = solution.construction.plan(kind)
    at = plan_places(solution, kind, index)
    sizes = [abs(at[vector.head] - at[vector.tail]) for vector in plan.vectors]
    letters = shown_letters(solution.problem, plan)
    position = index if len(solution.positions) > 1 else None
    named = {
        frozenset((vector.tail, vector.head)): vector
        for vector, size in zip(plan.vectors, sizes, strict=True)
        if not is_nothing(size, max(sizes))
    }
    return [
        Span(
            plain_text(letters[vector.tail][0] + letters[vector.head][0]),
            position,
            pole + at[vector.tail],
            pole + at[vector.head],
        )
        for vector in named.values()
    ]


def scheme_view(solution: Solution, indices: Sequence[int], manner: Manner) -> Viewed:
    """Return the scheme; of many positions one in full, the others thin."""
    bold = shown_position(solution, indices, manner)
    alone = len(solution.positions) == 1
    picture = scheme_picture(
        solution,
        bold,
        letter_height=manner.letter,
        overlay=() if alone else tuple(indices),
        errors=manner.extras.errors,
    )
    return named_view(solution, PlanKind.POSITION, picture, manner, indices, (bold,))


def plan_view(solution: Solution, indices: Sequence[int], manner: Manner) -> Viewed:
    """Return a plan, or the plans of many positions in rows."""
    kind = manner.entry.of
    assert kind is not None
    errors = manner.extras.errors
    if manner.entry.position is not None:
        indices = (manner.entry.position,)
    if len(solution.positions) > 1:
        step, say = manner.entry.per_row, manner.words.say
        picture = plan_grid(solution, kind, indices, say, per_row=step, errors=errors)
    else:
        picture = plan_picture(
            solution, kind, indices[0], letter_height=manner.letter, errors=errors
        )
    return named_view(solution, kind, picture, manner, indices, indices)


def shown_position(solution: Solution, indices: Sequence[int], manner: Manner) -> int:
    """Return the position that stands for all: the asked one, else the clearest one."""
    asked = manner.entry.position
    if asked is not None and asked in indices:
        return asked
    if len(indices) == 1:
        return indices[0]
    return bold_position(solution, indices)


def _is_alone(solution: Solution, kind: PlanKind, manner: Manner) -> bool:
    """Tell whether a view shows one position only."""
    chosen = manner.entry.position is not None and kind is not PlanKind.POSITION
    return len(solution.positions) == 1 or chosen


def named_view(
    solution: Solution,
    kind: PlanKind,
    picture: Block,
    manner: Manner,
    indices: Sequence[int],
    ellipses: Sequence[int],
) -> Viewed:
    """Return a picture with its name and scale; ``ellipses`` are the positions that have them."""
    words = manner.words
    one, many = words.sheets.views[kind.value]
    title = manner.entry.title or (one if _is_alone(solution, kind, manner) else many)
    convention = solution.problem.scales.convention
    said = [scale_inscription(solution.scales[kind], convention, words.say)]
    said += ellipse_inscription(solution, kind, ellipses, words) if manner.extras.errors else []
    height = manner.text(manner.sizes.text)
    block = named(picture, title, [Line(typeset(text, height)) for text in said], manner)
    return Viewed(block, solution, kind, tuple(indices))


def named(picture: Block, title: str, said: Iterable[Block], manner: Manner) -> Column:
    """Return a picture with its name and what is said under it."""
    lines = [Line(typeset(title, manner.title), underline=True), *said]
    return Column([picture, Column(lines, gap=2.5, align="centre")], gap=5.0, align="centre")


def plan_grid(
    solution: Solution,
    kind: PlanKind,
    indices: Sequence[int],
    say: Notation,
    *,
    per_row: int | None = None,
    errors: bool = False,
) -> Block:
    """Return the plans of many positions in rows, each with its number."""
    coordinate = solution.problem.drive.coordinate
    cells: list[Block] = []
    convention = solution.problem.scales.convention
    for i in indices:
        value = with_unit(position_text(solution, i, say), say.units[coordinate.unit])
        said = f"{i}: {coordinate.symbol} = {value}"
        own = solution.own_scale(kind, i)
        caption: Block = Line(typeset(said, CAPTION))
        if own != solution.scales[kind]:
            scale = Line(typeset(scale_inscription(own, convention, say), CAPTION))
            caption = Column([caption, scale], gap=2.0, align="centre")
        picture = plan_picture(solution, kind, i, letter_height=CAPTION, errors=errors)
        cells.append(Column([picture, caption], gap=3.0, align="centre"))
    step = per_row or PER_ROW.get(len(cells), 6)
    rows = [Row(cells[k : k + step], gap=6.0, align="bottom") for k in range(0, len(cells), step)]
    return Column(rows, gap=6.0)
