"""Blocks of the forces over the cycle: diagrams, polar diagrams, table by positions (за цикл)."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence

import numpy as np
from msgspec import Struct

from planmethod.construct.scale import Scale, choose_scale
from planmethod.note.compared import ComparedNumber, sense_of
from planmethod.note.narrate.forces.statement import (
    cycle_force_unknowns,
    cycle_statement,
    link_names,
)
from planmethod.note.narrate.naming import point_name, scale_inscription
from planmethod.note.narrate.statement import NBSP, angle_with_positions
from planmethod.note.numbers import MINUS, Notation, decimals_of, format_column, half_up, with_unit
from planmethod.note.series import balance_series, lever_beside_plans
from planmethod.note.wording import Language
from planmethod.plans.forces.polygons import reaction_symbol
from planmethod.problem.model import Convention
from planmethod.render.forces.polygon import (
    hodograph_picture,
    hodograph_scale,
    opposite,
    polar_groups,
)
from planmethod.render.frame import STAMP_WIDTH
from planmethod.render.ink.drawing import Pen
from planmethod.render.ink.typeset import ink_bounds, typeset
from planmethod.render.layout.block import (
    Block,
    Column,
    Line,
    Picture,
    Row,
    make_alternatives,
    paragraph,
)
from planmethod.render.layout.text_blocks import TableCell, TableColumn, TableForm, table_block
from planmethod.render.pictures.diagram import (
    Abscissae,
    Curve,
    Diagram,
    Mark,
    Ordinates,
    diagram_picture,
    mark_items,
)
from planmethod.render.sheets.composer import ViewBlock
from planmethod.render.sheets.forces import angle_text
from planmethod.render.sheets.model import BlockStyle
from planmethod.render.sheets.results import position_columns, table_width
from planmethod.render.sheets.views import LARGER, at_scales, named, stated
from planmethod.solved.cycle_forces import CycleForces, Piece, ReactionPeak, cycle_forces_of
from planmethod.solved.forces.reading import NEGLIGIBLE_FRACTION
from planmethod.solved.forces.statics import statics_of
from planmethod.solved.reading import Reals
from planmethod.solved.solution import Solution


def reactions_table(
    solution: Solution, position_indices: Sequence[int], style: BlockStyle
) -> Block:
    """Return the table of reactions and of the balance by positions."""
    forces = cycle_forces_of(solution)
    height, width = style.text(min(style.sizes.text, 3.5)), table_width(style)
    language = style.language
    columns = position_columns(solution, position_indices, language)
    for k in range(len(forces.joints)):
        columns += _reaction_columns(forces, k, position_indices, language.notation)
    columns += cycle_balance_columns(solution, position_indices, language)
    title = style.entry.title or language.sheets.cycle_reactions
    form = TableForm(height, leading=2)
    table = table_block(columns, form, max_width=width, width=STAMP_WIDTH, title=title)
    return Column([table, paragraph(_drawn_at(solution, language), height, table.width)], gap=3.0)


def _drawn_at(solution: Solution, language: Language) -> str:
    """Return the note on the scales of the plans of all positions, and on their reading."""
    convention = solution.problem.scales.convention
    scales = [*solution.scales.values(), statics_of(solution).scale]
    told = (scale_inscription(scale, convention, language.notation) for scale in scales)
    phrase = "; ".join(text.replace(" ", NBSP) for text in told)
    notation = language.notation
    ruler = f"{notation.as_input(solution.ruler_arithmetic.ruler)}{NBSP}{notation.units['mm']}"
    return language.sheets.cycle_note.format(scales=phrase, ruler=ruler)


def _reaction_columns(
    forces: CycleForces, which: int, position_indices: Sequence[int], notation: Notation
) -> list[TableColumn]:
    """Return size and direction of a reaction, and of a guide its moment about the pin."""
    joint, statics = forces.joints[which], statics_of(forces.solution)
    values = [complex(joint.force[i]) for i in position_indices]
    nothing = [
        abs(v) <= NEGLIGIBLE_FRACTION * statics.largest(i)
        for v, i in zip(values, position_indices, strict=True)
    ]
    sizes = format_column([0.0 if nil else abs(v) for v, nil in zip(values, nothing, strict=True)])
    angles = [
        "—" if nil else angle_text(v, notation) for v, nil in zip(values, nothing, strict=True)
    ]
    by = forces.solution.problem.mechanism.called(joint.by)
    index = reaction_symbol(joint.on, by, letter="")
    columns = [
        TableColumn(
            reaction_symbol(joint.on, by),
            tuple(map(notation.number, sizes)),
            unit=notation.units["N"],
        ),
        TableColumn(f"φ{index}", tuple(angles), unit=notation.in_head("deg")),
    ]
    moments = [float(joint.moment[i]) for i in position_indices]
    lengths = [length for _, _, length in forces.solution.problem.lengths]
    least = [
        NEGLIGIBLE_FRACTION * statics.largest(i) * max(lengths, default=1.0)
        for i in position_indices
    ]
    none = [abs(m) <= small for m, small in zip(moments, least, strict=True)]
    if not all(none):
        texts = format_column(
            [0.0 if nil else abs(m) for m, nil in zip(moments, none, strict=True)]
        )
        cells = tuple(
            TableCell(notation.number(text), 0 if nil else (1 if m > 0 else -1))
            for text, m, nil in zip(texts, moments, none, strict=True)
        )
        columns.append(TableColumn(f"M{index}", cells, unit=notation.units["N·m"]))
    return columns


def cycle_balance_columns(
    solution: Solution, position_indices: Sequence[int], language: Language
) -> list[TableColumn]:
    """Return the balance: exact, by both methods, their difference and its expected size.

    The difference is between the numbers of the table.
    """
    statics, said, notation = statics_of(solution), language.sheets, language.notation
    plans, both = balance_series(statics), lever_beside_plans(statics)
    unit = notation.units[plans.unit]

    def column(head: str, texts: Sequence[str], *, sense: bool = plans.turns) -> TableColumn:
        cells = []
        for text in texts:
            size = text.removeprefix("-") if sense else text
            cells.append(TableCell(notation.number(size), sense_of(float(text)) if sense else None))
        return TableColumn(head, tuple(cells), unit=unit)

    def chosen(values: Reals | Sequence[float]) -> list[float]:
        return [float(values[i]) for i in position_indices]

    exact = column(notation.symbol(plans.symbol), format_column(chosen(plans.exact)))
    if both is None:
        return [exact]
    texts = format_column([*chosen(both.exact), *chosen(both.read)])
    pairs = list(zip(texts[: len(position_indices)], texts[len(position_indices) :], strict=True))
    printed = [ComparedNumber(float(one), float(two)) for one, two in pairs]
    differences = [
        _rounded(one.size_off if both.turns else one.off, *pair)
        for one, pair in zip(printed, pairs, strict=True)
    ]
    shares = tuple(notation.number(one.percent_text()) for one in printed)
    return [
        exact,
        column(said.cycle_plans, texts[: len(position_indices)]),
        column(said.cycle_lever, texts[len(position_indices) :]),
        column("Δ", differences, sense=False),
        TableColumn("Δ", shares, unit="%"),
        column("σ_{Δ}", format_column(chosen(both.sigma), 2), sense=False),
    ]


def _rounded(difference: float, one: str, two: str) -> str:
    """Return the difference of two printed numbers with their common decimals; a 0 has none."""
    decimals = min(decimals_of(text) for text in (one, two) if float(text) or one == two)
    return f"{half_up(difference, decimals) + 0.0:.{decimals}f}"


WIDE, HIGH, SIDE = 0.8, 0.3, 0.45
"""Length and height of a diagram, and side of a polar diagram, as parts of the width of a text."""

HIGHER = (1.0, 1.5)
"""Enlargements of the height of a diagram where there is space."""

PENS = (Pen.MAIN, Pen.THIN, Pen.HIDDEN, Pen.AXIS)
"""Lines of the curves of one diagram, in turn."""


def _line(style: BlockStyle, text: str) -> Line:
    return Line(typeset(text, style.text(style.sizes.text)))


# Diagrams ----------------------------------------------------------------------------------------


class _Frame(Struct, frozen=True):
    """Axis of abscissae of the positions: its scale and its first position."""

    solution: Solution
    scale: Scale
    first: float
    sense: int

    @classmethod
    def of(cls, solution: Solution, forces: CycleForces, width: float) -> _Frame:
        coordinate, ends = solution.problem.drive.coordinate, forces.course.drawn
        inverse = solution.problem.scales.convention is Convention.MM_PER_UNIT
        per_mm = choose_scale((float(np.ptp(ends)), 0.0), (width, 1.0), mm_per_unit=inverse)
        scale = Scale(f"mu_{coordinate.symbol[0]}", per_mm, coordinate.unit)
        falling = forces.course.falling
        return cls(solution, scale, float(ends[-1 if falling else 0]), -1 if falling else 1)

    def x(self, position: float) -> float:
        """Return the abscissa of a driver position, mm."""
        return self.sense * (position - self.first) / self.scale.per_mm

    def axis(self, forces: CycleForces) -> Abscissae:
        """Return the axis with the numbers of the requested positions."""
        marks = [(self.x(float(p)), str(k)) for k, p in enumerate(self.solution.positions)]
        if forces.course.closed:
            end = int(np.argmin(self.sense * self.solution.positions))
            marks.append((self.x(float(forces.course.drawn[:: self.sense][-1])), str(end)))
        name = self.solution.problem.drive.coordinate.symbol
        return Abscissae(name, tuple(x for x, _ in marks), tuple(text for _, text in marks))

    def parts(
        self, pieces: Sequence[Piece], per_mm: float, value: Callable[[complex], float]
    ) -> tuple[tuple[complex, ...], ...]:
        """Return a curve's parts on the diagram, mm."""
        parts = (
            tuple(
                complex(self.x(float(p)), value(complex(v)) / per_mm)
                for p, v in zip(piece.positions, piece.values, strict=True)
            )
            for piece in pieces[:: self.sense]
        )
        return tuple(part[:: self.sense] for part in parts)

    def ordinates(
        self, curves: Iterable[Sequence[Piece]], value: Callable[[complex], float], height: float
    ) -> float:
        """Return the scale at which curves have a height, units per mm."""
        values = [value(complex(v)) for one in curves for piece in one for v in piece.values]
        reach = max([0.0, *values]) - min([0.0, *values])
        inverse = self.solution.problem.scales.convention is Convention.MM_PER_UNIT
        return choose_scale((0.0, reach), (1.0, height), mm_per_unit=inverse)

    def scales(self, up: Scale, notation: Notation) -> str:
        """Return the inscription of both scales."""
        convention = self.solution.problem.scales.convention
        return "; ".join(
            scale_inscription(scale, convention, notation) for scale in (up, self.scale)
        )


def _as_high(style: BlockStyle, draw: Callable[[float, float], ViewBlock]) -> Block:
    """Return a diagram in all its heights, the usual one first."""
    column = style.width(style.sizes.column)
    return at_scales(draw(WIDE * column, times * HIGH * column) for times in HIGHER)


def balance_diagram(
    solution: Solution, position_indices: Sequence[int], style: BlockStyle
) -> Block:
    """Return the balancing force or moment over the cycle, with both methods' results."""
    return _as_high(style, lambda width, height: _balance(solution, style, width, height))


def _balance(solution: Solution, style: BlockStyle, width: float, height: float) -> ViewBlock:
    forces = cycle_forces_of(solution)
    frame = _Frame.of(solution, forces, width)
    statics, balancing = statics_of(solution), solution.problem.balancer
    language, notation = style.language, style.language.notation
    symbol = notation.symbol(balancing.symbol)
    per_mm = frame.ordinates([forces.balance], _real, height)
    scale = Scale(f"mu_{balancing.letter}", per_mm, balancing.unit)
    curve = Curve("", frame.parts(forces.balance, per_mm, _real))
    marks, said = [], []
    both = lever_beside_plans(statics)
    if both is not None:
        for mark, values in ((Mark.RING, both.exact), (Mark.CROSS, both.read)):
            marks += [
                (mark, complex(frame.x(float(p)), float(v) / per_mm))
                for p, v in zip(solution.positions, values, strict=True)
                if np.isfinite(v)
            ]
        said = [_legend(style, width)]
    picture = diagram_picture(
        Diagram(
            frame.axis(forces),
            Ordinates(f"{symbol}, {notation.units[balancing.unit]}", per_mm, notation),
            [curve],
            marks,
        ),
        letter_height=style.letter,
        name="balance",
    )
    what = language.sheets["balance"][balancing.quantity]
    lines: list[str | Block] = [frame.scales(scale, notation), *said, *_chords(forces, style)]
    block = named(picture, style.entry.title or what.format(symbol=symbol), lines, style)
    return ViewBlock(block, "balance", scale)


def _real(value: complex) -> float:
    return value.real


def _legend(style: BlockStyle, width: float) -> Block:
    """Return the legend of the balance's marks, in two lines where one would be too wide."""
    height, texts = style.text(style.sizes.text), style.language.sheets
    parts: list[Block] = [Line(typeset(texts.legend_exact, height))]
    for mark, text in ((Mark.RING, texts.legend_plans), (Mark.CROSS, texts.legend_lever)):
        items = tuple(mark_items(mark, 0j))
        told: list[Block] = [Picture(items, ink_bounds(items)), Line(typeset(text, height))]
        parts.append(Row(told, gap=1.5, align="centre"))
    beside = Row(parts, gap=3.0, align="centre")
    if beside.width <= width:
        return beside
    return Column([parts[0], Row(parts[1:], gap=3.0, align="centre")], gap=2.5, align="centre")


def _chords(forces: CycleForces, style: BlockStyle) -> list[str]:
    return [] if forces.smooth else [style.language.sheets.chords]


def reaction_diagram(
    solution: Solution, position_indices: Sequence[int], style: BlockStyle
) -> Block:
    """Return the sizes of the reactions of one force plan over the cycle."""
    return _as_high(style, lambda width, height: _reactions(solution, style, width, height))


def _reactions(solution: Solution, style: BlockStyle, width: float, height: float) -> ViewBlock:
    forces = cycle_forces_of(solution)
    frame = _Frame.of(solution, forces, width)
    links = statics_of(solution).board.plans[style.entry.number].links
    own = [k for k, joint in enumerate(forces.joints) if joint.on in links]
    numbers = [k for k in own if not forces.is_negligible(k)]
    per_mm = frame.ordinates([forces.force(k) for k in numbers], abs, height)
    scale = Scale("mu_F", per_mm, "N")
    curves: list[Curve] = []
    for k in numbers:
        symbol = _symbol(forces, k)
        parts = frame.parts(forces.force(k), per_mm, abs)
        same = next((c for c, other in enumerate(curves) if _coincide(other.parts, parts)), None)
        if same is None:
            curves.append(Curve(symbol, parts, PENS[len(curves) % len(PENS)]))
        else:
            both = f"{curves[same].symbol} = {symbol}"
            curves[same] = Curve(both, curves[same].parts, curves[same].pen)
    picture = diagram_picture(
        Diagram(
            frame.axis(forces),
            Ordinates(f"F, {style.language.notation.units['N']}", per_mm, style.language.notation),
            curves,
        ),
        letter_height=style.letter,
        name=f"reactions {style.entry.number}",
    )
    texts = style.language.sheets
    whose = texts.reactions_of_group if len(links) > 1 else texts.reactions_of_driver
    title = whose.format(links=link_names(links))
    lines = [frame.scales(scale, style.language.notation)]
    none = [f"{_symbol(forces, k)} = 0" for k in own if k not in numbers]
    lines += ["; ".join(none)] if none else []
    block = named(picture, title, [*lines, *_chords(forces, style)], style)
    return ViewBlock(block, "reactions", scale)


def _coincide(one: Sequence[Sequence[complex]], two: Sequence[Sequence[complex]]) -> bool:
    """Return whether two curves would coincide on the drawing."""
    if [len(part) for part in one] != [len(part) for part in two]:
        return False
    pairs = (pair for a, b in zip(one, two, strict=True) for pair in zip(a, b, strict=True))
    return all(abs(p - q) < 0.2 for p, q in pairs)


# Polar diagrams ----------------------------------------------------------------------------------


def hodographs(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the polar diagrams of the reactions in the revolute joints, in rows.

    They may be larger: the packer takes the size that fills the paper.
    """
    usual = SIDE * style.width(style.sizes.column)
    ways = (way for times in LARGER for way in _in_rows(solution, style, times * usual))
    return make_alternatives(ways, grows=True)


def _in_rows(solution: Solution, style: BlockStyle, side: float) -> Iterator[ViewBlock]:
    """Yield the polar diagrams in squares of a side, mm, by the number of them in a row."""
    forces, language = cycle_forces_of(solution), style.language
    convention = solution.problem.scales.convention
    cells: list[Block] = []
    scale = statics_of(solution).scale
    for group in polar_groups(forces):
        k = group[0]
        scale = hodograph_scale(forces, k, side)
        symbol = _symbol(forces, k)
        lines = [
            _line(style, _reactions_text(forces, group, language)),
            _line(style, scale_inscription(scale, convention, language.notation)),
            _line(style, _largest(solution, symbol, forces.peak(k), language)),
        ]
        picture = hodograph_picture(forces, k, scale.per_mm, style.letter)
        cells.append(Column([picture, Column(lines, gap=2.5, align="centre")], gap=4.0,
                            align="centre"))  # fmt: skip
    name = style.entry.title or language.sheets.hodographs
    title = Line(typeset(name, style.title))
    chords = [_line(style, text) for text in _chords(forces, style)]
    asked = style.entry.per_row
    for step in dict.fromkeys(min(k, len(cells)) for k in ((asked,) if asked else (3, 2, 4, 5))):
        found = range(0, len(cells), step)
        rows = [Row(cells[k : k + step], gap=10.0, align="bottom") for k in found]
        block = Column([title, *rows, *chords], gap=7.0, align="centre")
        yield ViewBlock(block, "hodograph", scale)


def _symbol(forces: CycleForces, number: int) -> str:
    joint = forces.joints[number]
    return reaction_symbol(joint.on, forces.solution.problem.mechanism.called(joint.by))


def _reactions_text(forces: CycleForces, group: Sequence[int], language: Language) -> str:
    """Return the reactions that a polar diagram shows, and their joints."""
    first = group[0]
    signs = ["" if k == first or not opposite(forces, first, k) else MINUS for k in group]
    symbols = [sign + _symbol(forces, k) for sign, k in zip(signs, group, strict=True)]
    joints = dict.fromkeys(point_name(forces.joints[k].joint) for k in group)
    text = language.sheets.of_joint if len(joints) == 1 else language.sheets.of_joints
    return text.format(symbols=" = ".join(symbols), joints=", ".join(joints))


def _largest(solution: Solution, symbol: str, peak: ReactionPeak, language: Language) -> str:
    """Return the largest size of a reaction, and the position where it is reached or approached."""
    drive, notation = solution.problem.drive, language.notation
    letter, _, index = symbol.partition("_")
    size = f"{notation.computed(peak.size)} {notation.units['N']}"
    head = f"{letter}_{{{index.strip('{}')} max}} = {size}"
    sign = "→" if peak.is_limit else "="
    at = notation.computed(peak.position)
    if drive.is_crank:
        at = notation.number(f"{half_up(peak.position % 360.0, 0) % 360.0:.0f}")
    at = f"{drive.coordinate.symbol} {sign} {with_unit(at, notation.units[drive.coordinate.unit])}"
    at = angle_with_positions(solution.problem, peak.position, at, language)
    return language.sheets.largest_at.format(largest=head, at=at)


# Texts -------------------------------------------------------------------------------------------


def statement_block(
    solution: Solution, position_indices: Sequence[int], style: BlockStyle
) -> Block:
    """Return "Дано" with masses and loads of all positions, and "Определить"."""
    cycle_forces_of(solution)
    language = style.language
    asked = language.sheets.wanted_cycle.format(
        wanted=cycle_force_unknowns(solution, language.notation)
    )
    return stated(cycle_statement(solution, language), asked, style)
