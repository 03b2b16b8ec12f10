"""Catalogues of sentences, one module per language."""

from __future__ import annotations

from planmethod.errors import ExitCode, PlanMethodError
from planmethod.note.wording.en import EN
from planmethod.note.wording.force_en import FORCE_EN
from planmethod.note.wording.force_model import ForceWording
from planmethod.note.wording.force_ru import FORCE_RU
from planmethod.note.wording.model import Wording
from planmethod.note.wording.ru import RU

CATALOGUES: tuple[Wording, ...] = (RU, EN)
FORCE_CATALOGUES: tuple[ForceWording, ...] = (FORCE_RU, FORCE_EN)


class UnknownLanguageError(PlanMethodError):
    """A language was asked for that no catalogue speaks (неизвестный язык)."""

    exit_code = ExitCode.USAGE


def wording(lang: str) -> Wording:
    """Return the catalogue of a language.

    Raises
    ------
    UnknownLanguageError
        Naming the languages there are.
    """
    for catalogue in CATALOGUES:
        if catalogue.lang == lang:
            return catalogue
    known = ", ".join(catalogue.lang for catalogue in CATALOGUES)
    raise UnknownLanguageError(f"No catalogue for the language {lang!r}. Choose one of: {known}.")


def force_wording(words: Wording) -> ForceWording:
    """Return the sentences of the force analysis in the language of a catalogue."""
    return next(catalogue for catalogue in FORCE_CATALOGUES if catalogue.lang == words.lang)


__all__ = [
    "CATALOGUES",
    "FORCE_CATALOGUES",
    "ForceWording",
    "UnknownLanguageError",
    "Wording",
    "force_wording",
    "wording",
]
