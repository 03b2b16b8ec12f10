"""One answer: from the texts of its cells to their meaning (один ответ)."""

from __future__ import annotations

import re
from collections.abc import Mapping

from msgspec.structs import replace

from planmethod.check.model import Sense, Unread, WrittenAnswer
from planmethod.check.submissions.cells import (
    Cell,
    first_filled,
    mark_unreadable,
    read_name,
    read_sense,
)
from planmethod.check.submissions.units import read_number
from planmethod.problem.units import read_unit

POSITION_LIMIT = 100_000

_MM = read_unit("mm")
_BREAK = r"[\s(,;]+"

Scaled = tuple[float, float, str, Sense | None]
"""Value and step, SI; unit as written; sense."""


class NotReadError(Exception):
    """A cell cannot be read."""

    def __init__(self, reason: Unread, text: str, cell: Cell) -> None:
        super().__init__(text)
        self.reason, self.text, self.cell = reason, text, cell


def read_answer(cells: Mapping[str, Cell], *, location: str = "") -> WrittenAnswer:
    """Return an answer; if it is unreadable, the first faulty cell is reported.

    Parameters
    ----------
    cells : mapping of str to Cell
        By the names of fields: what, id, value, unit, mm, segment, sense, position.
    location : str
        Its location, if its cells have none.
    """
    what, name = "", first_filled(cells, "id").text
    if named := first_filled(cells, "what").text:
        what, other = read_name(named)
        name = name or other
    shown = first_filled(cells, "value", "mm", "sense")
    # The unit is kept even without a value: the answer is blank.
    answer = WrittenAnswer(
        what=what,
        id=name,
        unit=first_filled(cells, "unit").text,
        segment=first_filled(cells, "segment").text,
        location=location or shown.location or first_filled(cells, "what", "id").location,
        raw=first_filled(cells, "value").text,
    )
    try:
        # The most important is read first: a fault keeps what is already read.
        answer = replace(answer, position=_position(first_filled(cells, "position")))
        value, mm = first_filled(cells, "value"), first_filled(cells, "mm")
        said = None
        if not value.is_blank:
            number, step, unit, said = read_scaled(value, first_filled(cells, "unit"))
            answer = replace(answer, value=number, step=step, unit=unit)
        if not mm.is_blank:
            number, step, unit, other_said = read_scaled(mm, Cell())
            if unit:
                if read_unit(unit) != _MM:
                    raise NotReadError(Unread.UNIT, unit, mm)
                number, step = number * 1e3, step * 1e3
            answer = replace(answer, mm=number, mm_step=step)
            said = said or other_said
        answer = replace(answer, sense=_sense(first_filled(cells, "sense")) or said)
    except NotReadError as fault:
        return mark_unreadable(
            fault.reason, fault.text, fault.cell.location or answer.location, base=answer
        )
    if not what and not name and (not answer.is_blank or answer.sense):
        return mark_unreadable(Unread.QUANTITY, shown.text, answer.location, base=answer)
    return answer


def read_scaled(cell: Cell, unit: Cell) -> Scaled:
    """Return a number with its unit, which follows it or has a separate cell.

    Raises
    ------
    NotReadError
    """
    if cell.reason:
        raise NotReadError(cell.reason, cell.text, cell)
    if unit.reason:
        raise NotReadError(unit.reason, unit.text, unit)
    number = read_number(cell.text)
    if number is None:
        raise NotReadError(Unread.NUMBER, cell.text, cell)
    for split in (len(number.rest), *(m.start() for m in re.finditer(_BREAK, number.rest))):
        own, tail = number.rest[:split].strip(), number.rest[split:].strip()
        sense = read_sense(tail or own)
        if tail and not sense:
            continue
        if not tail and sense:
            own = ""
        scale = read_unit(own or unit.text)
        if scale is not None:
            return number.value * scale.factor, number.step * scale.factor, own or unit.text, sense
        if not own and not unit.text:
            return number.value, number.step, "", sense
    if number.rest and not number.rest[0].isalpha():
        raise NotReadError(Unread.NUMBER, cell.text, cell)
    raise NotReadError(Unread.UNIT, number.rest or unit.text, cell if number.rest else unit)


def _sense(cell: Cell) -> Sense | None:
    if cell.is_blank:
        return None
    sense = None if cell.reason else read_sense(cell.text)
    if sense is None:
        raise NotReadError(cell.reason or Unread.SENSE, cell.text, cell)
    return sense


def _position(cell: Cell) -> int | None:
    if cell.is_blank:
        return None
    number = None if cell.reason else read_number(cell.text)
    if number is None or number.rest or number.value % 1:
        raise NotReadError(cell.reason or Unread.POSITION, cell.text, cell)
    position = int(number.value)
    if not 0 <= position < POSITION_LIMIT:
        raise NotReadError(Unread.POSITION, cell.text, cell)
    return position
