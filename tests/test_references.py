"""The generated pages of the reference are those of the program, in both languages."""

from __future__ import annotations

import json
import re
import tomllib
from pathlib import Path
from typing import Any

import click
import pytest
from cases import each
from doors import COMMANDS, ExitCode, command_of, get_language, keys
from worked import ROOT

from planmethod.errors import EXIT_CODES
from scripts.reference import catalogues, markdown, pages, schema
from scripts.reference.keys import HEADINGS, sentences

LANGUAGES = tuple(pages.FOLDERS)
PAGES = [(name, lang) for name in pages.PAGES for lang in LANGUAGES]


def text_of(name: str, lang: str) -> str:
    return pages.path_of(name, lang).read_text("utf-8")


@each("name, lang", PAGES)
def test_a_page_is_current(name: str, lang: str) -> None:
    assert text_of(name, lang) == pages.text_of(name, lang), "run make reference"


def test_the_list_of_decisions_is_current() -> None:
    assert pages.DECISIONS.read_text("utf-8") == pages.decisions_text()


def test_the_schema_is_current() -> None:
    assert schema.SCHEMA.read_text("utf-8") == schema.schema_text(), "run make reference"
    russian = schema.RUSSIAN_SCHEMA.read_text("utf-8")
    assert russian == schema.russian_schema_text(), "run make reference"


@pytest.mark.parametrize("name", pages.PAGES)
def test_a_page_has_the_same_sections_in_both_languages(name: str) -> None:
    counts = {len(re.findall(r"(?m)^##+ ", text_of(name, lang))) for lang in LANGUAGES}
    assert len(counts) == 1


@each("name, lang", PAGES)
def test_a_page_is_marked_and_has_whole_rows(name: str, lang: str) -> None:
    text = text_of(name, lang)
    assert text.startswith(f"{markdown.MARK}\n\n# ")
    for table in re.findall(r"(?m)(?:^\|.*\n)+", text):
        bars = {line.replace(r"\|", "").count("|") for line in table.splitlines()}
        assert len(bars) == 1, table.splitlines()[0]


@pytest.mark.parametrize("lang", LANGUAGES)
def test_every_mistake_has_a_row(lang: str) -> None:
    """A new letter of codes needs a title in scripts/reference/texts.toml."""
    rows = re.findall(r"(?m)^\| `", text_of("mistakes", lang))
    assert len(rows) == len(get_language(lang).check["mistakes"])


# Keys --------------------------------------------------------------------------------------------


@pytest.mark.parametrize("lang", LANGUAGES)
def test_every_key_has_a_row_in_its_table(lang: str) -> None:
    parts = re.split(r"(?m)^## (.*)\n", text_of("keys", lang))
    tables = dict(zip(parts[1::2], parts[2::2], strict=True))
    top = markdown.words("keys", lang)["top"]
    assert list(tables) == [top, *HEADINGS.values()]
    for kind in keys.KINDS:
        rows = re.findall(r"(?m)^\| `([^`]+)` \|", tables[HEADINGS.get(kind, top)])
        assert own_keys(kind) <= set(rows), kind
        assert len(set(rows)) == len(rows), kind


def own_keys(kind: str) -> set[str]:
    """Return the keys of a table without those of the table that it extends."""
    other = keys.EXTENDED.get(kind)
    return {*keys.known(kind)} - ({*keys.known(other)} if other else set())


def test_every_key_has_a_sentence_in_both_languages() -> None:
    assert set(schema.PLACES) == {*keys.KINDS, "law"}
    whole: dict[str, Any] = json.loads(schema.SCHEMA.read_text("utf-8"))
    for kind in schema.PLACES:
        english, russian = sentences(kind, "en"), sentences(kind, "ru")
        assert list(english) == list(russian), kind
        found = {*schema.table_at(whole, kind)["properties"]}
        extended = {*sentences(keys.EXTENDED[kind], "en")} if kind in keys.EXTENDED else set()
        assert found <= {*english} | extended, kind
        assert all(re.search("[а-яё]", one) for one in russian.values()), kind


def test_no_sentence_is_left_over() -> None:
    for lang in LANGUAGES:
        kinds = set(markdown.data(f"keys.{lang}"))
        assert kinds <= {*schema.PLACES, "schema"}, kinds
        assert set(markdown.words("keys", lang)["tables"]) == set(schema.PLACES)
    english = schema.SCHEMA.read_text("utf-8")
    said = {json.dumps(text, ensure_ascii=False) for text in markdown.data("keys.ru")["schema"]}
    assert {text for text in said if text not in english} == set()


# Commands ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("lang", LANGUAGES)
def test_every_command_and_option_is_listed(lang: str) -> None:
    text = text_of("commands", lang)
    assert re.findall(r"(?m)^### (.*)$", text) == list(COMMANDS)
    for name in COMMANDS:
        (section,) = re.findall(rf"(?ms)^### {name}\n(.*?)(?=^##|\Z)", text)
        assert f"\nplanmethod {name} " in section
        for param in command_of(name).params:
            if isinstance(param, click.Option) and not param.hidden:
                assert all(f"`{flag}`" in section for flag in param.opts), (name, param.opts)


@pytest.mark.parametrize("lang", LANGUAGES)
def test_every_exit_code_is_listed(lang: str) -> None:
    listed = re.findall(r"(?m)^\| (\d) \|", text_of("exit-codes", lang))
    assert listed == [str(int(code)) for code in ExitCode]
    assert list(EXIT_CODES) == list(ExitCode)


# Catalogues --------------------------------------------------------------------------------------


@pytest.mark.parametrize("lang", LANGUAGES)
def test_every_mistake_is_listed_under_its_subject(lang: str) -> None:
    path = ROOT / "planmethod" / "note" / "wording" / lang / "check.toml"
    known = tomllib.loads(path.read_text("utf-8"))["mistakes"]
    listed = re.findall(r"(?m)^\| `([^`]+)` \|", text_of("mistakes", lang))
    assert sorted(listed) == sorted(known)
    assert set(markdown.words("mistakes", lang)["subjects"]) == set(
        map(catalogues.subject_of, known)
    )


def test_every_term_has_both_languages() -> None:
    for section in markdown.data("glossary")["sections"]:
        for one, other, _, about, _ in section["terms"]:
            assert one and other and about, one
            assert about.endswith("."), about


@each("path", sorted(path for folder in pages.FOLDERS.values() for path in folder.glob("*.md")))
def test_only_generated_pages_have_the_mark(path: Path) -> None:
    written = {pages.path_of(name, lang) for name, lang in PAGES}
    assert path.read_text("utf-8").startswith(markdown.MARK) == (path in written)
