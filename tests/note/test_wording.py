from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from pathlib import Path
from string import Formatter
from types import CodeType

import pytest
from doors import (
    FORCE,
    MOMENT,
    OTHER_FAMILIES,
    PROBLEM_FAMILIES as FAMILIES,
    PUSH,
    THRUST,
    WORDING_LANGUAGES as LANGUAGES,
    WRITTEN,
    AuditVerdict,
    ExitCode,
    Language,
    MessageTable,
    Notation,
    NoValue,
    UnknownLanguageError,
    get_language,
)

import planmethod

HOME = Path(planmethod.__file__).parent
CYRILLIC = re.compile("[\u0400-\u04ff]")

MARKED = re.compile(r"(?m)^# Cyrillic letters: \w")
"""A comment of a module with Cyrillic letters that are in no catalogue, with the reason."""

MACHINE = {
    "resisting moment",
    "driving moment",
    "resisting work",
    "driving work",
    "energy gain",
    "second energy",
    "first energy",
    "largest first energy",
    "reduced inertia",
    "flywheel",
    "crank inertia",
    "mean speed",
    "crank turns",
    "moment by lever",
    "motor moment",
    "power",
    "motor power",
    "braking moment",
}
"""Quantities of machines whose letters a language's `Notation` has."""

PROGRAMS = {"Word", "Moodle", "JavaScript", "Python", "CodeMirror", "JSON", "XLSX"}
"""Programs and formats that the page of the studio names in every language."""

KEYS = {"PageDown", "PageUp", "Home"}
"""Keys of the keyboard that the played construction names in every language."""


def said(words: object, path: str = "") -> Iterator[tuple[str, object]]:
    """Yield all texts of a language by place."""
    if isinstance(words, Language):
        for subject in Language.__annotations__:
            yield from said(getattr(words, subject), f"{path}.{subject}")
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
def test_a_language_has_every_sentence_of_russian_with_the_same_places(lang: str) -> None:
    russian, other = (dict(said(get_language(name))) for name in (LANGUAGES[0], lang))
    assert set(russian) == set(other)
    for path, text in russian.items():
        assert type(text) is type(other[path])
        # Rich text without places has braces of its own.
        if (
            isinstance(text, str)
            and not path.startswith(
                (".layouts", ".note[units]", ".note[symbols]", ".specimens[samples]")
            )
            and not path.endswith("[advice]")
        ):
            assert places(text) == places(str(other[path])), path


@pytest.mark.parametrize("lang", LANGUAGES)
def test_a_language_has_the_names_of_its_subjects(lang: str) -> None:
    words = get_language(lang)
    lever = {f"lever {one.quantity}" for one in (MOMENT, FORCE)}
    rubbing = {"friction force", "friction moment"}
    assert set(words.notation.symbols) == {MOMENT.symbol, FORCE.symbol} | lever | MACHINE | rubbing
    assert set(words.forces["and_balance"]) == {
        MOMENT.phrase_key,
        FORCE.phrase_key,
        PUSH.phrase_key,
    }
    assert set(words.note["balance"]) == {
        MOMENT.phrase_key,
        FORCE.phrase_key,
        PUSH.phrase_key,
        THRUST.phrase_key,
        "motor",
    }
    assert set(words.sheets["balance"]) == {MOMENT.quantity, FORCE.quantity}
    assert list(words.families) == [*FAMILIES, *OTHER_FAMILIES]
    audit = words.audit
    assert set(audit["whys"]) == {why.value for why in NoValue}
    assert list(audit["verdicts"]) == list(audit["counted"]) == [v.value for v in AuditVerdict]


def test_russian_is_russian_and_english_is_english() -> None:
    for path, text in said(get_language("en")):
        assert not CYRILLIC.search(str(text)), path
    names = re.compile(
        r"\{\w*\}|\\frac|planmethod( [a-z]+)?|toml|ГОСТ|PROBLEM|\[\w+\]|--\w+|`[^`]*`|\$\w+"
    )
    for path, text in said(get_language("ru")):
        if path.startswith((".layouts", ".note[lang]", ".note[units]", ".note[symbols]")):
            continue
        words = re.findall("[A-Za-z]{4,}", names.sub(" ", str(text)))
        named = (
            PROGRAMS if path.startswith(".studio") else KEYS if path == ".play[key_help]" else set()
        )
        assert set(words) <= {"float", "board", "grow", "true", "arctg", "atan"} | named, (
            path,
            words,
        )


def test_no_word_is_outside_the_folders_of_the_languages() -> None:
    for path in sorted(HOME.rglob("*.py")):
        if not path.is_relative_to(HOME / "note/wording"):
            is_marked = bool(MARKED.search(path.read_text("utf-8")))
            assert is_marked == any(map(CYRILLIC.search, literals(path))), path
    for path in (HOME / "render").rglob("*.toml"):
        assert not CYRILLIC.search(path.read_text(encoding="utf-8")), path


def literals(path: Path) -> Iterator[str]:
    """Yield the texts of a module's compiled code, without docstrings."""
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


WORDS = {subject: getattr(get_language(WRITTEN), subject) for subject in Language.__annotations__}


def tables(words: MessageTable) -> Iterator[MessageTable]:
    """Yield a table of words and all tables in it."""
    yield words
    for one in words.values():
        if isinstance(one, MessageTable):
            yield from tables(one)


EVERY = [table for words in WORDS.values() for table in tables(words)]


NO_KEYS = {*dir(dict), *dir(Language("en")), *WORDS}
"""Attributes of a table, or of a whole language."""


def table_of(node: ast.AST, known: Mapping[str, list[MessageTable]]) -> list[MessageTable] | None:
    """Return the tables that an expression may be; None if it is not one."""
    match node:
        case ast.Attribute(value, subject) if subject in WORDS:
            of = ast.unparse(value)
            if re.search(r"(^|\.)(words|language)$|^get_language\(.*\)$", of) and of not in known:
                return [WORDS[subject]]
        case ast.Call(ast.Name("wording")):
            return [WORDS["note"]]
        case ast.Subscript(value, ast.Constant(str(key))):
            inside = table_of(value, known)
            return (
                inside and [t[key] for t in inside if isinstance(t.get(key), MessageTable)]
            ) or None
        case ast.Attribute(ast.Name(), "texts") | ast.Attribute(_, "note_texts"):
            return known.get(ast.unparse(node), EVERY)
    return known.get(ast.unparse(node)) if isinstance(node, (ast.Name, ast.Attribute)) else None


def bound(
    nodes: Sequence[ast.AST], known: Mapping[str, list[MessageTable]]
) -> dict[str, list[MessageTable]]:
    """Return the tables that names of a function, or attributes of ``self``, may be."""
    found = dict(known)
    other: set[str] = set()
    for node in nodes:
        pairs: list[tuple[ast.AST, ast.AST]] = []
        match node:
            case ast.arg(name, ast.Name("MessageTable")):
                found[name] = EVERY
            case ast.FunctionDef(name, returns=ast.Name("MessageTable")):
                found[f"self.{name}"] = EVERY
            case ast.AnnAssign(target, ast.Name("MessageTable"), value):
                found[ast.unparse(target)] = (value and table_of(value, found)) or EVERY
            case ast.Assign([ast.Tuple(names)], ast.Tuple(values)) if len(names) == len(values):
                pairs = list(zip(names, values, strict=True))
            case ast.Assign(targets, value):
                pairs = [(target, value) for target in targets]
        for left, right in pairs:
            if words := table_of(right, found):
                found[ast.unparse(left)] = words
            else:
                other.add(ast.unparse(left))
    return {name: words for name, words in found.items() if name not in other}


def keys_read(
    module: str, nodes: Sequence[ast.AST]
) -> Iterator[tuple[str, str, list[MessageTable]]]:
    """Yield where a sentence of words is named in a module, its key, the tables it may be of."""
    of_self: dict[ast.AST, dict[str, list[MessageTable]]] = {}
    for one in nodes:
        if isinstance(one, ast.ClassDef):
            every = bound([*ast.walk(one)], {})
            own = {name: words for name, words in every.items() if name.startswith("self.")}
            of_self |= dict.fromkeys(one.body, own)
    for scope in nodes:
        if not isinstance(scope, ast.FunctionDef):
            continue
        inside = [*ast.walk(scope)]
        known = bound(inside, of_self.get(scope, {}))
        for node in inside:
            if isinstance(node, ast.Attribute) and node.attr not in NO_KEYS:
                words = table_of(node.value, known)
                if words is not None:
                    yield f"{module}:{node.lineno}", node.attr, words


USES_WORDS = re.compile("words|language|wording|texts|MessageTable")
"""What stands in every module that has a table of words: see `table_of` and `bound`."""


@cache
def code() -> tuple[list[tuple[str, str, list[MessageTable]]], set[object]]:
    """Return the keys that the package reads, and its texts and attributes; its trees are large."""
    keys: list[tuple[str, str, list[MessageTable]]] = []
    texts: set[object] = set()
    for path in sorted(HOME.rglob("*.py")):
        if "wording" not in path.parts:
            text = path.read_text("utf-8")
            nodes = [*ast.walk(ast.parse(text))]
            if USES_WORDS.search(text):
                keys += keys_read(path.relative_to(HOME).as_posix(), nodes)
            for node in nodes:
                if isinstance(node, ast.Constant):
                    texts.add(node.value)
                elif isinstance(node, ast.Attribute):
                    texts.add(node.attr)
    return keys, texts


def test_every_key_that_the_code_names_is_a_sentence() -> None:
    """A sentence is an attribute, ``language.note.lay_off``; a table ``language.note["plans"]``."""
    found, _ = code()
    assert len(found) > 1200
    wrong = [
        (where, key)
        for where, key, words in found
        if not any(isinstance(table.get(key), str) for table in words)
    ]
    assert not wrong
    methods = set(dir(dict))
    assert not [key for words in WORDS.values() for key in words if key in methods]


def test_every_sentence_is_used() -> None:
    _, texts = code()
    silent = {
        f"{subject}.{key}"
        for subject, words in WORDS.items()
        for key in words
        if key not in texts and subject not in ("layouts", "families")
    }
    assert {name for name in silent if not name.startswith("forces.side_")} == set()


def test_a_notation_writes_numbers_and_names_with_a_role() -> None:
    russian, english = (get_language(lang).notation for lang in ("ru", "en"))
    for say, text in ((russian, "−1,5·10^{−7}"), (english, "−1.5·10^{−7}")):
        assert isinstance(say, Notation)
        assert say.number("-1.5e-07") == text
        assert say.symbol("G_{2}") == "G_{2}"
    assert russian.symbol(MOMENT.symbol) == "M_{ур}"
    assert english.symbol(MOMENT.symbol) == "M_{b}"


def test_an_unknown_language_is_an_error_of_usage() -> None:
    with pytest.raises(UnknownLanguageError, match=r"'de'.*Choose one of: ru, en") as error:
        get_language("de")
    assert error.value.exit_code is ExitCode.USAGE


def test_an_index_of_several_signs_is_in_braces() -> None:
    for lang in LANGUAGES:
        for template in (get_language(lang).forces.against, get_language(lang).forces.along):
            assert template.format(point="S4").endswith("v_{S4}")
