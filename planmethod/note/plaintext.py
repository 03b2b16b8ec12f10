"""Rich text made plain, and numbers as plain text (простой текст)."""

from __future__ import annotations

from collections.abc import Iterable
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
    from planmethod.note.wording import MessageTable


NO_BREAK = "\N{NO-BREAK SPACE}"
"""Space at which a line is not cut; the finished text has plain spaces."""

_SUPER = dict(zip("0123456789-−nkr", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁻ⁿᵏʳ", strict=True))
_SUB = dict(zip("0123456789", "₀₁₂₃₄₅₆₇₈₉", strict=True))
_RATIO = "U"
"""Above it stands the carrier that a ratio is seen from, ``U^{H}_{13}``: no power of it."""


def plain_text(rich: str) -> str:
    """Return rich text as plain: ``ω_{2}`` gives ``ω₂``, ``a^{n}_{CB}`` gives ``aⁿ_CB``.

    A letter that has no raised one, ``τ``, follows a sign: ``a^τ_CB``.
    """
    return _nodes_text(inline(parse(rich))) if any(c in SPECIAL for c in rich) else rich


def _nodes_text(nodes: Iterable[Node]) -> str:
    text = ""
    for node in nodes:
        text += _node_text(node, is_ratio=text.endswith(_RATIO))
    return text


def _node_text(node: Node, *, is_ratio: bool = False) -> str:
    match node:
        case Letters(text):
            return text
        case Index(below, above, is_power):
            low = _nodes_text(below)
            lowered = "".join(_SUB[c] for c in low) if set(low) <= set(_SUB) else f"_{low}"
            high = _nodes_text(above)
            is_carrier = high.startswith("(") or (is_ratio and high.isalnum())
            is_said = is_carrier or any(c.isalpha() and c not in _SUPER for c in high)
            raised = f"^{high}" if is_said else "".join(_SUPER.get(c, c) for c in high)
            return lowered + raised if is_power else raised + lowered
        case Overline(body):
            return _nodes_text(body)
        case Fraction() | Root():
            raise AssertionError  # the formula is in one line
        case _:
            assert_never(node)


def localized(text: str, texts: MessageTable) -> str:
    """Return a number with a decimal point as the language writes it."""
    return plain_text(rich_number(text, texts.decimal))


def computed_text(value: float, texts: MessageTable) -> str:
    """Return a result, four significant digits."""
    return localized(significant(value), texts)


def input_text(value: float, texts: MessageTable, digits: int | None = None) -> str:
    """Return a given number, no more digits than it has."""
    return localized(trimmed(value, digits), texts)


def fixed(value: float, texts: MessageTable, places: int = 2) -> str:
    """Return a number with ``places`` digits after the decimal sign."""
    return localized(f"{value + 0.0:.{places}f}", texts)
