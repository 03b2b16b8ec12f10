"""Blocks of the forces over the cycle: diagrams, polar diagrams, table by positions (за цикл)."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence

import numpy as np
from msgspec import Struct

from planmethod.construct.scale import Scale, choose_scale
from planmethod.note.narrate.forces.statement import cycle_statement, cycle_wanted, link_names
from planmethod.note.narrate.given import of_turn, point_name
from planmethod.note.narrate.scales import scale_inscription
from planmethod.note.numbers import MINUS, Notation, half_up, with_unit
from planmethod.note.wording import Language
from planmethod.plans.forces.polygons import reaction_symbol
from planmethod.problem.model import Convention
from planmethod.render.forces.hodograph import (
    hodograph_picture,
    hodograph_scale,
    opposite,
    polar_groups,
)
from planmethod.render.ink.drawing import Pen
from planmethod.render.ink.extent import ink_bounds
from planmethod.render.ink.typeset import typeset
from planmethod.render.layout.block import Block, Column, Line, Picture, Row, shaped
from planmethod.render.pictures.diagram import (
    Abscissae,
    Curve,
    Mark,
    Ordinates,
    diagram_picture,
    mark_items,
)
from planmethod.render.sheets.composer import Viewed
from planmethod.render.sheets.model import Manner
from planmethod.render.sheets.texts import stated
from planmethod.render.sheets.views import LARGER, at_scales, named
from planmethod.solved.cycle import Cycle, Piece, ReactionPeak, cycle
from planmethod.solved.errors.forces import drawn_forces
from planmethod.solved.forces.statics import statics_of
from planmethod.solved.solution import Solution

WIDE, HIGH, SIDE = 0.8, 0.3, 0.45
"""Length and height of a diagram, and side of a polar diagram, as parts of the width of a text."""

HIGHER = (1.0, 1.5)
"""Enlargements of the height of a diagram where there is space."""

PENS = (Pen.MAIN, Pen.THIN, Pen.HIDDEN, Pen.AXIS)
"""Lines of the curves of one diagram, in turn."""


def _line(manner: Manner, text: str) -> Line:
    return Line(typeset(text, manner.text(manner.sizes.text)))


# Diagrams ----------------------------------------------------------------------------------------


class _Frame(Struct, frozen=True):
    """Axis of abscissae of the positions: its scale and its first position."""

    solution: Solution
    scale: Scale
    first: float
    sense: int

    @classmethod
    def of(cls, solution: Solution, forces: Cycle, width: float) -> _Frame:
        coordinate, ends = solution.problem.drive.coordinate, forces.course.drawn
        inverse = solution.problem.scales.convention is Convention.MM_PER_UNIT
        per_mm = choose_scale((float(np.ptp(ends)), 0.0), (width, 1.0), mm_per_unit=inverse)
        scale = Scale(f"mu_{coordinate.symbol[0]}", per_mm, coordinate.unit)
        falling = forces.course.falling
        return cls(solution, scale, float(ends[-1 if falling else 0]), -1 if falling else 1)

    def x(self, position: float) -> float:
        """Return the abscissa of a driver position, mm."""
        return self.sense * (position - self.first) / self.scale.per_mm

    def axis(self, forces: Cycle) -> Abscissae:
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

    def scales(self, up: Scale, say: Notation) -> str:
        """Return the inscription of both scales."""
        convention = self.solution.problem.scales.convention
        return "; ".join(scale_inscription(scale, convention, say) for scale in (up, self.scale))


def _as_high(manner: Manner, draw: Callable[[float, float], Viewed]) -> Block:
    """Return a diagram in all its heights, the usual one first."""
    column = manner.width(manner.sizes.column)
    return at_scales(draw(WIDE * column, times * HIGH * column) for times in HIGHER)


def balance_diagram(solution: Solution, indices: Sequence[int], manner: Manner) -> Block:
    """Return the balancing force or moment over the cycle, with both methods' results."""
    return _as_high(manner, lambda width, height: _balance(solution, manner, width, height))


def _balance(solution: Solution, manner: Manner, width: float, height: float) -> Viewed:
    forces = cycle(solution)
    frame = _Frame.of(solution, forces, width)
    statics, balancing = statics_of(solution), solution.problem.drive.balancing
    words, say = manner.words, manner.words.say
    symbol = say.symbol(balancing.symbol)
    per_mm = frame.ordinates([forces.balance], _real, height)
    scale = Scale(f"mu_{balancing.letter}", per_mm, balancing.unit)
    curve = Curve("", frame.parts(forces.balance, per_mm, _real))
    marks, said = [], []
    balances = drawn_forces(statics).balances
    if balances is not None:
        for mark, values in ((Mark.RING, balances.plans), (Mark.CROSS, balances.lever)):
            marks += [
                (mark, complex(frame.x(float(p)), float(v) / per_mm))
                for p, v in zip(solution.positions, values, strict=True)
                if np.isfinite(v)
            ]
        said = [_legend(manner, width)]
    picture = diagram_picture(
        frame.axis(forces),
        Ordinates(f"{symbol}, {say.units[balancing.unit]}", per_mm, say),
        [curve],
        marks,
        letter_height=manner.letter,
        name="balance",
    )
    what = words.sheets["balance"][balancing.quantity]
    lines: list[str | Block] = [frame.scales(scale, say), *said, *_chords(forces, manner)]
    block = named(picture, manner.entry.title or what.format(symbol=symbol), lines, manner)
    return Viewed(block, "balance", scale)


def _real(value: complex) -> float:
    return value.real


def _legend(manner: Manner, width: float) -> Block:
    """Return the legend of the balance's marks, in two lines where one would be too wide."""
    height, said = manner.text(manner.sizes.text), manner.words.sheets
    parts: list[Block] = [Line(typeset(said.legend_exact, height))]
    for mark, text in ((Mark.RING, said.legend_plans), (Mark.CROSS, said.legend_lever)):
        items = tuple(mark_items(mark, 0j))
        told: list[Block] = [Picture(items, ink_bounds(items)), Line(typeset(text, height))]
        parts.append(Row(told, gap=1.5, align="centre"))
    beside = Row(parts, gap=3.0, align="centre")
    if beside.width <= width:
        return beside
    return Column([parts[0], Row(parts[1:], gap=3.0, align="centre")], gap=2.5, align="centre")


def _chords(forces: Cycle, manner: Manner) -> list[str]:
    return [] if forces.smooth else [manner.words.sheets.chords]


def reaction_diagram(solution: Solution, indices: Sequence[int], manner: Manner) -> Block:
    """Return the sizes of the reactions of one force plan over the cycle."""
    return _as_high(manner, lambda width, height: _reactions(solution, manner, width, height))


def _reactions(solution: Solution, manner: Manner, width: float, height: float) -> Viewed:
    forces = cycle(solution)
    frame = _Frame.of(solution, forces, width)
    links = statics_of(solution).board.plans[manner.entry.number].links
    own = [k for k, joint in enumerate(forces.joints) if joint.on in links]
    numbers = [k for k in own if not forces.is_nothing(k)]
    per_mm = frame.ordinates([forces.force(k) for k in numbers], abs, height)
    scale = Scale("mu_F", per_mm, "N")
    curves: list[Curve] = []
    for k in numbers:
        symbol = _symbol(forces, k)
        parts = frame.parts(forces.force(k), per_mm, abs)
        same = next((c for c, other in enumerate(curves) if _alike(other.parts, parts)), None)
        if same is None:
            curves.append(Curve(symbol, parts, PENS[len(curves) % len(PENS)]))
        else:
            both = f"{curves[same].symbol} = {symbol}"
            curves[same] = Curve(both, curves[same].parts, curves[same].pen)
    picture = diagram_picture(
        frame.axis(forces),
        Ordinates(f"F, {manner.words.say.units['N']}", per_mm, manner.words.say),
        curves,
        letter_height=manner.letter,
        name=f"reactions {manner.entry.number}",
    )
    said = manner.words.sheets
    whose = said.reactions_of_group if len(links) > 1 else said.reactions_of_driver
    title = whose.format(links=link_names(links))
    lines = [frame.scales(scale, manner.words.say)]
    none = [f"{_symbol(forces, k)} = 0" for k in own if k not in numbers]
    lines += ["; ".join(none)] if none else []
    block = named(picture, title, [*lines, *_chords(forces, manner)], manner)
    return Viewed(block, "reactions", scale)


def _alike(one: Sequence[Sequence[complex]], two: Sequence[Sequence[complex]]) -> bool:
    """Return whether two curves would coincide on the drawing."""
    if [len(part) for part in one] != [len(part) for part in two]:
        return False
    pairs = (pair for a, b in zip(one, two, strict=True) for pair in zip(a, b, strict=True))
    return all(abs(p - q) < 0.2 for p, q in pairs)


# Polar diagrams ----------------------------------------------------------------------------------


def hodographs(solution: Solution, indices: Sequence[int], manner: Manner) -> Block:
    """Return the polar diagrams of the reactions in the revolute joints, in rows.

    They may be larger: the packer takes the size that fills the paper.
    """
    usual = SIDE * manner.width(manner.sizes.column)
    ways = (way for times in LARGER for way in _in_rows(solution, manner, times * usual))
    return shaped(ways, grows=True)


def _in_rows(solution: Solution, manner: Manner, side: float) -> Iterator[Viewed]:
    """Yield the polar diagrams in squares of a side, mm, by the number of them in a row."""
    forces, words = cycle(solution), manner.words
    convention = solution.problem.scales.convention
    cells: list[Block] = []
    scale = statics_of(solution).scale
    for group in polar_groups(forces):
        k = group[0]
        scale = hodograph_scale(forces, k, side)
        symbol = _symbol(forces, k)
        lines = [
            _line(manner, _whose(forces, group, words)),
            _line(manner, scale_inscription(scale, convention, words.say)),
            _line(manner, _largest(solution, symbol, forces.peak(k), words)),
        ]
        picture = hodograph_picture(forces, k, scale.per_mm, manner.letter)
        cells.append(Column([picture, Column(lines, gap=2.5, align="centre")], gap=4.0,
                            align="centre"))  # fmt: skip
    name = manner.entry.title or words.sheets.hodographs
    title = Line(typeset(name, manner.title))
    chords = [_line(manner, text) for text in _chords(forces, manner)]
    asked = manner.entry.per_row
    for step in dict.fromkeys(min(k, len(cells)) for k in ((asked,) if asked else (3, 2, 4, 5))):
        found = range(0, len(cells), step)
        rows = [Row(cells[k : k + step], gap=10.0, align="bottom") for k in found]
        block = Column([title, *rows, *chords], gap=7.0, align="centre")
        yield Viewed(block, "hodograph", scale)


def _symbol(forces: Cycle, number: int) -> str:
    joint = forces.joints[number]
    return reaction_symbol(joint.on, forces.solution.problem.mechanism.called(joint.by))


def _whose(forces: Cycle, group: Sequence[int], words: Language) -> str:
    """Return the reactions that a polar diagram shows, and their joints."""
    first = group[0]
    signs = ["" if k == first or not opposite(forces, first, k) else MINUS for k in group]
    symbols = [sign + _symbol(forces, k) for sign, k in zip(signs, group, strict=True)]
    joints = dict.fromkeys(point_name(forces.joints[k].joint) for k in group)
    told = words.sheets.of_joint if len(joints) == 1 else words.sheets.of_joints
    return told.format(symbols=" = ".join(symbols), joints=", ".join(joints))


def _largest(solution: Solution, symbol: str, peak: ReactionPeak, words: Language) -> str:
    """Return the largest size of a reaction, and the position where it is reached or approached."""
    drive, say = solution.problem.drive, words.say
    letter, _, index = symbol.partition("_")
    head = f"{letter}_{{{index.strip('{}')} max}} = {say.found(peak.size)} {say.units['N']}"
    sign = "→" if peak.is_limit else "="
    at = say.found(peak.position)
    if drive.is_crank:
        at = say.number(f"{half_up(peak.position % 360.0, 0) % 360.0:.0f}")
    at = f"{drive.coordinate.symbol} {sign} {with_unit(at, say.units[drive.coordinate.unit])}"
    at = of_turn(solution.problem, peak.position, at, words)
    return words.sheets.largest_at.format(largest=head, at=at)


# Texts -------------------------------------------------------------------------------------------


def statement_block(solution: Solution, indices: Sequence[int], manner: Manner) -> Block:
    """Return "Дано" with masses and loads of all positions, and "Определить"."""
    cycle(solution)
    words = manner.words
    asked = words.sheets.wanted_cycle.format(wanted=cycle_wanted(solution, words.say))
    return stated(cycle_statement(solution, words), asked, manner)
