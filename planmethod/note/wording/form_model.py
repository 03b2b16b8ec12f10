"""What a language must be able to say of the form to fill in, and of what cannot be read."""

from __future__ import annotations

from collections.abc import Mapping

from planmethod.record import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class FormWording:
    """Words of the form (бланк ответов) and of works that come back.

    ``columns`` are in the order of the form; all of them, and ``student``, ``variant`` and
    ``problem``, are heads that are read again. ``scales`` are by the names of the scales,
    ``senses`` by the values of `planmethod.check.model.Sense`, ``unread`` by those of
    `planmethod.check.model.Unread`.
    """

    sheet: str
    title: str
    student: str
    group: str
    variant: str
    problem: str
    scales: Mapping[str, str]
    ruler: str
    advice: tuple[str, ...]
    columns: tuple[str, ...]
    position: str
    agrees: str
    differs: str
    senses: Mapping[str, str]
    units: tuple[str, ...]
    refused: str
    unread: Mapping[str, str]
