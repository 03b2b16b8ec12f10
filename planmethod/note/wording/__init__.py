"""All words that a person reads: a folder for each language, a module for each subject (фразы).

What a language must be able to say stand in the modules beside this one; the folders fill them in.
"""

from __future__ import annotations

from functools import cache

from planmethod.errors import ExitCode, PlanMethodError
from planmethod.languages import LANGUAGES
from planmethod.note.wording.language import Language
from planmethod.note.wording.model import Wording


class UnknownLanguageError(PlanMethodError):
    """A language was asked for that nobody speaks here (неизвестный язык)."""

    exit_code = ExitCode.USAGE


@cache
def language(lang: str) -> Language:
    """Return all words of a language.

    Raises
    ------
    UnknownLanguageError
        Naming the languages there are.
    """
    if lang not in LANGUAGES:
        known = ", ".join(LANGUAGES)
        raise UnknownLanguageError(f"No words in the language {lang!r}. Choose one of: {known}.")
    return Language(lang)


def wording(lang: str) -> Wording:
    """Return the sentences of protocol and tables in a language.

    Raises
    ------
    UnknownLanguageError
    """
    return language(lang).note


__all__ = [
    "LANGUAGES",
    "Language",
    "UnknownLanguageError",
    "Wording",
    "language",
    "wording",
]
