"""What a language must be able to say on the page of a moving mechanism (слова живой страницы)."""

from __future__ import annotations

from msgspec import Struct


class LiveWording(Struct, frozen=True, kw_only=True):
    """Words of buttons and headings, and sentences, plain text but for points in rich text.

    Attributes
    ----------
    touch, choose : str
        What there is to do: point at a segment; press a symbol for its diagram.
    no_place, dead, no_forces, unknown : str
        Why a position has no results: a point cannot be placed, the rays of a plan do not meet,
        the forces do not balance, a load is known in the file's positions only.
    nearest : str
        What the nearest positions that exist are introduced by.
    steady, follows : str
        Of a machine: the crank's speed in the steady motion; what has the page move at that speed.
    zoom : str
        A plan is drawn so many times larger than over the whole turn, or smaller.
    """

    play: str
    pause: str
    driver: str
    speed: str
    traces: str
    touch: str
    choose: str
    diagrams: str
    numbers: str
    forces: str
    no_place: str
    dead: str
    no_forces: str
    unknown: str
    nearest: str
    zoom: str
    made: str
    steady: str
    follows: str
