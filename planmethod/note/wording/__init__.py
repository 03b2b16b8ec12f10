"""Catalogues of sentences, one module per language."""

from __future__ import annotations

from planmethod.errors import ExitCode, PlanMethodError
from planmethod.note.wording.en import EN
from planmethod.note.wording.model import Wording
from planmethod.note.wording.ru import RU

CATALOGUES: tuple[Wording, ...] = (RU, EN)


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


__all__ = ["CATALOGUES", "UnknownLanguageError", "Wording", "wording"]
