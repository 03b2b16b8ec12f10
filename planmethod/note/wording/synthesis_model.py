"""What a language must be able to say of syntheses (слова синтеза)."""

from __future__ import annotations

from collections.abc import Mapping

from msgspec import Struct


class SynthesisWording(Struct, frozen=True, kw_only=True):
    """Headings and sentences of syntheses in one language, templates of `str.format`.

    Attributes
    ----------
    titles, mechanisms : mapping
        Titles of the sheets, and names of the mechanisms, by kind of synthesis.
    comments : mapping
        Comments of the problem file.
    steps : mapping
        Sentences of constructions that are told as one.
    given : mapping
        Symbols and units of what is given, by option.
    checks, verdicts, units : mapping
        What is measured back, by the names of the record.
    """

    titles: Mapping[str, str]
    mechanisms: Mapping[str, str]
    comments: Mapping[str, str]
    construction: str
    steps_title: str
    to_bisector: str
    steps: Mapping[str, str]
    point: str
    given: Mapping[str, tuple[str, str]]
    lengths: str
    columns: tuple[str, ...]
    measured: str
    checks: Mapping[str, str]
    verdicts: Mapping[str, str]
    holds: Mapping[bool, str]
    interrupted: str
    ruler: str
