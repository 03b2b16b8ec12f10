"""Every message has a translation in every language; messages are found in the source."""

from __future__ import annotations

import ast
import inspect
import re
import subprocess
import sys
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from string import Formatter

import click
import polib
import pytest
from cases import each
from click.testing import CliRunner
from doors import (
    COMMANDS,
    LANGUAGES_LANGUAGES as LANGUAGES,
    TITLE_BLOCK,
    TITLE_BLOCK_IN,
    WRITTEN,
    NumberKey,
    PlanMethodError,
    catalogue,
    choose_language,
    cli,
    command_of,
    declared,
    keys,
    kinds_load as load,
    look_up_translation,
    speaking,
    translate,
)

import planmethod

HOME = Path(planmethod.__file__).parent
WORDING = HOME / "note" / "wording"
OTHERS = [lang for lang in LANGUAGES if lang != WRITTEN]
FAULTY = sorted((HOME.parent / "tests" / "problem" / "faulty").glob("*.toml"))

DECLARED = [one.key for record in keys.FLAT.values() for one in declared(record)]
NUMBERS = [key for key in DECLARED if isinstance(key, NumberKey)]
REFERENCE = {
    *(text for key in DECLARED for text in (key.sentence, key.absent)),
    *(key.noun for key in NUMBERS if key.unit),  # printed with the unit
    *TITLE_BLOCK.values(),
    *TITLE_BLOCK_IN.values(),
}
"""Texts of the reference of keys, which are not messages."""

SAYS = {
    "translate", "look_up_translation", "Fault", "_fail", "_fault", "_load_fault", "UsageError",
}  # fmt: skip
"""Calls whose texts a reader sees, beside errors that are raised."""

NOTES = {
    "note", "note_value", "note_missing", "note_unknown", "reject", "reject_value",
    "reject_unknown", "require_at_most", "tables", "array", "number", "known_name", "any_name",
}  # fmt: skip
"""Methods of a `FileNode` that take texts of faults."""

MARKED = re.compile(r"# no messages: \w")
"""A comment where no reader sees the English texts as messages, with the reason: above the imports
of a module it speaks of all of it, elsewhere of the statement that it stands above."""

READS = re.compile(
    r"(?!<)"  # HTML
    r"(?:(a|an|the) [a-z]{2}"  # the beginning of a phrase
    r"|[A-Z].* .*\.$"  # a whole sentence
    r"|(?=.*\{[\w.\[\]]*[!:}])(?=.*\b[a-z]{3,} |.* [a-z]{3,}\b))"  # words and places
)
"""A text that reads as a message, or a part of one."""

SENTENCE = re.compile(r"(?=.*[a-z]{2})(?!.*=).*(\S \S|\.$)", re.DOTALL)
"""Form of a message in a call: several words, and no TOML."""

PLAIN_ENGLISH = re.compile(r"\b(the|is|are|an|of|not|and|or|with|has|expected|must|give|to)\b")


def is_said(call: ast.Call) -> bool:
    """Return whether the texts of a call are messages."""
    name = call.func.id if isinstance(call.func, ast.Name) else getattr(call.func, "attr", "")
    is_method = isinstance(call.func, ast.Attribute)
    return name in SAYS or name.endswith("Error") or (is_method and name in NOTES)


def without_messages(text: str, tree: ast.Module) -> list[ast.stmt]:
    """Return the statements of a module that are marked."""
    lines = text.split("\n")
    starts = {
        one: min(n.lineno for n in [one, *getattr(one, "decorator_list", [])]) for one in tree.body
    }
    first = min(
        (starts[one] for one in tree.body if isinstance(one, ast.Import | ast.ImportFrom)),
        default=0,
    )
    if any(map(MARKED.match, lines[:first])):
        return tree.body
    return [one for one, start in starts.items() if MARKED.match(lines[start - 2])]


@cache
def source() -> tuple[dict[str, str], dict[str, str], set[str]]:
    """Return the messages of the source, f-strings that read as messages, and all texts."""
    said: dict[str, str] = {}
    formatted: dict[str, str] = {}
    every: set[str] = set()
    for path in sorted(HOME.rglob("*.py")):
        module = path.relative_to(HOME).as_posix()
        text = path.read_text("utf-8")
        tree = ast.parse(text)
        marked = without_messages(text, tree)
        is_quiet = marked == tree.body and not re.search(r"(Error|Fault)\(", text)
        if module.startswith("note/wording/") or is_quiet:
            continue
        inside: set[ast.AST] = set()
        direct: set[ast.AST] = set()
        nodes = list(ast.walk(tree))
        silent = {node for one in marked for node in ast.walk(one)}
        for node in nodes:
            match node:
                case ast.Expr(ast.Constant(str(told)) as value):  # a docstring
                    every.add(inspect.cleandoc(told))
                    inside.add(value)
                case ast.JoinedStr():
                    inside |= {part for part in ast.walk(node) if part is not node}
                case ast.Assert(msg=ast.Constant() as value):
                    inside.add(value)
                case ast.Call() if is_said(node):
                    direct |= set(node.args)
                case ast.keyword("hint" | "what" | "said" | "of" | "message", value):
                    direct.add(value)
        for node in nodes:
            where = f"{module}:{getattr(node, 'lineno', 0)}"
            match node:
                case ast.Constant(str(told)) if node not in inside:
                    every.add(told)
                    message = node in direct and SENTENCE.match(told)
                    if (
                        (message or READS.match(told))
                        and told not in REFERENCE
                        and node not in silent
                    ):
                        said.setdefault(told, where)
                case ast.JoinedStr() if node not in silent:
                    parts = [part.value for part in node.values if isinstance(part, ast.Constant)]
                    words = " ".join(map(str, parts))
                    if re.search(r"[a-z]{3,} +[a-z]{3,}|[A-Za-z]{3,} [a-z]{2,}", words):
                        formatted[where] = ast.unparse(node)
    for key in NUMBERS:
        said.setdefault(key.expected, "a declared key")
        every.add(key.expected)
    return said, formatted, every


def messages(lang: str) -> dict[str, str]:
    """Return the messages of a language; each is in one catalogue only."""
    found: dict[str, str] = {}
    for path in (WORDING / lang / "messages").glob("*.toml"):
        room = catalogue(lang, f"messages/{path.stem}")
        assert not found.keys() & room.keys(), "given twice"
        found |= room
    return found


def places(text: str) -> tuple[set[str], set[str]]:
    """Return the places of a sentence for facts, and those that only give a word its form."""
    found: dict[str, bool] = {}
    for number, (_, name, spec, _) in enumerate(
        p for p in Formatter().parse(text) if p[1] is not None
    ):
        key = name or str(number)
        found[key] = found.get(key, False) or not (spec or "").startswith("|")
    return {key for key, shown in found.items() if shown}, set(found)


@pytest.mark.parametrize("lang", OTHERS)
def test_every_message_is_translated_into_every_language(lang: str) -> None:
    said, formatted, _ = source()
    assert len(said) > 700
    known = messages(lang)
    missing = [f"{where}: {text}" for text, where in said.items() if text not in known]
    assert not missing, "add these to the catalogue of messages, or say # no messages: why"
    assert not formatted, "a message is a sentence with places that say() fills in"


@pytest.mark.parametrize("lang", OTHERS)
def test_every_message_of_a_catalogue_is_found(lang: str) -> None:
    """Its key is the English sentence of the source."""
    with speaking(lang):
        for english, other in messages(lang).items():
            assert look_up_translation(english) == other


@pytest.mark.parametrize("lang", OTHERS)
def test_every_translated_message_is_used(lang: str) -> None:
    foreign = catalogue(lang, "messages/foreign")
    assert set(messages(lang)) - set(foreign) <= source()[2]


@pytest.mark.parametrize("lang", OTHERS)
def test_a_message_has_the_same_places_in_every_language(lang: str) -> None:
    for english, other in messages(lang).items():
        if english not in source()[0] or not re.search(r"\{[\w.\[\]]*[!:}]", english):
            continue
        shown, all_of_them = places(english)
        there, those = places(other)
        assert shown <= those <= all_of_them, english
        assert there <= all_of_them, english
        for _, _, spec, _ in Formatter().parse(other):
            assert "|" not in (spec or "") or str(spec).startswith("|"), (
                f"{{0:|form|forms}}: {other}"
            )


@pytest.mark.parametrize("lang", OTHERS)
def test_the_sentences_of_click_are_compiled(lang: str) -> None:
    folder = WORDING / lang / "LC_MESSAGES"
    written, compiled = polib.pofile(folder / "click.po"), polib.mofile(folder / "click.mo")

    def told(one: polib.POEntry) -> tuple[str, str, str, dict[int, str]]:
        return one.msgid, one.msgid_plural, one.msgstr, one.msgstr_plural

    assert sorted(map(told, written)) == sorted(map(told, compiled)), "make messages"
    for one in written:
        for other in (one.msgstr, *one.msgstr_plural.values()):
            named = {place for _, place, _, _ in Formatter().parse(other) if place}
            assert named <= set(re.findall(r"\{(\w+)", one.msgid + one.msgid_plural)), one.msgid


def helps() -> Iterator[str]:
    """Yield the help of the commands and their options, and that of the program."""
    for command in (cli, *map(command_of, COMMANDS)):
        yield inspect.cleandoc(command.help or "")
        for param in command.params:
            if isinstance(param, click.Option) and param.help:
                yield param.help


@pytest.mark.parametrize("lang", OTHERS)
def test_help_is_in_every_language(lang: str) -> None:
    assert set(helps()) <= set(messages(lang))


def test_the_help_is_shown_in_russian() -> None:
    shown = CliRunner().invoke(cli, ["--lang", "ru", "--help"]).output
    assert "Вызов:" in shown
    assert "Начало работы:" in shown and re.search(r"\[КЛЮЧИ\] \[?КОМАНДА", shown)
    assert "Показать эту справку и выйти." in shown
    assert not PLAIN_ENGLISH.search(shown)
    for name in COMMANDS:  # metavariables, too, but not words of files
        shown = CliRunner().invoke(cli, [name, "--help", "--lang", "ru"]).output
        assert not re.search(r"^  +(?:-\S+ )+\[?[A-Z]{4,}|^Вызов: .*\b[A-Z]{4,}", shown, re.M), name
    one = CliRunner().invoke(cli, ["solve", "--lang=ru", "--hlep"])
    assert one.exit_code == 2
    assert "Ошибка: Нет ключа '--hlep'." in one.output
    other = CliRunner().invoke(cli, ["solve", "--lang=en", "--hlep"])
    assert "Error: No such option '--hlep'." in other.output
    for lang, kind in (("ru", "Папка"), ("en", "Directory"), ("ru", "Папка")):  # switched each time
        told = CliRunner().invoke(cli, ["sheet", "x.toml", "--lang", lang, "-o", __file__]).output
        assert kind in told
    assert "Usage:" in CliRunner().invoke(cli, ["--help"]).output  # as before


@each("path", FAULTY)
def test_the_faults_of_a_file_are_reported_in_russian(path: Path) -> None:
    """No part of a message stays English; texts in quotes or braces come from the file."""
    with speaking("ru"), pytest.raises(PlanMethodError) as caught:
        load(path)
    told = str(caught.value).split("\n", 1)[1]
    ours = re.sub(r"«[^»]*»|'[^']*'|\"[^\"]*\"|\{[^}]*\}|[\w.]+ = [^,\n]*", "", told)
    assert not PLAIN_ENGLISH.search(ours), ours


def test_a_table_is_the_same_in_every_language(tmp_path: Path) -> None:
    """The reasons of empty cells are part of a file; the warning is in the user's language."""
    text = (HOME.parent / "problems" / "linkages" / "ex1.toml").read_text("utf-8")
    file = tmp_path / "short.toml"
    file.write_text(text.replace("BC = 0.1", "BC = 0.028"), "utf-8")
    asked = ["solve", str(file), "--phi", "0:360:30", "--partial", "--csv"]
    one, other = (CliRunner().invoke(cli, ["--lang", lang, *asked]) for lang in ("ru", "en"))
    assert one.stdout == other.stdout
    assert "does not reach the guide" in one.stdout
    assert "невозможны и оставлены пустыми" in one.stderr


def test_python_runs_the_package() -> None:
    words = [sys.executable, "-m", "planmethod", "--lang", "ru"]
    done = subprocess.run(words, capture_output=True, encoding="utf-8", cwd=HOME.parent)
    assert done.returncode == 0
    assert "Начните так" in done.stdout


def test_words_go_with_their_numbers() -> None:
    head = "{0}: {1} fault{1:||s} in the problem file"
    assert [translate(head, "a", n).split()[2] for n in (1, 2, 21)] == ["fault", "faults", "faults"]
    with speaking("ru"):
        told = [translate(head, "a", n).split()[2] for n in (1, 2, 5, 11, 21, 22, 112)]
    assert told == ["ошибка", "ошибки", "ошибок", "ошибок", "ошибка", "ошибки", "ошибок"]


def test_texts_of_a_file_are_left_unchanged() -> None:
    with speaking("ru"):
        once = translate("the mechanism has no '{}'", "missing {0}")
        assert once == "в механизме нет имени «missing {0}»"
        assert translate(once) == once
        assert translate("nobody knows {this}") == "nobody knows {this}"


def test_the_language_can_be_selected() -> None:
    cases: list[tuple[str, dict[str, str], str]] = [
        ("", {}, "en"),
        ("solve --lang en", {"PLANMETHOD_LANG": "ru"}, "en"),
        ("solve --lang=en", {}, "en"),
        ("", {"PLANMETHOD_LANG": "EN", "LANG": "ru_RU.UTF-8"}, "en"),
        ("", {"LANG": "en_US.UTF-8"}, "en"),
        ("", {"LC_ALL": "C", "LANG": "en_GB"}, "en"),
        ("", {"LC_ALL": "POSIX", "LC_MESSAGES": "ru_RU"}, "en"),
        ("", {"LC_MESSAGES": "ru_RU", "LANG": "en_US"}, "ru"),
        ("", {"LANG": "kk_KZ.UTF-8"}, "en"),
        ("--lang", {"PLANMETHOD_LANG": "nonsense"}, "en"),
        ("--lang", {"PLANMETHOD_LANG": "nonsense", "LANG": "ru_RU"}, "ru"),
    ]
    for words, environ, lang in cases:
        assert choose_language(words.split(), environ) == lang, (words, environ)
