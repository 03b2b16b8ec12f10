"""Motion and forces of a linkage as a calculation, by the analytic method (расчёт механизма).

The formulas are those that the account of the analytic method prints for each position. A position
differs from another one by its given angle, its loads, and a few signs.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import NamedTuple

import numpy as np
from msgspec import Struct

from planmethod.note.accounts.analytic import AnalyticAccount, Definition
from planmethod.note.accounts.projections import force_nodes
from planmethod.note.accounts.voice import Voice, VoiceForm
from planmethod.note.calculation.model import CalculationBuilder
from planmethod.note.document import Node
from planmethod.note.formula import Rich
from planmethod.note.wording import Language
from planmethod.plans.forces.polygons import reaction_symbol
from planmethod.solved.forces.statics import statics_of
from planmethod.solved.reading import Reals
from planmethod.solved.solution import Solution


class _Key(NamedTuple):
    """A letter, and how many times it was defined before: groups use some letters again."""

    symbol: Rich
    before: int


class LinkageFormulas(Struct, frozen=True):
    """Definitions of letters in some positions of a linkage (формулы по положениям).

    Attributes
    ----------
    order : tuple of _Key
        All letters, each behind those that it needs.
    columns : tuple of dict
        Definitions by letter, one for each position.
    forces : frozenset of _Key
        Letters of the forces.
    headings : dict
        Titles by the letter that follows them.
    """

    order: tuple[_Key, ...]
    columns: tuple[dict[_Key, Definition], ...]
    forces: frozenset[_Key]
    headings: dict[_Key, Rich]


class _HeardVoice(Voice, frozen=True):
    """A voice that calls a function with the titles of sections."""

    hear: Callable[[Rich], object] = str

    def part(self, title: Rich) -> Iterator[Node]:
        """Yield the heading of a section."""
        self.hear(title)
        yield from Voice.part(self, title)


def linkage_formulas(
    solution: Solution, indices: Sequence[int], language: Language, *, with_forces: bool = True
) -> LinkageFormulas:
    """Return the formulas of the analytic method in some positions.

    Raises
    ------
    ProblemError
        The mechanism has several driving links.
    """
    columns: list[dict[_Key, Definition]] = []
    forces, headings = set[_Key](), dict[_Key, Rich]()
    for index in indices:
        titles: list[tuple[int, Rich]] = []
        voice = _HeardVoice(
            VoiceForm.STEPS,
            hear=lambda title: titles.append((len(told()), title)),  # noqa: B023
        )
        account = AnalyticAccount(solution, index, language, voice)
        told = partial(getattr, account, "definitions")
        for _ in account.nodes():
            pass
        moving = _numbered(account.definitions)
        if with_forces:
            for _ in force_nodes(account):
                pass
        column = _numbered(account.definitions)
        forces |= column.keys() - moving.keys()
        columns.append(column)
        keys = [*column]
        for at, title in titles:
            if at < len(keys) and title not in headings.values():
                headings.setdefault(keys[at], title)
    return LinkageFormulas(_merged(columns), tuple(columns), frozenset(forces), headings)


def _numbered(definitions: Sequence[Definition]) -> dict[_Key, Definition]:
    found: dict[_Key, Definition] = {}
    count: dict[Rich, int] = {}
    for one in definitions:
        before = count.get(one.symbol, 0)
        found[_Key(one.symbol, before)] = one
        count[one.symbol] = before + 1
    return found


def _merged(columns: Sequence[dict[_Key, Definition]]) -> tuple[_Key, ...]:
    """Return the letters of all positions, each behind the one that it follows in its own."""
    order: list[_Key] = []
    for column in columns:
        at = 0
        for key in column:
            if key in order:
                at = order.index(key) + 1
            else:
                order.insert(at, key)
                at += 1
    return tuple(order)


class LinkageChapters:
    """Writes the letters of a linkage into the chapters of a calculation.

    Parameters
    ----------
    formulas : LinkageFormulas
    builder : CalculationBuilder
    language : Language
    """

    def __init__(
        self, formulas: LinkageFormulas, builder: CalculationBuilder, language: Language
    ) -> None:
        self.formulas, self.builder, self.language = formulas, builder, language
        self.texts = language.calculation

    def _unit(self, key: str) -> Rich:
        return self.language.notation.units.get(key, key)

    def motion(self) -> None:
        """Write positions, analogues, velocities and accelerations."""
        self._write([key for key in self.formulas.order if key not in self.formulas.forces])

    def forces(self) -> None:
        """Write loads, reactions and the balancing load."""
        self._write([key for key in self.formulas.order if key in self.formulas.forces])

    def _write(self, keys: Sequence[_Key]) -> None:
        for key in keys:
            self.builder.add_heading(self.formulas.headings.get(key, ""))
            told = [column.get(key) for column in self.formulas.columns]
            some = [one for one in told if one is not None]
            unit = self._unit(some[0].unit)
            values = [np.nan if one is None else one.value for one in told]
            if any(one.letters for one in some):
                letters = [one.letters if one is not None else None for one in told]
                self.builder.row(key.symbol, letters, values, unit)
            elif len({one.value for one in some}) == 1:
                self.builder.add_input(key.symbol, some[0].value, unit)
            else:
                if some[0].unit in ("N", "N·m"):  # a load that does not act is not mentioned
                    values = np.nan_to_num(values).tolist()
                self.builder.value(key.symbol, values, unit, self.texts.by_position.format(),
                                   is_input=True)  # fmt: skip


def computed_rows(solution: Solution, known: set[Rich]) -> Iterator[tuple[Rich, Reals, str]]:
    """Yield letters, values and units of the motion that no formula gives.

    Parameters
    ----------
    known : set of Rich
        Letters that have formulas.
    """
    for link, moving in solution.links.items():
        for symbol, values, unit in (
            (f"φ_{{{link}}}", moving.phi_deg, "°"),
            (f"ω_{{{link}}}", moving.omega, "1/s"),
            (f"ε_{{{link}}}", moving.epsilon, "1/s²"),
        ):
            if symbol not in known:
                yield symbol, values, unit
    for point, moved in solution.points.items():
        for letter, both, unit in (
            ("", moved.place, "m"), ("v", moved.velocity, "m/s"), ("a", moved.acceleration, "m/s²"),
        ):  # fmt: skip
            for axis, part in (("x", np.real(both)), ("y", np.imag(both))):
                symbol = f"{letter}_{{{point}{axis}}}" if letter else f"{axis}_{{{point}}}"
                if symbol not in known:
                    yield symbol, part, unit


def linkage_chapters(
    solution: Solution, heads: Sequence[str], builder: CalculationBuilder, language: Language
) -> None:
    """Write the chapters on motion and forces of all positions of a solution.

    What has no formula, as of a group without a solution in closed form, is a value.
    """
    texts = language.calculation
    alone = not solution.problem.drive.other_drives
    if alone:
        formulas = linkage_formulas(solution, range(len(heads)), language)
        chapters = LinkageChapters(formulas, builder, language)
        chapters.motion()
    if not _is_complete(solution):
        text = texts.no_form if alone else texts.several_drivers
        builder.add_heading(text.format(), is_sentence=True)
        units = language.notation.units
        for symbol, values, unit in computed_rows(solution, set(builder.symbols)):
            builder.value(symbol, values.tolist(), units.get(unit, unit), texts.computed.format())
    builder.close(texts.motion.format(), heads)
    if alone:
        chapters.forces()
    if alone and formulas.forces:
        builder.close(texts.forces.format(), heads)
    elif solution.problem.dynamics is not None:
        for symbol, values, unit in force_rows(solution, language):
            builder.value(symbol, values.tolist(), language.notation.units[unit],
                          texts.computed.format())  # fmt: skip
        builder.close(texts.forces.format(), heads)


def _is_complete(solution: Solution) -> bool:
    """Return whether all groups have a solution in closed form."""
    several = solution.problem.drive.other_drives
    return not several and all(one.class_number == 2 for one in solution.structure.groups)


def force_rows(solution: Solution, language: Language) -> Iterator[tuple[Rich, Reals, str]]:
    """Yield letters, values and units of the reactions and of the balancing load."""
    statics = statics_of(solution)
    called, notation = solution.problem.mechanism.called, language.notation
    for one in statics.reactions:
        symbol = notation.symbol(reaction_symbol(called(one.on), called(one.by)))
        for axis, part in (("x", one.force.real), ("y", one.force.imag)):
            yield f"{symbol}_{{{axis}}}", part, "N"
    balancer = solution.problem.balancer
    yield notation.symbol(balancer.symbol), statics.balance, balancer.unit
    for other in solution.problem.drive.other_drives:
        symbol = notation.symbol(solution.problem.balancer_of(other))
        yield symbol, statics.other_balances[other.link], other.balancing.unit
