"""Numbers that are computed without plans, for checking (расчётные величины)."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, NamedTuple, Protocol

from msgspec import Struct

if TYPE_CHECKING:
    from planmethod.construct.drafting import Profile

QuantityReader = Callable[[str, int], float | None]
"""Value of a quantity by its name and position; None where it has none."""


class AnswerValue(Struct, frozen=True):
    """Correct value of an answer (величина).

    Attributes
    ----------
    symbol : str
        Rich text.
    unit : str
        SI, also ``1/min``, ``mm``; empty where it has none.
    value : float
    signed : bool
        Whether the sign belongs to the number.
    turns : bool
        Whether it has a sense of turning.
    is_integer : bool
        A count: nothing but the number itself is right.
    """

    symbol: str
    unit: str
    value: float
    signed: bool = True
    turns: bool = False
    is_integer: bool = False


class Mistaken(NamedTuple):
    """A mistake by its code, where it is made, and what all quantities then are."""

    code: str
    position_note: str
    read: QuantityReader


class QuestionQuantities(Protocol):
    """Quantities of a computed problem for questions.

    Attributes
    ----------
    names : tuple of str
        Questions of a file without ``[[answers]]``.
    count : int
        Number of positions.
    """

    names: tuple[str, ...]
    count: int

    def quantity(self, name: str, position: int) -> AnswerValue | None:
        """Return a quantity; None if it is unknown or has no value."""

    def read_off(self, name: str, position: int, profile: Profile) -> tuple[float, float] | None:
        """Return its segment on the drawing, mm, and one sigma of its reading."""

    def mistaken(self) -> Iterator[Mistaken]:
        """Yield the usual mistakes."""

    def derive_values(self, name: str, answers: Mapping[str, float]) -> Iterator[tuple[float, str]]:
        """Yield values of a quantity from other answers of the same position, with their names."""
