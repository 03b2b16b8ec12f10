"""Routes of the studio: every address, what it takes and what it gives (сервер)."""

from __future__ import annotations

import asyncio
import contextlib
import hmac
import json
import re
import shutil
from collections.abc import AsyncIterator, Mapping
from hashlib import sha256
from pathlib import Path
from typing import Any

from msgspec import Struct
from starlette.applications import Starlette
from starlette.exceptions import HTTPException
from starlette.middleware import Middleware
from starlette.middleware.gzip import DEFAULT_EXCLUDED_CONTENT_TYPES, GZipMiddleware
from starlette.requests import ClientDisconnect, Request
from starlette.responses import FileResponse, JSONResponse, Response, StreamingResponse
from starlette.routing import Route

from planmethod.errors import ArgumentError, OutputError
from planmethod.languages import speaking, translate
from planmethod.problem import schema_text
from planmethod.studio.bank import find_tasks, pictured_files, start_of
from planmethod.studio.door import Door, StudioRefusal, lang_of, reject_error
from planmethod.studio.requests import (
    ACTS,
    QUICK,
    SLOW,
    TRUSTED,
    TRUSTED_COMMANDS,
    StudioLimits,
    StudioRequest,
    build_job,
    page_data,
    request_of,
    upload_name,
)
from planmethod.studio.sessions import Desk, Sessions, StudioSession, mark_of
from planmethod.studio.static_export import SERVER_POLICY, asset, assets_mark, page_of
from planmethod.studio.workers import Act, Pace, StudioQueue

FULL = "The queue is full. Try again in a minute."

_LIVE = "sandbox allow-scripts; frame-ancestors 'self'"
_FILE = "default-src 'none'; style-src 'unsafe-inline'; img-src data:; sandbox; " + (
    "frame-ancestors 'self'"
)
_KINDS = {
    ".html": "text/html; charset=utf-8", ".svg": "image/svg+xml", ".pdf": "application/pdf",
    ".csv": "text/csv; charset=utf-8", ".json": "application/json",
}  # fmt: skip
_PACKED = (*DEFAULT_EXCLUDED_CONTENT_TYPES, "application/pdf", "application/octet-stream")
"""Types of content that compression does not reduce."""

_FOR_EVER = "public, max-age=31536000, immutable"


class StudioSettings(Struct, frozen=True, kw_only=True):
    """Settings of the studio (настройки студии).

    Attributes
    ----------
    served : bool
        Strangers come.
    token : str
        Token of the instructor's pages on a public server, else of the whole studio.
    desk : Desk or None
        Files edited on one's own machine.
    layouts : tuple of str
        Names of the shipped layouts.
    """

    limits: StudioLimits
    served: bool = False
    token: str = ""
    processes: int = 2
    desk: Desk | None = None
    layouts: tuple[str, ...] = ()


def application(settings: StudioSettings, act: Act, root: Path) -> Starlette:
    """Return the server.

    Parameters
    ----------
    act : callable
        Computes a job in a process.
    root : Path
        Folder of the sessions; it is removed at the end.
    """
    studio = _Studio(settings, act, root)
    routes = [
        Route("/", studio.page),
        Route("/health", studio.health),
        Route("/static/{name}", studio.static),
        Route("/static/{mark}/{name}", studio.static),
        Route("/picture/{name}.svg", studio.picture),
        Route("/api/session", studio.enter, methods=["POST"]),
        Route("/api/schema", studio.schema),
        Route("/api/tasks", studio.tasks),
        Route("/api/start/{name}", studio.start),
        Route("/api/file/{name}", studio.file, methods=["GET", "POST"]),
        Route("/api/works/{name}", studio.take_upload, methods=["PUT", "DELETE"]),
        Route("/api/do/{do}", studio.do, methods=["POST"]),
        Route("/files/{key}/{number}/{path:path}", studio.serve_result),
    ]
    middleware = [
        Middleware(Door, token=None if settings.served else settings.token),
        Middleware(GZipMiddleware, compresslevel=6, exclude_content_types=_PACKED),
    ]
    refusing = {HTTPException: reject_error, OSError: reject_error}
    return Starlette(
        routes=routes, middleware=middleware, exception_handlers=refusing, lifespan=studio.living
    )


async def _read_body(request: Request, limit: int) -> bytes:
    """Read a body within its bound."""
    parts, size = [], 0
    try:
        async for part in request.stream():
            size += len(part)
            if size > limit:
                raise StudioRefusal(413, "This is larger than {} KiB. Send less.", limit // 1024)
            parts.append(part)
    except ClientDisconnect:
        raise StudioRefusal(400, "The request is incomplete.") from None
    return b"".join(parts)


class _Studio:
    def __init__(self, settings: StudioSettings, act: Act, root: Path) -> None:
        self.settings, self.limits, self.act, self.root = settings, settings.limits, act, root
        self.sessions = Sessions(root, self.limits)
        self._files = pictured_files()
        self._pictures: dict[tuple[str, str], str] = {}

    @contextlib.asynccontextmanager
    async def living(self, _: Starlette) -> AsyncIterator[None]:
        """Start the processes, and clean up."""
        self.queue = StudioQueue(self.act, self.settings.processes, self.limits)
        cleaning = asyncio.create_task(self._clean())
        try:
            yield
        finally:
            cleaning.cancel()
            self.queue.stop()
            shutil.rmtree(self.root, ignore_errors=True)

    async def _clean(self) -> None:
        while True:
            await asyncio.sleep(60)
            self.sessions.clean()

    # The page ------------------------------------------------------------------------------------

    async def page(self, request: Request) -> Response:
        """Give the page in a language."""
        settings, lang = self.settings, lang_of(request)
        names = [] if settings.desk is None else settings.desk.names
        one = settings.desk is not None and settings.desk.path.is_file()
        own = {"served": settings.served, "files": names, "one": one}
        told = page_data(lang, settings.layouts, self.limits.uploads) | own
        text, nonce = page_of(lang, told, f"static/{assets_mark()}")
        return Response(
            text,
            media_type="text/html",
            headers={
                "Content-Security-Policy": SERVER_POLICY.format(nonce=nonce),
                "Cache-Control": "no-store",
            },
        )

    async def static(self, request: Request) -> Response:
        """Give a script, the style, a licence: one for ever by the mark of its version."""
        found, mark = asset(request.path_params["name"]), request.path_params.get("mark")
        if found is None or mark not in (None, assets_mark()):
            raise StudioRefusal(404)
        return _marked(request, *found, "no-cache" if mark is None else _FOR_EVER)

    async def health(self, _: Request) -> Response:
        """Report the state of the server, without anything about files."""
        queue = self.queue
        return JSONResponse(
            {"ok": True, "sessions": len(self.sessions), "waiting": queue.waiting,
             "busy": queue.busy, "done": queue.done, "refused": queue.rejected}
        )  # fmt: skip

    # What there is to start from -----------------------------------------------------------------

    async def schema(self, request: Request) -> Response:
        """Give the schema of problem files, with the descriptions of keys in a language."""
        return _marked(request, schema_text(lang_of(request)).encode(), "application/json")

    async def tasks(self, request: Request) -> Response:
        """Give the shipped tasks; of a search, those that say its words."""
        found = find_tasks(request.query_params.get("search", ""), lang_of(request))
        return _marked(request, _json(found), "application/json")

    async def start(self, request: Request) -> Response:
        """Give the text of a task, of a variant of it, or of a template."""
        name, variant = request.path_params["name"], request.query_params.get("variant") or None
        found = start_of(name, variant, lang_of(request))
        if found is None:
            raise StudioRefusal(404)
        return _marked(request, _json(found), "application/json")

    async def picture(self, request: Request) -> Response:
        """Give the picture of a shipped task or a template in a language, drawn once."""
        name = request.path_params["name"]
        if name not in self._files:
            raise StudioRefusal(404)
        of = name, lang_of(request)
        if of not in self._pictures:
            asked = {"do": "pictured", "file": self._files[name], "lang": of[1]}
            if self.queue.waiting > self.limits.waiting // 2:
                raise StudioRefusal(503, FULL)
            drawn = ""
            async for told in self.queue.run(
                asked, session="", pace=Pace.USUAL, seconds=self.limits.seconds
            ):
                drawn = told.get("found", {}).get("svg", "")
            if not drawn:
                raise StudioRefusal(503, FULL)
            self._pictures[of] = drawn
        answer = _marked(request, self._pictures[of].encode(), "image/svg+xml", "max-age=86400")
        answer.headers["Content-Security-Policy"] = _FILE
        return answer

    # Sessions ------------------------------------------------------------------------------------

    async def enter(self, request: Request) -> Response:
        """Begin a session; with the token that is printed at the start, an instructor's."""
        told, token = await self._read_request(request, 4096), self.settings.token
        is_right = hmac.compare_digest(told.token.encode(), token.encode())
        trusted = not self.settings.served or is_right
        address = request.client.host if request.client else ""
        session = self.sessions.enter(address, trusted=trusted, is_busy=self.queue.is_busy_for)
        if session is None:
            raise StudioRefusal(503, "There are too many visitors. Try again in a minute.")
        return JSONResponse({"key": session.key, "trusted": trusted})

    def _session(self, request: Request) -> StudioSession:
        """Return the session of a request, by a header that no page of elsewhere can send."""
        session = self.sessions.of(request.headers.get("x-studio", ""))
        if session is None:
            raise StudioRefusal(401)
        return session

    async def _read_request(self, request: Request, limit: int) -> StudioRequest:
        data = await _read_body(request, limit)
        try:
            with speaking(lang_of(request)):
                return request_of(data)
        except ArgumentError as error:
            raise StudioRefusal(400, str(error)) from None

    # One's own files -----------------------------------------------------------------------------

    async def file(self, request: Request) -> Response:
        """Give the file that is edited, or its mark alone; or save it."""
        self._session(request)
        desk, name = self.settings.desk, request.path_params["name"]
        path = None if desk is None else desk.at(name)
        if desk is None or path is None:
            raise StudioRefusal(404)
        asked = (
            await self._read_request(request, self.limits.text)
            if request.method == "POST"
            else None
        )
        try:
            with speaking(lang_of(request)):
                if asked is None:
                    there = desk.read(path)
                else:
                    other = desk.save(path, asked.text, asked.mark, over=asked.over)
        except OutputError as error:
            raise StudioRefusal(409, str(error)) from None
        if asked is not None:
            if other is not None:
                return JSONResponse({"text": other[0], "mark": other[1]}, 409)
            return JSONResponse({"mark": mark_of(asked.text.encode())})
        if there is None:
            raise StudioRefusal(404)
        text, mark = there
        return JSONResponse(
            {"mark": mark} | ({} if "mark" in request.query_params else {"text": text})
        )

    # Works ---------------------------------------------------------------------------------------

    async def take_upload(self, request: Request) -> Response:
        """Accept a submission dropped on the page; or delete all of them."""
        session = self._session(request)
        self._trust(session)
        if request.method == "DELETE":
            shutil.rmtree(session.works, ignore_errors=True)
            session.works.mkdir()
            return JSONResponse([])
        given = request.path_params["name"]
        name = upload_name(given)
        if name is None:
            phrase = (
                "'{}': submissions are *.csv, *.xlsx, *.json, *.toml, or drawings *.dxf, *.svg."
            )
            raise StudioRefusal(415, phrase, " ".join(Path(given).name.split())[:120])
        data, limits = await _read_body(request, self.limits.upload), self.limits
        path = session.works / name
        if session.uploaded() + len(data) > limits.uploads:
            raise StudioRefusal(
                413, "This is larger than {} KiB. Send less.", limits.uploads // 1024
            )
        if not path.exists() and len([*session.works.iterdir()]) >= limits.works:
            raise StudioRefusal(
                413, "There are {} submissions already: no more are accepted.", limits.works
            )
        path.write_bytes(data)
        return JSONResponse(sorted(path.name for path in session.works.iterdir()))

    def _trust(self, session: StudioSession) -> None:
        if not session.trusted:
            raise StudioRefusal(403)

    # Computations --------------------------------------------------------------------------------

    async def do(self, request: Request) -> Response:
        """Run a computation: lines of JSON give its queue place, progress, result."""
        session, do = self._session(request), request.path_params["do"]
        if do not in ACTS:
            raise StudioRefusal(404)
        lang, limits = lang_of(request), self.limits
        told = await self._read_request(request, limits.text)
        if do in TRUSTED or told.what in TRUSTED_COMMANDS:
            self._trust(session)
        if not session.bucket.admit(self.sessions.clock(), rate=limits.rate, burst=limits.burst):
            raise StudioRefusal(429, "Too many requests. Wait a little.")
        if self.queue.is_full_for(session.key):
            raise StudioRefusal(503, FULL)
        settings, works = self.settings, session.works
        asked = build_job(
            do, told, lang=lang, layouts=settings.layouts, works=works, served=settings.served
        )
        if asked is None:
            raise StudioRefusal(404)
        number, folder = session.new_folder(limits.stored_results)
        asked["folder"] = str(folder)
        self._copy_variant_table(asked["text"], told.file, folder)
        pace, seconds = Pace.QUICK if do in QUICK else Pace.USUAL, limits.seconds
        if do == "command" and told.what in SLOW:
            pace, seconds = Pace.SLOW, limits.slow_seconds
        if session.trusted:
            seconds = limits.trusted_seconds
        lines = self.queue.run(asked, session=session.key, pace=pace, seconds=seconds)
        first = await anext(lines)
        headers = {"Cache-Control": "no-store", "X-Accel-Buffering": "no"}
        return StreamingResponse(
            self._lines(first, lines, session, number, lang),
            media_type="application/x-ndjson",
            headers=headers,
        )

    def _copy_variant_table(self, text: str, name: str, folder: Path) -> None:
        """Copy the table of variants that one's own file names to where it is read."""
        desk = self.settings.desk
        named = re.search(r'(?m)^\s*variants\s*=\s*"([^"/\\]+\.(?:csv|txt))"', text)
        if desk is None or named is None or (path := desk.at(name)) is None:
            return
        with contextlib.suppress(OSError, ValueError):  # also no name of a file
            shutil.copyfile(path.parent / named[1], folder / named[1])

    async def _lines(
        self,
        first: Mapping[str, Any],
        events: AsyncIterator[Mapping[str, Any]],
        session: StudioSession,
        number: int,
        lang: str,
    ) -> AsyncIterator[bytes]:
        yield json.dumps(first).encode() + b"\n"
        async for one in events:
            line: dict[str, Any] = dict(one)
            if "found" in line:
                found = line["found"] = dict(line["found"])
                if "refused" in found:
                    with speaking(lang):
                        found["refused"] = str(translate(*found["refused"]))
                found["files_at"] = f"/files/{session.key}/{number}/"
            yield json.dumps(line, ensure_ascii=False).encode() + b"\n"

    # What was made -------------------------------------------------------------------------------

    async def serve_result(self, request: Request) -> Response:
        """Give a file to whom it was made for; ``all.zip``: all of them."""
        key, number, name = (request.path_params[k] for k in ("key", "number", "path"))
        session = self.sessions.of(key)
        if session is None:
            raise StudioRefusal(404)
        if name == "all.zip":
            data = await asyncio.to_thread(session.zipped, number)
            if data is None:
                raise StudioRefusal(404)
            headers = {"Content-Disposition": 'attachment; filename="planmethod.zip"'}
            return Response(data, media_type="application/zip", headers=headers)
        path = session.file(number, name)
        if path is None:
            raise StudioRefusal(404)
        ending = path.suffix.lower()
        headers = {"Content-Security-Policy": _LIVE if "-live" in path.stem else _FILE}
        shown = ending in (".html", ".svg") and "download" not in request.query_params
        return FileResponse(
            path,
            media_type=_KINDS.get(ending, "application/octet-stream"),
            headers=headers,
            filename=path.name,
            content_disposition_type="inline" if shown else "attachment",
        )


def _json(data: object) -> bytes:
    return json.dumps(data, ensure_ascii=False, separators=(",", ":")).encode()


def _marked(request: Request, data: bytes, kind: str, caching: str = "no-cache") -> Response:
    """Return a response that a browser caches, and revalidates by its mark."""
    mark = f'"{sha256(data).hexdigest()[:16]}"'
    headers = {"ETag": mark, "Cache-Control": caching}
    if request.headers.get("if-none-match") == mark:
        return Response(status_code=304, headers=headers)
    return Response(data, media_type=kind, headers=headers)
