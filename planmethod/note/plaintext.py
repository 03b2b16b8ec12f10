"""Rich text made plain, and numbers as plain text (простой текст)."""

from __future__ import annotations

from typing import TYPE_CHECKING, assert_never

from planmethod.note.formula import (
    SPECIAL,
    Fraction,
    Index,
    Letters,
    Node,
    Overline,
    Root,
    inline,
    parse,
)
from planmethod.note.numbers import rich_number, significant, trimmed

if TYPE_CHECKING:
    from planmethod.note.wording import Words


NO_BREAK = "\N{NO-BREAK SPACE}"
"""Space at which a line is not cut; the finished text has plain spaces."""

_SUPER = dict(zip("0123456789-−ntτkr", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁻ⁿᵗᵗᵏʳ", strict=True))
_SUB = dict(zip("0123456789", "₀₁₂₃₄₅₆₇₈₉", strict=True))


def plain_text(rich: str) -> str:
    """Return rich text as plain: ``ω_{2}`` gives ``ω₂``, ``a^{n}_{CB}`` gives ``aⁿ_CB``."""
    return "".join(map(_plain, inline(parse(rich)))) if any(c in SPECIAL for c in rich) else rich


def _plain(node: Node) -> str:
    match node:
        case Letters(text):
            return text
        case Index(below, above, is_power):
            low = "".join(map(_plain, below))
            lowered = "".join(_SUB[c] for c in low) if set(low) <= set(_SUB) else f"_{low}"
            raised = "".join(_SUPER.get(c, c) for c in "".join(map(_plain, above)))
            return lowered + raised if is_power else raised + lowered
        case Overline(body):
            return "".join(map(_plain, body))
        case Fraction() | Root():
            raise AssertionError  # the formula is in one line
        case _:
            assert_never(node)


def spoken(text: str, words: Words) -> str:
    """Return a number with a decimal point as the language writes it."""
    return plain_text(rich_number(text, words.decimal))


def found(value: float, words: Words) -> str:
    """Return a result, four significant digits."""
    return spoken(significant(value), words)


def given(value: float, words: Words, digits: int | None = None) -> str:
    """Return a given number, no more digits than it has."""
    return spoken(trimmed(value, digits), words)


def fixed(value: float, words: Words, places: int = 2) -> str:
    """Return a number with so many digits after the decimal sign."""
    return spoken(f"{value + 0.0:.{places}f}", words)
