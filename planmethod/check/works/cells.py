"""What stands in a file, before it is understood: texts and where they stand (клетки)."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache

from planmethod.check.model import Unread, Written
from planmethod.check.works.numbers import DASHES
from planmethod.check.works.vocabulary import BLANKS, key
from planmethod.note.wording import language
from planmethod.problem.names import fold, short
from planmethod.problem.selector import SelectorError, parse_selector
from planmethod.record import dataclass, replace

TEXT_LIMIT = 200
"""Characters of a cell that are looked at."""


@dataclass(frozen=True, slots=True)
class Cell:
    """A text and where it stands (клетка).

    Attributes
    ----------
    merged : str
        Text of the cell that this empty one is merged with.
    why : Unread or None
        Why there is no text although something stands there.
    """

    text: str = ""
    where: str = ""
    merged: str = ""
    why: Unread | None = None

    @property
    def is_blank(self) -> bool:
        """Whether it says nothing; a nought says something."""
        return self.why is None and (
            not self.text.strip(f"{DASHES}- \t\u00a0") or key(self.text) in BLANKS - {""}
        )


BLANK = Cell()


def cut(text: str) -> str:
    """Return as much of a stranger's text as is looked at, in one line."""
    return " ".join(text[:TEXT_LIMIT].split())


@lru_cache(maxsize=4096)
def read_name(text: str) -> tuple[str, str]:
    """Return ``what`` and ``id`` of a quantity; one of them is empty."""
    folded = " ".join(fold(text).split())
    try:
        parse_selector(folded)
    except SelectorError:
        return "", text
    return folded, ""


def refused(why: Unread, text: str, where: str, *, base: Written | None = None) -> Written:
    """Return an answer that cannot be read, or a remark."""
    words = language("en").form
    text = short(cut(text))
    said = words.unread[why.value].format(text=text, known=", ".join(words.units))
    base = base or Written(raw=text)
    return replace(base, unreadable=said, where=where, why=why, fault=text)


def found(cells: Mapping[str, Cell], *names: str) -> Cell:
    """Return the first of these cells that says something."""
    said = (cells[name] for name in names if name in cells)
    return next((cell for cell in said if not cell.is_blank), BLANK)
