"""The page of the studio, and the studio written into a folder for any host of files (Pyodide)."""

from __future__ import annotations

import io
import json
import re
import secrets
import zipfile
from collections.abc import Callable, Iterator, Mapping
from functools import cache
from hashlib import sha256
from html import escape
from importlib.metadata import PackageNotFoundError, PackagePath, distribution
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

from msgspec import Struct

from planmethod.errors import OutputError
from planmethod.languages import LANGUAGES
from planmethod.note.wording import get_language
from planmethod.problem import schema_text
from planmethod.problem.tasks import home
from planmethod.render.backends.output import write
from planmethod.studio.bank import find_tasks, pictured_files
from planmethod.studio.requests import LOCAL_LIMITS, page_data

# no messages: headers of HTTP
SERVER_POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self' 'nonce-{nonce}'; "
    "img-src 'self' blob: data:; connect-src 'self'; frame-src 'self'; base-uri 'none'; "
    "form-action 'none'; frame-ancestors 'none'"
)
"""Permissions of the page: to run its own scripts and talk to its own host."""

KINDS = {".js": "text/javascript", ".css": "text/css", ".txt": "text/plain; charset=utf-8"}


@cache
def asset(name: str) -> tuple[bytes, str] | None:
    """Return a file of the page and its type; None if there is no such file."""
    if re.fullmatch(r"[\w-]+\.(?:js|css|txt)", name) is None:
        return None
    path = next((one for one in _assets() if one.name == name), None)
    return None if path is None else (path.read_bytes(), KINDS[name[name.rindex(".") :]])


@cache
def assets_mark() -> str:
    """Return the fingerprint of all files of the page, which distinguishes versions."""
    return sha256(b"".join(one.read_bytes() for one in _assets())).hexdigest()[:16]


def _assets() -> list[Traversable]:
    """Return the files of the page, with the modules that it shares with live pages, in order."""
    own = files("planmethod.studio").joinpath("page").iterdir()
    shared = files("planmethod.render.live").joinpath("script").iterdir()
    there = (*own, *(one for one in shared if one.name != "live.js"))
    return sorted(there, key=lambda one: one.name)


def page_of(lang: str, page_data: Mapping[str, Any], static: str = "static") -> tuple[str, str]:
    """Return the page in a language, and the word by which its editor may set its style.

    Parameters
    ----------
    page_data : mapping
        What its script reads, plain data.
    static : str
        Where its scripts and its style are, below it.
    """
    words, nonce = get_language(lang).studio["page"], secrets.token_urlsafe(16)
    text = files("planmethod.studio").joinpath("page", "studio.html").read_text("utf-8")
    text = re.sub(r"\{\{(\w+)\}\}", lambda place: escape(words[place[1]]), text)
    data = {**page_data, "lang": lang, "langs": LANGUAGES, "nonce": nonce, "words": words}
    whole = json.dumps(data, ensure_ascii=False).replace("<", "\\u003c")
    text = text.replace("[[static]]", static).replace("[[lang]]", lang)
    return text.replace("[[data]]", whole), nonce


VERSION = "314.0.7"
"""Version of Pyodide: the first whose index has the library versions of the project."""

OFFICIAL = "https://cdn.jsdelivr.net/pyodide/v{}/full/"

LOCK = "pyodide-lock.json"
CORE = ("pyodide.mjs", "pyodide.asm.mjs", "pyodide.asm.wasm", "python_stdlib.zip", LOCK)
"""Files of the runtime in ``npm pack pyodide``."""

LOADED = ("numpy", "shapely", "matplotlib", "lxml", "msgspec")
"""Libraries with machine code, with their dependencies: from the index of the runtime."""

PACKED = (
    "click", "svgwrite", "openpyxl", "et_xmlfile", "python-docx", "typing_extensions", "reportlab",
    "charset-normalizer", "chardet", "mpmath", "ezdxf",
)  # fmt: skip
"""Pure Python libraries: the installed ones go into the archive. Of the two that guess
encodings, reportlab brings one."""

ARCHIVE = "planmethod.zip"

# no messages: HTML
STATIC_POLICY = (
    "default-src 'none'; script-src 'self' blob: 'wasm-unsafe-eval'{hosts}; "
    "style-src 'self' 'unsafe-inline'; img-src 'self' blob: data:; connect-src 'self'{hosts}; "
    "frame-src 'self'; worker-src 'self' blob:; base-uri 'none'; form-action 'none'"
)
"""Like that of the server's page; besides its own host it permits only the runtime's."""


class Runtime(Struct, frozen=True):
    """Source of Pyodide for the page (среда выполнения).

    Attributes
    ----------
    core, packages : str
        Addresses of the core and of the libraries; one that is no URL is below the page.
    folder : Path or None
        Whose files are copied.
    copied : tuple of str
        Their names.
    """

    core: str
    packages: str
    folder: Path | None = None
    copied: tuple[str, ...] = ()

    @property
    def hosts(self) -> tuple[str, ...]:
        """Addresses elsewhere."""
        return tuple(dict.fromkeys(at for at in (self.core, self.packages) if urlsplit(at).scheme))


def runtime_of(location: str | None) -> Runtime:
    """Return the runtime of an address, of a folder, or the official one.

    Raises
    ------
    LookupError
        The folder has no core; the message names the missing files.
    """
    if location is None or urlsplit(location).scheme in ("http", "https"):
        address = OFFICIAL.format(VERSION) if location is None else location.rstrip("/") + "/"
        return Runtime(address, address)
    folder = Path(location)
    core = [name for name in CORE if (folder / name).is_file()]
    core += [name for name in ("pyodide.asm.js",) if (folder / name).is_file()]  # before 314
    absent = [name for name in CORE if name not in core and name != "pyodide.asm.mjs"]
    if absent:
        raise LookupError(", ".join(absent))
    wheels = _wheels(json.loads((folder / LOCK).read_text("utf-8")))
    if all((folder / name).is_file() for name in wheels):
        return Runtime("pyodide/", "pyodide/", folder, (*core, *wheels))
    version = json.loads((folder / "package.json").read_text("utf-8"))["version"]
    return Runtime("pyodide/", OFFICIAL.format(version), folder, tuple(core))


def _wheels(lock: Mapping[str, Any]) -> tuple[str, ...]:
    """Return the files of the libraries and of their dependencies."""
    names, found = [*LOADED], dict[str, str]()
    while names:
        package = lock["packages"][names.pop()]
        if package["name"] not in found:
            found[package["name"]] = package["file_name"]
            names += package["depends"]
    return tuple(found.values())


def task_names() -> list[str]:
    """Return the names of tasks and templates: each has a picture, which takes time."""
    return [*pictured_files()]


def write_studio(
    folder: Path,
    runtime: Runtime,
    layouts: tuple[str, ...],
    pictured: Callable[[str], str],
    *,
    lang: str,
    done: Callable[[int], None],
) -> None:
    """Write the page, its scripts, the tasks with their pictures, and the archive of the project.

    Parameters
    ----------
    pictured : callable
        Gives the picture of a task, of its file.
    lang : str
        Language of ``index.html``; the page of another one is called by its code.
    done : callable
        Called after every picture.

    Raises
    ------
    OutputError
        The folder has other contents, or cannot be written.
    """
    if folder.exists() and not folder.is_dir():
        raise OutputError("{}: this is a file. Name a folder.", folder)
    if folder.is_dir() and any(folder.iterdir()) and not (folder / ARCHIVE).is_file():
        raise OutputError(
            "{}: the folder contains other files. Name an empty or new folder.", folder
        )
    write(folder / ARCHIVE, archive(), output_root=folder)
    for name, data in _files(runtime, layouts, lang):
        write(folder / name, data, output_root=folder)
    for task, file in pictured_files().items():
        picture = folder / "picture" / f"{task}.svg"
        write(picture, pictured(file).encode(), output_root=folder)
        done(1)


# no messages: HTML
def _files(runtime: Runtime, layouts: tuple[str, ...], lang: str) -> Iterator[tuple[str, bytes]]:
    """Yield the files and their contents, without the pictures."""
    pages = {one: "index.html" if one == lang else f"{one}.html" for one in LANGUAGES}
    alone = {"core": runtime.core, "packages": runtime.packages, "names": LOADED, "site": ARCHIVE}
    hosts = "".join(f" {at}" for at in runtime.hosts)
    policy = (
        f'<meta http-equiv="Content-Security-Policy" content="{STATIC_POLICY.format(hosts=hosts)}">'
    )
    for one, name in pages.items():
        told = page_data(one, layouts, LOCAL_LIMITS.uploads) | {"alone": alone, "pages": pages}
        text = page_of(one, told)[0]
        head = '<meta charset="utf-8">\n'
        yield name, text.replace(head, f"{head}{policy}\n", 1).encode()
        yield f"schema-{one}.json", schema_text(one).encode()
        yield f"tasks-{one}.json", json.dumps(find_tasks("", one), ensure_ascii=False).encode()
    for path in _assets():
        if path.name not in ("studio.html", "transport.js"):
            name = "transport.js" if path.name == "alone.js" else path.name
            yield f"static/{name}", path.read_bytes()
    for name in runtime.copied:
        assert runtime.folder is not None
        yield f"pyodide/{name}", (runtime.folder / name).read_bytes()


def archive() -> bytes:
    """Return the project, its tasks and the libraries that are Python alone, as one archive."""
    made, package = io.BytesIO(), Path(__file__).parents[1]
    with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as book:
        for root, above in ((package, "planmethod"), (home(), "planmethod/problems")):
            for path in sorted(root.rglob("*")):
                _add_file(book, path, f"{above}/{path.relative_to(root).as_posix()}")
        for name in PACKED:
            for one in _files_of(name):
                if ".." not in one.parts:
                    _add_file(book, Path(str(one.locate())), one.as_posix())
    return made.getvalue()


def _files_of(name: str) -> list[PackagePath]:
    """Return the files of a library; none where it is not installed."""
    try:
        return distribution(name).files or []
    except PackageNotFoundError:
        return []


def _add_file(book: zipfile.ZipFile, path: Path, name: str) -> None:
    """Put a file into the archive; the same bytes whenever that is done."""
    there = book.NameToInfo
    if path.is_file() and path.suffix not in (".pyc", ".so", ".pyd") and name not in there:
        info = zipfile.ZipInfo(name)
        info.compress_type = zipfile.ZIP_DEFLATED
        book.writestr(info, path.read_bytes())
