"""Languages of all that is written, and the saying of messages in them (языки).

The languages are the folders of `planmethod.note.wording`; the sentences of messages are in the
code in English, which is their key in the folders of the other languages.
"""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from functools import cache
from itertools import pairwise
from pathlib import Path
from string import Formatter
from typing import Any

WORDING = Path(__file__).parent / "note" / "wording"
"""Folder of the languages."""

LANGUAGES = tuple(
    sorted(
        (path.parent.name for path in WORDING.glob("*/note.toml")),
        key=lambda lang: (lang != "ru", lang),
    )
)
"""Their names; the first is that of a sheet drawn from Python where its file names none."""

WRITTEN = "en"
"""Language of the sentences in the code."""

OWN_VARIABLE = "PLANMETHOD_LANG"
"""Variable of the environment that names the language of this program."""

SYSTEM_VARIABLES = ("LC_ALL", "LC_MESSAGES", "LANG")
"""Variables that name the language of the system, the first that outranks the others."""

_LANGUAGE: ContextVar[str] = ContextVar("language", default=WRITTEN)
"""Language of the current context: threads and tasks may use different ones at once."""


class _Translated(str):
    """Translated sentence; translating it again changes nothing (сказанное)."""

    __slots__ = ()


class _Sentences(Formatter):
    """Puts facts into sentences; ``{0:|fault|faults}`` is the form that goes with a number."""

    def format_field(self, value: Any, format_spec: str) -> str:
        """Return a fact as its place wants it."""
        if not format_spec.startswith("|"):
            return format(value, format_spec)
        forms, number = format_spec[1:].split("|"), abs(int(value))
        if len(forms) == 2:  # English
            return forms[number != 1]
        if number % 10 in (0, 5, 6, 7, 8, 9) or number % 100 in (11, 12, 13, 14):
            return forms[2]
        return forms[number % 10 > 1]


_SENTENCES = _Sentences()


def translate(sentence: str, *facts: object, **named: object) -> str:
    """Translate a sentence into the current language.

    Parameters
    ----------
    sentence : str
        In English, with places for the facts as in `str.format`: the key of the other languages.
        Without facts it is used unchanged, braces included.
    *facts, **named : object
        Facts that are English phrases themselves are translated.
    """
    if isinstance(sentence, _Translated):
        return sentence
    text = look_up_translation(sentence)
    if facts or named:
        if current_language() != WRITTEN:  # one word may be a name
            facts = tuple(
                look_up_translation(f) if isinstance(f, str) and " " in f else f for f in facts
            )
        fill = _SENTENCES.format if ":|" in text else str.format
        text = visible(fill(text, *facts, **named))
    return _Translated(text)


HIDDEN = (
    "[\0-\x08\x0b-\x1f\x7f-\x9f\xad\u034f\u061c\u115f\u1160\u17b4\u17b5\u180b-\u180f\u200b-\u200f"
    "\u2028-\u202e\u2060-\u206f\u3164\ud800-\udfff\ufe00-\ufe0f\ufeff\uffa0\ufff0-\ufffb"
    "\U0001bca0-\U0001bca3\U0001d173-\U0001d17a\U000e0000-\U000e0fff]"
)
"""Characters of untrusted texts that are not printed: control and direction codes, surrogates, and
letters without a width, which make texts differ that look the same."""


def visible(text: str) -> str:
    """Return a text with a sign in place of each invisible control character."""
    return re.sub(HIDDEN, "\ufffd", text)


def look_up_translation(sentence: str) -> str:
    """Return the template of a sentence in the current language.

    Only the message catalogues that have the sentence as a key are parsed.
    """
    lang = current_language()
    if lang != WRITTEN:
        import json

        key = f"{json.dumps(sentence, ensure_ascii=False)} = "  # as TOML writes a string, too
        for room, text in _messages(lang).items():
            if key in text:
                return str(catalogue(lang, f"messages/{room}").get(sentence, sentence))
    return sentence


@cache
def _messages(lang: str) -> Mapping[str, str]:
    """Return the text of each catalogue of messages of a language, by its name."""
    paths = sorted((WORDING / lang / "messages").glob("*.toml"))
    return {path.stem: path.read_text(encoding="utf-8") for path in paths}


@cache
def typed() -> Mapping[str, tuple[str, ...]]:
    """Return the keys and words of files by their spellings in any language."""
    found: dict[str, tuple[str, ...]] = {}
    for path in sorted(WORDING.glob("*/typed.toml")):
        for key, words in catalogue(path.parent.name, "typed").items():
            for word in words.split(", "):
                found[word] = (*found.get(word, ()), key)
    return found


@cache
def catalogue(lang: str, name: str) -> dict[str, Any]:
    """Return the texts of one file of a language, unchanged."""
    import tomllib

    return tomllib.loads((WORDING / lang / f"{name}.toml").read_text(encoding="utf-8"))


def current_language() -> str:
    """Return the current language of messages."""
    return _LANGUAGE.get()


def choose_language(args: Sequence[str], environ: Mapping[str, str] = os.environ) -> str:
    """Return the language of the messages for a command line (язык сообщений).

    That of ``--lang``, else of `OWN_VARIABLE`, else the system's; English where that is none of
    `LANGUAGES`. What is written of a problem has the same rule, with ``[sheet] lang`` of its file
    before the system's: `named_language`.
    """
    names = [word.partition("=")[2] for word in args if word.startswith("--lang=")]
    names += [after for word, after in pairwise(args) if word == "--lang"]
    named = next(filter(None, map(known_language, names)), None)
    return named_language(named, environ) or _system_language(environ) or WRITTEN


def named_language(option: str | None, environ: Mapping[str, str] = os.environ) -> str | None:
    """Return the language that the user names: by ``--lang``, else by `OWN_VARIABLE`."""
    return option or known_language(environ.get(OWN_VARIABLE, ""))


def _system_language(environ: Mapping[str, str]) -> str | None:
    """Return the language of the system; None if not one of `LANGUAGES`."""
    name = next(filter(None, (environ.get(name) for name in SYSTEM_VARIABLES)), "")
    if not name and sys.platform == "win32":
        import locale

        name = locale.getlocale()[0] or ""  # Russian_Russia, English_United States
    return known_language(name)


def known_language(name: str) -> str | None:
    """Return the one of `LANGUAGES` that a name of a locale means, such as ``ru_RU.UTF-8``."""
    code = re.split(r"[-_.@]", name)[0].lower()
    known = {lang: lang for lang in LANGUAGES} | {"russian": "ru", "english": "en"}
    return known.get(code)


@contextmanager
def speaking(lang: str) -> Iterator[None]:
    """Use a language for a while, in this thread. Default: English."""
    before = _LANGUAGE.set(lang)
    try:
        yield
    finally:
        _LANGUAGE.reset(before)
