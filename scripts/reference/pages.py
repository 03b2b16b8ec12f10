"""The generated pages by name: ``docs/reference/NAME.md`` and ``docs/ru/reference/NAME.md``."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

from scripts.reference import catalogues, commands, glossary, keys
from scripts.reference.markdown import ROOT, page_text

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


def texts() -> Iterator[tuple[Path, str]]:
    """Yield every page's file and text."""
    for name in PAGES:
        for lang in FOLDERS:
            yield path_of(name, lang), text_of(name, lang)
