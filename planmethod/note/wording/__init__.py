"""All texts for readers: a folder for each language, a catalogue for each subject (фразы).

The catalogues are TOML, their sentences templates of `str.format` with named places. Keys and
places are the same in every language; `tests/note/test_wording.py` compares them, and looks for
the keys that the code names. The messages that `planmethod.languages.translate` translates by their
English sentence are in the folder ``messages`` of the other languages.
"""

from __future__ import annotations

from functools import cache, cached_property
from typing import TYPE_CHECKING, Any

from planmethod.errors import ExitCode, PlanMethodError
from planmethod.languages import LANGUAGES, catalogue
from planmethod.note.numbers import Notation, raised


class UnknownLanguageError(PlanMethodError):
    """The requested language has no catalogues (неизвестный язык)."""

    exit_code = ExitCode.USAGE


class MessageTable(dict[str, Any]):
    """A table of a catalogue; its keys are attributes, too: sentences, tuples of them, tables."""

    __slots__ = ()

    def __getattr__(self, key: str) -> str:
        """Return the words of a key."""
        try:
            return self[key]  # type: ignore[no-any-return]
        except KeyError:
            raise AttributeError(f"no words {key!r} among {', '.join(self)}") from None


class Language:
    """A language, passed to all code that writes in it (язык).

    The catalogue of a subject is read when it is first used.

    Attributes
    ----------
    lang : str
        Its name, that of its folder.
    note : MessageTable
        Protocol and tables; with the data of `notation`.
    forces, friction, springs : MessageTable
        The force analysis, friction, springs and dampers.
    sheets, structure, frame : MessageTable
        Sheets of the plans, the structural sheet, frame and title block.
    control : MessageTable
        The drawing-standards check.
    specimens, audit : MessageTable
    check, form : MessageTable
        The checking of submissions; the form to fill in, and unreadable parts of submissions.
    point, cycle, machine, synthesis : MessageTable
        The moving point, the cycle of a crank, a machine and its flywheel, syntheses.
    gears, teeth, meshing : MessageTable
        Gear trains, the choice of their teeth, two wheels in mesh.
    cam : MessageTable
        A cam and its follower.
    analytic : MessageTable
        The analytic method.
    calculation : MessageTable
        The calculation as a workbook with formulas and as a notebook.
    vary : MessageTable
        Variants chosen by the program.
    live, play : MessageTable
        The page of a moving mechanism, the page of a played construction.
    project : MessageTable
        The course project.
    document, report : MessageTable
        Words of a note around its figures, tables and names; the explanatory note itself.
    studio : MessageTable
        The page of the studio.
    defence : MessageTable
        Questions for the defence.
    layouts, families, tasks : MessageTable
        The shipped layouts by the places of their files, the families of ready problem files,
        the list of shipped tasks.
    """

    note: MessageTable
    forces: MessageTable
    friction: MessageTable
    springs: MessageTable
    sheets: MessageTable
    structure: MessageTable
    frame: MessageTable
    control: MessageTable
    specimens: MessageTable
    audit: MessageTable
    check: MessageTable
    form: MessageTable
    point: MessageTable
    gears: MessageTable
    cycle: MessageTable
    machine: MessageTable
    meshing: MessageTable
    cam: MessageTable
    synthesis: MessageTable
    teeth: MessageTable
    live: MessageTable
    play: MessageTable
    project: MessageTable
    document: MessageTable
    report: MessageTable
    defence: MessageTable
    layouts: MessageTable
    families: MessageTable
    tasks: MessageTable
    analytic: MessageTable
    calculation: MessageTable
    vary: MessageTable
    studio: MessageTable

    def __init__(self, lang: str) -> None:
        self.lang = lang

    @cached_property
    def notation(self) -> Notation:
        """Numbers, units and symbols."""
        said = catalogue(self.lang, "numbers")
        return Notation(
            decimal=said["decimal"],
            units={name: raised(unit) for name, unit in said["units"].items()},
            symbols=said["symbols"],
            degrees=said["degrees"],
        )

    if not TYPE_CHECKING:  # a name not declared above is not a subject

        def __getattr__(self, subject: str) -> MessageTable:
            """Read the catalogue of a subject."""
            if subject not in Language.__annotations__:
                raise AttributeError(f"a language has no {subject!r}")
            read = catalogue(self.lang, subject)
            if subject == "note":
                read = catalogue(self.lang, "numbers") | read
            words = _message_tables(read)
            setattr(self, subject, words)
            return words


def _message_tables(read: Any) -> Any:
    """Return what was read from a catalogue with tuples for lists."""
    if isinstance(read, dict):
        return MessageTable((key, _message_tables(value)) for key, value in read.items())
    return tuple(map(_message_tables, read)) if isinstance(read, list) else read


@cache
def get_language(lang: str) -> Language:
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


def wording(lang: str) -> MessageTable:
    """Return the sentences of protocol and tables in a language.

    Raises
    ------
    UnknownLanguageError
    """
    return get_language(lang).note


__all__ = [
    "LANGUAGES",
    "Language",
    "MessageTable",
    "UnknownLanguageError",
    "get_language",
    "wording",
]
