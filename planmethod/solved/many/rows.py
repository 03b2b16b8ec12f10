"""Rows of a sweep: the numbers on a tape that form a result, and their names."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from msgspec import Struct

from planmethod.compiled import Ref, Symbol, TapeProgram
from planmethod.construct.steps import Name
from planmethod.plans.legend import Quantity, QuantityKind
from planmethod.plans.model import FACTS, PlanKind

FORCES = FACTS[PlanKind.FORCE].prefix


class SweepRow(Struct, frozen=True):
    """One row of a sweep's output.

    Attributes
    ----------
    name : str
        ``B.x``, ``B.vy``, ``2.phi_deg``, ``2.cos``, ``2.omega``, ``F.B.2-1.x``: the columns of
        ``solve --csv``.
    label : str
        Label of its result: ``B``, ``v_B``, ``phi_2``.
    is_force : bool
        True for a force or a moment.
    """

    name: str
    label: str
    is_force: bool = False


def rows_of(
    chosen: Sequence[Quantity],
    written: TapeProgram,
    origin: complex,
    load_motion: Sequence[Quantity] = (),
    drawn: Sequence[Name] = (),
) -> tuple[tuple[SweepRow, ...], list[Ref], list[frozenset[int]]]:
    """Return the rows of some results: their names, their numbers on the tape, their guards.

    Parameters
    ----------
    origin : complex, m
        From which the places on the tape count.
    load_motion : sequence of Result
        Quantities on which the loads, and so all forces, depend.
    drawn : sequence of Name
        Points and numbers of the plans that are rows as well.
    """
    loaded = frozenset[int]().union(*(written.depends[result.name] for result in load_motion))
    rows: list[SweepRow] = []
    refs: list[Ref] = []
    depends: list[frozenset[int]] = []
    for result in chosen:
        parts = list(_parts(result, written))
        if result.kind is QuantityKind.PLACE:
            here = zip(parts, (origin.real, origin.imag), strict=True)
            parts = [written.tape.add(part, at) for part, at in here]
        rows += [SweepRow(name, result.label, result.kind.is_force) for name in result.columns]
        refs += parts
        mine = written.depends[result.name]
        depends += [mine | loaded if result.kind.is_force else mine] * len(parts)
    for name in drawn:
        place: Symbol = written.value[name]
        rows += [SweepRow(f"{name}.{axis}", name) for axis in "xy"]
        refs += [place.re, 0.0 if place.im is None else place.im]
        mine = written.depends[name]
        depends += [mine | loaded if name.startswith(FORCES) else mine] * 2
    return tuple(rows), refs, depends


def _parts(result: Quantity, written: TapeProgram) -> Iterator[Ref]:
    """Yield the numbers of the tape that a result consists of."""
    value, tape = written.value[result.name], written.tape
    if isinstance(value, tuple):
        along: Symbol = value[1]
        if result.kind is QuantityKind.DIRECTION:
            x, y = along.re, 0.0 if along.im is None else along.im
            yield tape.add_node("degrees", tape.add_node("atan2", y, x))
            return
        value = along / abs(along)
    yield value.re
    if not result.kind.is_number:
        yield 0.0 if value.im is None else value.im
    if result.kind is QuantityKind.REACTION:
        yield abs(value).re
