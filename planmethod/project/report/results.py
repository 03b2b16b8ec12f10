"""Results by the plans beside the exact ones: of the calculated position, of all (результаты)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from msgspec import Struct

from planmethod.note.document import Node, Part, Table, table_of_columns
from planmethod.note.formula import Rich
from planmethod.note.narrate.given import told
from planmethod.note.numbers import alike, significant
from planmethod.note.rounding import sigma_text
from planmethod.note.tables.results import lead_columns
from planmethod.note.tables.sigmas import marked
from planmethod.note.wording import Words
from planmethod.plans.legend import MOTION_KINDS, Quantity, QuantityKind, kinds_on
from planmethod.plans.model import PlanKind
from planmethod.project.report.context import Report, sentences
from planmethod.solved.errors.motion import drafting_of
from planmethod.solved.solution import Solution

MANY_SIGMAS = 3.0
"""Sigmas beyond which a difference is named."""

FAINT = 1e-6
"""Share of the largest of its kind below which a quantity is nothing."""


class PlannedValue(Struct, frozen=True):
    """A quantity by the plan and exactly, SI (сравнение)."""

    quantity: Quantity
    read: float
    exact: float
    sigma: float

    @property
    def off(self) -> float:
        """Difference of the plan."""
        return self.read - self.exact

    @property
    def percent(self) -> float:
        """The same, per cent of the exact value."""
        return 100.0 * abs(self.off / self.exact) if self.exact else 0.0

    @property
    def sigmas(self) -> float:
        """The same, in sigmas."""
        return abs(self.off) / self.sigma if self.sigma else 0.0


def compared(solution: Solution, index: int, *kinds: QuantityKind) -> list[PlannedValue]:
    """Return the quantities of some kinds in a position; those that are something."""
    errors, found = drafting_of(solution), []
    for quantity in told(solution, *kinds):
        exact = float(solution.exact(quantity)[index])
        read = float(solution.read_off(quantity.label)[index])
        sigma, _ = marked(errors, quantity.label, index)
        found.append(PlannedValue(quantity, read, exact, sigma))
    sizes = {kind: [abs(c.exact) for c in found if c.quantity.kind is kind] for kind in kinds}
    return [
        c
        for c in found
        if np.isfinite(c.read) and abs(c.exact) > FAINT * max(sizes[c.quantity.kind])
    ]


def worst(found: Sequence[PlannedValue]) -> PlannedValue | None:
    """Return the quantity whose difference is the largest share of it."""
    return max(found, key=lambda one: one.percent, default=None)


def results_parts(report: Report) -> Iterator[Node]:
    """Yield the tables of all positions, and the comparison."""
    said: Words = report.said["results"]
    if report.is_series:
        yield Part(said.part.format())
        yield sentences(said.intro.format())
        for kinds, key in (
            (kinds_on(PlanKind.VELOCITY), "velocities"),
            (kinds_on(PlanKind.ACCELERATION), "accelerations"),
        ):
            yield _by_positions(report, kinds, str(said[key]).format(), key)
    yield Part(said.compared.format())
    yield from _compared(report, said)
    if report.is_series:
        yield from _largest(report, said)


def _by_positions(report: Report, kinds: Sequence[QuantityKind], name: Rich, key: str) -> Table:
    every = report.every
    lead = lead_columns(every.problem, report.project.positions, report.words.note)
    columns = []
    for quantity in told(every, *kinds):
        values = [float(v) + 0.0 for v in every.read_off(quantity.label)]
        columns.append([quantity.symbol, *map(report.say.number, alike(values))])
    table = table_of_columns([*lead, *columns], repeated=len(lead))
    return Table(table.head, table.rows, 0, len(lead), name=name, key=key)


def _compared(report: Report, said: Words) -> Iterator[Node]:
    say = report.say
    found = compared(report.one, 0, *MOTION_KINDS)
    yield sentences(said.intro_compared.format(position=report.of_position))
    rows = [
        (
            f"{one.quantity.symbol}, {report.unit(one.quantity.kind.unit)}",
            say.found(one.read),
            say.found(one.exact),
            say.number(significant(one.off, 2)),
            say.number(f"{one.percent:.2f}"),
            say.number(sigma_text(one.sigma)),
        )
        for one in found
        if one.sigma  # what is given has no error
    ]
    yield Table(
        tuple(text.format() for text in said["columns_compared"]),
        tuple(rows),
        name=said.compared_table.format(position=report.in_position),
        key="compared",
    )
    beyond = [one.quantity.symbol for one in found if one.sigmas > MANY_SIGMAS]
    most = worst(found)
    yield sentences(
        said.beyond.format(symbols=", ".join(beyond))
        if beyond
        else said.within.format(most=say.number(f"{max(one.sigmas for one in found) + 0.05:.1f}")),
        ""
        if most is None
        else said.largest.format(
            symbol=most.quantity.symbol, percent=say.number(f"{most.percent:.1f}")
        ),
    )


def _largest(report: Report, said: Words) -> Iterator[Node]:
    """Yield the largest difference of each quantity in all positions."""
    every, say = report.every, report.say
    errors, rows = drafting_of(every), []
    for quantity in told(every, *MOTION_KINDS):
        exact, read = every.exact(quantity), every.read_off(quantity.label)
        off = np.abs(read - exact)
        peak = float(np.nanmax(np.abs(exact)))
        if not np.isfinite(off).any() or peak == 0.0:
            continue
        k = int(np.nanargmax(off))
        sigma, _ = marked(errors, quantity.label, k)
        if not sigma:
            continue  # given, not read
        rows.append(
            (
                f"{quantity.symbol}, {report.unit(quantity.kind.unit)}",
                say.found(peak),
                say.number(alike([float(off[k])], 2)[0]),
                say.number(f"{100.0 * off[k] / peak:.2f}"),
                str(k),
                say.number(sigma_text(sigma)),
            )
        )
    yield sentences(said.all_intro.format())
    yield Table(
        tuple(text.format() for text in said["columns_all"]),
        tuple(rows),
        name=said.all_table.format(),
        key="largest",
    )
