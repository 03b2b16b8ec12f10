"""The studio without a server: the same routes, in a Python of the browser."""

from __future__ import annotations

import json
import shutil
import sys
from collections.abc import Callable
from pathlib import Path
from tempfile import mkdtemp
from types import ModuleType
from typing import Any
from urllib.parse import parse_qs, unquote, urlsplit
from weakref import finalize

from msgspec import Struct

from planmethod.errors import ArgumentError
from planmethod.languages import LANGUAGES, speaking, translate
from planmethod.problem import schema_text
from planmethod.render.sheets.compositions import SHIPPED
from planmethod.studio.bank import find_tasks, start_of
from planmethod.studio.requests import (
    ACTS,
    LOCAL_LIMITS,
    NESTING_TOO_DEEP,
    NO_MEMORY,
    build_job,
    request_of,
    upload_name,
)
from planmethod.studio.sessions import StudioSession

Answer = tuple[int, bytes]
"""Status and body, as those of the server."""


def start_studio(
    act: Callable[[dict[str, Any], Callable[[float], None]], dict[str, Any]],
) -> BrowserStudio:
    """Return the responder of the page; ``act`` computes. Its folder is deleted with it."""
    for name in ("termios", "tty"):  # click's bar imports them needlessly; a browser has none
        sys.modules.setdefault(name, ModuleType(name))
    session = StudioSession("", Path(mkdtemp(prefix="planmethod-studio-")), True, 0.0)
    session.works.mkdir()
    alone = BrowserStudio(act, session)
    finalize(alone, shutil.rmtree, session.folder, ignore_errors=True)
    return alone


class BrowserStudio(Struct, weakref=True):
    """Answers the addresses of the server to the page's only user (студия без сервера)."""

    act: Callable[[dict[str, Any], Callable[[float], None]], dict[str, Any]]
    session: StudioSession

    def answer(
        self, method: str, address: str, body: bytes, report: Callable[[float], None]
    ) -> Answer:
        """Answer one request.

        Parameters
        ----------
        address : str
            Path with its query string, as requested by the page.
        report : callable
            Gets the share that is done, 0 to 1.
        """
        parts = urlsplit(address)
        more = {key: values[0] for key, values in parse_qs(parts.query).items()}
        path, lang = unquote(parts.path), more.get("lang", LANGUAGES[0])
        match path.split("/", 2):
            case ["api", "do", do] if do in ACTS:
                return self._compute(do, bytes(body), lang, report)
            case ["api", "tasks"]:
                return _json(find_tasks(more.get("search", ""), lang))
            case ["api", "schema"]:
                return 200, schema_text(lang).encode()
            case ["api", "start", name]:
                found = start_of(name, more.get("variant") or None, lang)
                return (404, b"") if found is None else _json(found)
            case ["api", "works", name]:
                return self._handle_upload(method, name, bytes(body), lang)
            case ["files", number, "all.zip"]:
                data = self.session.zipped(number)
                return (404, b"") if data is None else (200, data)
            case ["files", number, name]:
                file = self.session.file(number, name)
                return (404, b"") if file is None else (200, file.read_bytes())
        return 404, b""

    def _compute(self, do: str, body: bytes, lang: str, report: Callable[[float], None]) -> Answer:
        session = self.session
        try:
            with speaking(lang):
                told = request_of(body)
        except ArgumentError as error:
            return 400, str(error).encode()
        asked = build_job(do, told, lang=lang, layouts=tuple(SHIPPED), works=session.works)
        if asked is None:
            return 404, b""
        number, folder = session.new_folder(LOCAL_LIMITS.stored_results)
        asked["folder"] = str(folder)
        try:
            found = self.act(asked, report)
        except (MemoryError, RecursionError) as error:
            with speaking(lang):
                found = {
                    "refused": str(
                        translate(
                            NESTING_TOO_DEEP if isinstance(error, RecursionError) else NO_MEMORY
                        )
                    )
                }
        return _json({"found": {**found, "files_at": f"files/{number}/"}})

    def _handle_upload(self, method: str, name: str, data: bytes, lang: str) -> Answer:
        works = self.session.works
        if method == "DELETE":
            shutil.rmtree(works)
            works.mkdir()
            return _json([])
        plain = upload_name(name)
        if plain is None:
            with speaking(lang):
                phrase = (
                    "'{}': submissions are *.csv, *.xlsx, *.json, *.toml, or drawings *.dxf, *.svg."
                )
                return 415, str(translate(phrase, name[:120])).encode()
        (works / plain).write_bytes(data)
        return _json(sorted(path.name for path in works.iterdir()))


def _json(data: object) -> Answer:
    return 200, json.dumps(data, ensure_ascii=False).encode() + b"\n"
