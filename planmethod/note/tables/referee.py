"""High-precision check of a solution, for the terminal and for the record (приговор арбитра)."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from msgspec.structs import replace

from planmethod.mechanism.model import FRAME
from planmethod.note.document import Chapter, Document, Node, Paragraph, table_of
from planmethod.note.tables.results import position_line
from planmethod.note.wording import Language, MessageTable
from planmethod.problem.quantities import QuantityKind
from planmethod.solved.accuracy import AccuracyVerdict, Refereed, examine
from planmethod.solved.solution import Solution


def examine_results(solution: Solution, digits: int) -> list[Refereed]:
    """Return the referee's verdicts on every position: on moving parts, each result once."""
    fixed = solution.problem.bodies[FRAME].points
    found = examine(solution.problem, [float(p) for p in solution.positions], digits=digits)

    def is_reported(verdict: AccuracyVerdict) -> bool:
        return verdict.kind is not QuantityKind.UNIT and verdict.quantity.of not in fixed

    return [
        replace(position, verdicts=tuple(filter(is_reported, position.verdicts)))
        for position in found
    ]


def referee_document(solution: Solution, digits: int, language: Language) -> Document:
    """Return every result beside the referee's, with its error and condition number.

    The value of the referee is written out to 20 digits; the record has all of them.
    """
    return Document.of(_referee(solution, digits, language.note))


def _referee(solution: Solution, digits: int, texts: MessageTable) -> Iterator[Node]:
    yield Paragraph(texts.referee_note.format(digits=digits))
    for index, position in enumerate(examine_results(solution, digits)):
        yield Chapter(position_line(solution, texts, index), numbered=False)
        rows = (_row(verdict, texts) for verdict in position.verdicts)
        yield table_of(texts["columns_referee"], rows)


def _row(verdict: AccuracyVerdict, texts: MessageTable) -> list[str]:
    from mpmath import nstr

    real, imag = _parts(verdict)
    parts = [nstr(real, 20)] + ([] if imag is None else [nstr(imag, 20)])
    value = "; ".join(parts).replace(".", texts.decimal)
    kappa = f"{verdict.kappa:.1e}" if verdict.kappa < 1e300 else "—"
    numbers = (f"{verdict.error:.1e}", kappa, f"{verdict.multiple:.2f}")
    return [
        verdict.quantity.symbol,
        value,
        *(text.replace(".", texts.decimal) for text in numbers),
    ]


def _parts(verdict: AccuracyVerdict) -> tuple[Any, Any]:
    """Return the coordinates of the referee's value; None for the second of a number."""
    value = verdict.value
    return value.real, None if verdict.kind.is_number else value.imag


def referee_record(solution: Solution, digits: int) -> list[dict[str, Any]]:
    """Return the referee's findings for each position, as plain data.

    ``bound`` is the reported bound of the relative error of the motion, ``forces_bound`` that of
    the forces, where there are loads. Values are text, to all the referee's digits; ``x`` and ``y``
    of a direction are its cosine and sine. ``error`` is that of float64, SI; ``kappa`` null where
    the value is zero; ``multiple`` is the error in units of κ·u.
    """
    return [
        {
            "digits": digits,
            "bound": position.warned,
            **({} if (b := position.warned_forces) is None else {"forces_bound": b}),
            "results": {
                verdict.label: {
                    **_value_record(verdict, digits),
                    "error": verdict.error,
                    "kappa": verdict.kappa if verdict.kappa < 1e300 else None,
                    "multiple": verdict.multiple,
                }
                for verdict in position.verdicts
            },
        }
        for position in examine_results(solution, digits)
    ]


def _value_record(verdict: AccuracyVerdict, digits: int) -> dict[str, str]:
    from mpmath import nstr

    real, imag = _parts(verdict)
    if imag is None:
        return {"value": nstr(real, digits)}
    return {"x": nstr(real, digits), "y": nstr(imag, digits)}
