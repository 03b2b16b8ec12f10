"""Hook of MkDocs: the README as first page, and links from pages to files outside docs/."""

from __future__ import annotations

import posixpath
import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from mkdocs.structure.files import Files
    from mkdocs.structure.pages import Page

ROOT = Path(__file__).parents[1]
FIRST = {
    "README.md": "index.md",
    "README.ru.md": "readme.ru.md",
    "CONTRIBUTING.md": "contributing.md",
    "CHANGELOG.md": "changelog.md",
}
"""Pages of the repository that are pages of the book, and what they are called there."""

FENCED = r"(?ms)(^```.*?^```$|`[^`\n]*`)"
LINK = r"(!?\[[^\]]*\]\()([^)\s#]+)(#[^)\s]*)?(?=\))"


def on_files(files: Files, config: Any) -> Files:
    """Add the READMEs as pages, and the files that any page links to outside docs/."""
    from mkdocs.structure.files import File

    for source, called in FIRST.items():
        text = (ROOT / source).read_text(encoding="utf-8")
        files.append(File.generated(config, called, content=text))
    for page in list(files.documentation_pages()):
        for target in _targets(page.content_string, page.src_uri):
            if (path := _inside(target)) is not None and files.get_file_from_path(path) is None:
                files.append(File.generated(config, path, abs_src_path=str(ROOT / target)))
    return files


def on_page_markdown(text: str, page: Page, config: Any, files: Files) -> str:
    """Lead the links of a page to where their files are in the book."""
    uri = page.file.src_uri

    def led(match: re.Match[str]) -> str:
        path = _inside(_from_root(match[2], uri))
        if "://" in match[2] or path is None:
            return match[0]
        return match[1] + posixpath.relpath(path, posixpath.dirname(uri)) + (match[3] or "")

    parts = re.split(FENCED, text)
    return "".join(re.sub(LINK, led, part) if i % 2 == 0 else part for i, part in enumerate(parts))


def _targets(text: str, uri: str) -> set[str]:
    plain = re.sub(FENCED, "", text)
    return {_from_root(link, uri) for _, link, _ in re.findall(LINK, plain) if "://" not in link}


def _from_root(link: str, uri: str) -> str:
    """Return the target of a page's link as a path from the root of the repository."""
    folder = "" if uri in FIRST.values() else posixpath.join("docs", posixpath.dirname(uri))
    return posixpath.normpath(posixpath.join(folder, link))


def _inside(target: str) -> str | None:
    """Return a file of the repository as a path of the book; None where there is no such file."""
    if target in FIRST:
        return FIRST[target]
    if not (ROOT / target).is_file():
        return None
    return target.removeprefix("docs/") if target.startswith("docs/") else f"files/{target}"
