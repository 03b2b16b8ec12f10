"""The generated pages by name: ``docs/reference/NAME.md`` and ``docs/ru/reference/NAME.md``."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

from scripts.reference import catalogues, commands, glossary, keys
from scripts.reference.markdown import MARK, ROOT, page_text

PAGES: Mapping[str, Callable[[str], str]] = {
    "commands": commands.commands_page,
    "exit-codes": commands.exit_codes_page,
    "keys": keys.keys_page,
    "mistakes": catalogues.mistakes_page,
    "lint-codes": catalogues.lint_codes_page,
    "layouts": catalogues.layouts_page,
    "glossary": glossary.glossary_page,
}
"""The body of each page in a language."""

FOLDERS = {"en": ROOT / "docs" / "reference", "ru": ROOT / "docs" / "ru" / "reference"}


def path_of(name: str, lang: str) -> Path:
    """Return the file of a page."""
    return FOLDERS[lang] / f"{name}.md"


def text_of(name: str, lang: str) -> str:
    """Return the text of a page."""
    return page_text(name, lang, PAGES[name](lang))


DECISIONS = ROOT / "docs" / "adr" / "README.md"

ABOUT_DECISIONS = """# Decisions

Each record describes one decision that a newcomer may question: its reasons, the alternatives, and
its consequences. It has about 200 words and is true of today's code. If a decision changes, edit
its record, or replace it by a new one and delete it. Numbers are not reused.

| no. | decision |
| ---: | --- |
"""


def decisions_text() -> str:
    """Return the list of the records of decisions, from their titles."""
    rows = []
    for path in sorted(DECISIONS.parent.glob("[0-9]*.md")):
        number, title = path.read_text("utf-8").splitlines()[0].removeprefix("# ").split(". ", 1)
        rows.append(f"| [{number}]({path.name}) | {title} |\n")
    return "".join((f"{MARK}\n\n{ABOUT_DECISIONS}", *rows))


def texts() -> Iterator[tuple[Path, str]]:
    """Yield every page's file and text."""
    yield DECISIONS, decisions_text()
    for name in PAGES:
        for lang in FOLDERS:
            yield path_of(name, lang), text_of(name, lang)
