"""Rich text made plain, and numbers as plain text (простой текст)."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planmethod.note.numbers import rich_number, significant, trimmed

if TYPE_CHECKING:
    from planmethod.note.wording import Words


NO_BREAK = "\N{NO-BREAK SPACE}"
"""Space at which a line is not cut; the finished text has plain spaces."""

_SUPER = dict(zip("0123456789-−ntτkr", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁻ⁿᵗᵗᵏʳ", strict=True))
_SUB = dict(zip("0123456789", "₀₁₂₃₄₅₆₇₈₉", strict=True))
_UP = r"\^\{([^}]*)\}"
_DOWN = r"_\{([^}]*)\}"
_LITERAL = r"\\([_^{}\\])"


def plain_text(rich: str) -> str:
    """Return rich text as plain: ``ω_{2}`` gives ``ω₂``, ``a^{n}_{CB}`` gives ``aⁿ_CB``."""

    def up(match: re.Match[str]) -> str:
        return "".join(_SUPER.get(c, c) for c in match[1])

    def down(match: re.Match[str]) -> str:
        text = match[1]
        if not text:
            return ""
        return "".join(_SUB[c] for c in text) if all(c in _SUB for c in text) else f"_{text}"

    return re.sub(_LITERAL, r"\1", re.sub(_DOWN, down, re.sub(_UP, up, rich)))


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
