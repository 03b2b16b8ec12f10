from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from string import Formatter
from types import CodeType

import pytest
from msgspec import Struct

import planmethod
from planmethod.errors import ExitCode
from planmethod.note.audit.audit import Verdict
from planmethod.note.numbers import Notation
from planmethod.note.wording import LANGUAGES, Language, UnknownLanguageError, language
from planmethod.note.wording.force_model import ForceWording
from planmethod.note.wording.machine_model import SYMBOLS as MACHINE
from planmethod.problem import FAMILIES, OTHER_FAMILIES
from planmethod.problem.model import FORCE, MOMENT
from planmethod.solved.selected.asking import NoAnswer

HOME = Path(planmethod.__file__).parent
CYRILLIC = re.compile("[\u0400-\u04ff]")

NO_WORDS = {
    "check/task.py": "letters that quantities are written with in works of students",
    "check/judge.py": "the unit mm, as works of students write it",
    "check/works/cells.py": "heads and words that works of students are written with",
    "check/works/units.py": "units, multiplication signs and e that they are written with",
    "check/works/gather.py": "scales that they are written with",
    "problem/variants.py": "units as the head of a table may have them",
    "problem/names.py": "Cyrillic letters that look like Latin ones, in names of problem files",
    "problem/flat.py": "type \u0411 of the lettering in a problem file",
    "problem/sheet.py": "an example of a surname",
    "paper.py": "names of formats that files and options may write in Cyrillic letters",
    "render/sheets/specimen/lettering.py": "the letters themselves, one by one",
    "render/ink/lettering/__init__.py": "letters that the lettering is measured by",
}
"""Where Cyrillic letters stand that no language says to a reader, and why."""

TERMS = {
    "commands/asked.py",
    "commands/solve.py",
    "problem/selector.py",
    "problem/forces.py",
    "problem/head.py",
    "problem/links.py",
    "problem/load_records.py",
    "problem/model.py",
    "render/sheets/composition/reader.py",
}
"""Where English help and messages quote what a file may say, or a field term in brackets."""


def said(words: object, path: str = "") -> Iterator[tuple[str, object]]:
    """Yield all that a language says, by its place."""
    if isinstance(words, Language):
        for subject in Language.__annotations__:
            yield from said(getattr(words, subject), f"{path}.{subject}")
    elif isinstance(words, Struct):
        for name in words.__struct_fields__:
            yield from said(getattr(words, name), f"{path}.{name}")
    elif isinstance(words, Mapping):
        for key, value in words.items():
            yield from said(value, f"{path}[{key}]")
    elif isinstance(words, tuple) and not path.endswith(".intro"):
        for key, value in enumerate(words):
            yield from said(value, f"{path}[{key}]")
    else:
        yield path, words


def places(text: str) -> set[str]:
    return {name for _, name, _, _ in Formatter().parse(text) if name is not None}


@pytest.mark.parametrize("lang", LANGUAGES[1:])
def test_a_language_says_all_that_russian_says_with_the_same_places(lang: str) -> None:
    russian, other = (dict(said(language(name))) for name in (LANGUAGES[0], lang))
    assert set(russian) == set(other)
    for path, text in russian.items():
        assert type(text) is type(other[path])
        # Rich text without places has braces of its own.
        if isinstance(text, str) and not path.startswith(
            (".say", ".layouts", ".specimens.samples")
        ):
            assert places(text) == places(str(other[path])), path


@pytest.mark.parametrize("lang", LANGUAGES)
def test_a_language_has_the_names_of_what_it_tells(lang: str) -> None:
    words = language(lang)
    lever = {f"lever {one.quantity}" for one in (MOMENT, FORCE)}
    assert set(words.say.symbols) == {MOMENT.symbol, FORCE.symbol, *lever, *MACHINE}
    for balance in (words.note.balance, words.sheets.balance, words.forces.and_balance):
        assert set(balance) == {MOMENT.quantity, FORCE.quantity}
    assert list(words.families) == [*FAMILIES, *OTHER_FAMILIES]
    assert set(words.audit.whys) == {why.value for why in NoAnswer}
    assert list(words.audit.verdicts) == list(words.audit.counted) == [v.value for v in Verdict]


def test_russian_is_russian_and_english_is_english() -> None:
    for path, text in said(language("en")):
        assert not CYRILLIC.search(str(text)), path
    names = re.compile(r"\{\w*\}|planmethod|toml|ГОСТ|PROBLEM|\[\w+\]|--\w+|`[^`]*`|\$\w+")
    for path, text in said(language("ru")):
        if path.startswith((".say", ".lang", ".layouts", ".note.lang", ".forces.lang")):
            continue
        words = re.findall("[A-Za-z]{4,}", names.sub(" ", str(text)))
        assert set(words) <= {"float", "board", "grow", "true"}, (path, words)


def test_no_word_stands_outside_the_folders_of_the_languages() -> None:
    found = set()
    for path in sorted(HOME.rglob("*.py")):
        name = path.relative_to(HOME).as_posix()
        if not name.startswith("note/wording/") and any(map(CYRILLIC.search, literals(path))):
            found.add(name)
    assert found == {*NO_WORDS, *TERMS}
    for path in (HOME / "render").rglob("*.toml"):
        assert not CYRILLIC.search(path.read_text(encoding="utf-8")), path


def literals(path: Path) -> Iterator[str]:
    """Yield the texts of a module that are no docstrings: those that its code keeps."""
    text = path.read_text(encoding="utf-8")
    if not CYRILLIC.search(text):
        return
    codes = [compile(text, path.name, "exec", optimize=2, dont_inherit=True)]
    while codes:
        for kept in codes.pop().co_consts:
            if isinstance(kept, CodeType):
                codes.append(kept)
            else:
                yield from _texts(kept)


def _texts(kept: object) -> Iterator[str]:
    if isinstance(kept, str):
        yield kept
    elif isinstance(kept, (tuple, frozenset)):
        for one in kept:
            yield from _texts(one)


def test_every_sentence_of_the_forces_is_said() -> None:
    source = "".join(path.read_text("utf-8") for path in (HOME / "note").rglob("*.py"))
    for name in ForceWording.__struct_fields__:
        other = name == "lang" or name.startswith("side_")  # these are put together
        assert other or re.search(rf"(said\.|\"){name}\b", source), name


def test_a_notation_writes_numbers_and_names_what_has_a_role() -> None:
    russian, english = (language(lang).say for lang in ("ru", "en"))
    for say, text in ((russian, "−1,5·10^{−7}"), (english, "−1.5·10^{−7}")):
        assert isinstance(say, Notation)
        assert say.number("-1.5e-07") == text
        assert say.symbol("G_{2}") == "G_{2}"
    assert russian.symbol(MOMENT.symbol) == "M_{ур}"
    assert english.symbol(MOMENT.symbol) == "M_{b}"


def test_an_unknown_language_is_an_error_of_usage() -> None:
    with pytest.raises(UnknownLanguageError, match=r"'de'.*Choose one of: ru, en") as error:
        language("de")
    assert error.value.exit_code is ExitCode.USAGE
