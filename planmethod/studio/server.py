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
from starlette.middleware.trustedhost import TrustedHostMiddleware
from starlette.requests import Request
from starlette.responses import FileResponse, JSONResponse, Response, StreamingResponse
from starlette.routing import Route

from planmethod.errors import OutputError
from planmethod.languages import LANGUAGES, say, speaking
from planmethod.problem import schema_text
from planmethod.problem.tasks import tasks
from planmethod.studio.asking import (
    ACTS,
    TRUSTED,
    TRUSTED_WHATS,
    asked_of,
    found_tasks,
    named_work,
    object_of,
    start_of,
    told_of,
)
from planmethod.studio.document import POLICY, asset, page_of
from planmethod.studio.limits import StudioLimits
from planmethod.studio.sessions import Desk, Sessions, StudioSession, mark_of
from planmethod.studio.workers import Act, StudioQueue

QUICK = ("sketched", "pictured", "questions")
"""What somebody waits for at each letter."""

_LIVE = "sandbox allow-scripts; frame-ancestors 'self'"
_FILE = "default-src 'none'; style-src 'unsafe-inline'; img-src data:; sandbox; " + (
    "frame-ancestors 'self'"
)
_KINDS = {
    ".html": "text/html; charset=utf-8", ".svg": "image/svg+xml", ".pdf": "application/pdf",
    ".csv": "text/csv; charset=utf-8", ".json": "application/json",
}  # fmt: skip


class StudioSettings(Struct, frozen=True, kw_only=True):
    """How the studio is started (настройки студии).

    Attributes
    ----------
    served : bool
        Strangers come.
    token : str
        Of the instructor's pages; empty where all are one's own.
    desk : Desk or None
        What is edited on one's own machine.
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
        What a process does with what is asked of it.
    root : Path
        Folder of the sessions; it is removed at the end.
    """
    studio = _Studio(settings, act, root)
    routes = [
        Route("/", studio.page),
        Route("/health", studio.health),
        Route("/static/{name}", studio.static),
        Route("/picture/{name}.svg", studio.picture),
        Route("/api/session", studio.enter, methods=["POST"]),
        Route("/api/schema", studio.schema),
        Route("/api/tasks", studio.tasks),
        Route("/api/start/{name}", studio.start),
        Route("/api/file/{name}", studio.file, methods=["GET", "POST"]),
        Route("/api/works/{name}", studio.take_work, methods=["PUT", "DELETE"]),
        Route("/api/do/{do}", studio.do, methods=["POST"]),
        Route("/files/{key}/{number}/{path:path}", studio.made),
    ]
    middleware = []
    if not settings.served:  # no page of elsewhere reaches it under a name of its own
        hosts = ["127.0.0.1", "localhost", "testserver"]
        middleware.append(Middleware(TrustedHostMiddleware, allowed_hosts=hosts))
    return Starlette(routes=routes, middleware=middleware, lifespan=studio.living)


def _refuse(status: int, said: str, *facts: object, lang: str = LANGUAGES[0]) -> HTTPException:
    with speaking(lang):
        return HTTPException(status, str(say(said, *facts)))


def _lang(request: Request) -> str:
    """Return the language of a request: what it names, else what its browser speaks."""
    asked = request.query_params.get("lang", "")
    spoken = (asked, *request.headers.get("accept-language", "").split(","))
    codes = (one.split(";")[0].strip().split("-")[0].lower() for one in spoken)
    return next((code for code in codes if code in LANGUAGES), LANGUAGES[0])


async def _body(request: Request, most: int) -> bytes:
    """Read a body within its bound."""
    parts, size = [], 0
    async for part in request.stream():
        size += len(part)
        if size > most:
            said = "This is larger than {} KiB. Send less."
            raise _refuse(413, said, most // 1024, lang=_lang(request))
        parts.append(part)
    return b"".join(parts)


class _Studio:
    def __init__(self, settings: StudioSettings, act: Act, root: Path) -> None:
        self.settings, self.limits, self.act, self.root = settings, settings.limits, act, root
        self.sessions = Sessions(root, self.limits)
        self._tasks = {task.name: task for task in tasks()}
        self._pictures: dict[str, str] = {}

    @contextlib.asynccontextmanager
    async def living(self, _: Starlette) -> AsyncIterator[None]:
        """Have processes at work, and clean up."""
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
        settings, lang = self.settings, _lang(request)
        names = [] if settings.desk is None else settings.desk.names
        one = settings.desk is not None and settings.desk.path.is_file()
        own = {"served": settings.served, "files": names, "one": one}
        told = told_of(lang, settings.layouts, self.limits.uploads) | own
        text, nonce = page_of(lang, told)
        return Response(
            text,
            media_type="text/html",
            headers={
                "Content-Security-Policy": POLICY.format(nonce=nonce),
                "Cache-Control": "no-store",
                **_SAFE,
            },
        )

    async def static(self, request: Request) -> Response:
        """Give a script, the style, a licence."""
        found = asset(request.path_params["name"])
        if found is None:
            raise HTTPException(404)
        data, kind = found
        mark = f'"{sha256(data).hexdigest()[:16]}"'
        headers = {"ETag": mark, "Cache-Control": "no-cache", **_SAFE}
        if request.headers.get("if-none-match") == mark:
            return Response(status_code=304, headers=headers)
        return Response(data, media_type=kind, headers=headers)

    async def health(self, _: Request) -> Response:
        """Tell how the server does; of nobody's files."""
        queue = self.queue
        return JSONResponse(
            {"ok": True, "sessions": len(self.sessions), "waiting": queue.waiting,
             "busy": queue.busy, "done": queue.done, "refused": queue.refused}
        )  # fmt: skip

    # What there is to start from -----------------------------------------------------------------

    async def schema(self, request: Request) -> Response:
        """Give the schema of problem files, with what keys mean in a language."""
        data = schema_text(_lang(request))
        return Response(data, media_type="application/json", headers=_SAFE)

    async def tasks(self, request: Request) -> Response:
        """Give the shipped tasks; of a search, those that say its words."""
        return JSONResponse(found_tasks(request.query_params.get("search", "")))

    async def start(self, request: Request) -> Response:
        """Give the text of a task, of a variant of it, or of a template."""
        name, variant = request.path_params["name"], request.query_params.get("variant") or None
        found = start_of(name, variant, _lang(request))
        if found is None:
            raise HTTPException(404)
        return JSONResponse(found)

    async def picture(self, request: Request) -> Response:
        """Give the picture of a shipped task, drawn once."""
        task = self._tasks.get(request.path_params["name"])
        if task is None:
            raise HTTPException(404)
        if task.name not in self._pictures:
            asked = {"do": "pictured", "file": task.file, "lang": LANGUAGES[0]}
            if self.queue.waiting > self.limits.waiting // 2:
                raise HTTPException(503)
            async for told in self.queue.run(
                asked, session="", quick=False, seconds=self.limits.seconds
            ):
                self._pictures[task.name] = told.get("found", {}).get("svg", "")
        headers = {"Cache-Control": "max-age=86400", "Content-Security-Policy": _FILE, **_SAFE}
        return Response(self._pictures[task.name], media_type="image/svg+xml", headers=headers)

    # Sessions ------------------------------------------------------------------------------------

    async def enter(self, request: Request) -> Response:
        """Begin a session; with the token that is printed at the start, an instructor's."""
        told = self._object(await _body(request, 4096))
        given, token = str(told.get("token", "")), self.settings.token
        trusted = not self.settings.served or hmac.compare_digest(given.encode(), token.encode())
        address = request.client.host if request.client else ""
        session = self.sessions.enter(address, trusted=trusted)
        if session is None:
            raise _refuse(503, "There are too many visitors. Try again in a minute.")
        return JSONResponse({"key": session.key, "trusted": trusted})

    def _session(self, request: Request) -> StudioSession:
        """Return the session of a request, by a header that no page of elsewhere can send."""
        session = self.sessions.of(request.headers.get("x-studio", ""))
        if session is None:
            raise HTTPException(401)
        return session

    def _object(self, data: bytes) -> dict[str, Any]:
        found = object_of(data)
        if found is None:
            raise HTTPException(400)
        return found

    # One's own files -----------------------------------------------------------------------------

    async def file(self, request: Request) -> Response:
        """Give the file that is edited, or its mark alone; or save it."""
        self._session(request)
        desk, name = self.settings.desk, request.path_params["name"]
        path = None if desk is None else desk.at(name)
        if desk is None or path is None:
            raise HTTPException(404)
        if request.method == "GET":
            there = desk.read(path)
            if there is None:
                raise HTTPException(404)
            text, mark = there
            told = (
                {"mark": mark} if "mark" in request.query_params else {"text": text, "mark": mark}
            )
            return JSONResponse(told)
        asked = self._object(await _body(request, self.limits.text))
        text, over = str(asked.get("text", "")), asked.get("over") is True
        try:
            other = desk.save(path, text, str(asked.get("mark", "")), over=over)
        except OutputError as error:
            raise HTTPException(409, str(error)) from None
        if other is not None:
            return JSONResponse({"text": other[0], "mark": other[1]}, 409)
        return JSONResponse({"mark": mark_of(text.encode())})

    # Works ---------------------------------------------------------------------------------------

    async def take_work(self, request: Request) -> Response:
        """Take a work that was dropped on the page; or drop all of them."""
        session = self._session(request)
        self._trust(session)
        if request.method == "DELETE":
            shutil.rmtree(session.works, ignore_errors=True)
            session.works.mkdir()
            return JSONResponse([])
        given = request.path_params["name"]
        name = named_work(given)
        if name is None:
            said = "'{}': works are *.csv, *.xlsx, *.json, *.toml, or drawings *.dxf, *.svg."
            raise _refuse(415, said, Path(given).name[:120], lang=_lang(request))
        data = await _body(request, self.limits.upload)
        if session.uploaded() + len(data) > self.limits.uploads:
            said = "This is larger than {} KiB. Send less."
            raise _refuse(413, said, self.limits.uploads // 1024, lang=_lang(request))
        (session.works / name).write_bytes(data)
        return JSONResponse(sorted(path.name for path in session.works.iterdir()))

    def _trust(self, session: StudioSession) -> None:
        if not session.trusted:
            raise HTTPException(403)

    # Computations --------------------------------------------------------------------------------

    async def do(self, request: Request) -> Response:
        """Have something computed: lines of JSON tell its place, its share, what is found."""
        session, do = self._session(request), request.path_params["do"]
        if do not in ACTS:
            raise HTTPException(404)
        lang, limits = _lang(request), self.limits
        told = self._object(await _body(request, limits.text))
        if do in TRUSTED or told.get("what") in TRUSTED_WHATS:
            self._trust(session)
        if not session.bucket.takes(self.sessions.clock(), rate=limits.rate, burst=limits.burst):
            raise _refuse(429, "This is asked too often. Wait a little.", lang=lang)
        if self.queue.is_full_for(session.key):
            raise _refuse(503, "Too much is waiting already. Try again in a minute.", lang=lang)
        settings, works = self.settings, session.works
        asked = asked_of(
            do, told, lang=lang, layouts=settings.layouts, works=works, served=settings.served
        )
        if asked is None:
            raise HTTPException(404)
        number, folder = session.new_folder(limits.kept)
        asked["folder"] = str(folder)
        self._put_beside(asked["text"], str(told.get("file", "")), folder)
        seconds = limits.trusted_seconds if session.trusted else limits.seconds
        lines = self.queue.run(asked, session=session.key, quick=do in QUICK, seconds=seconds)
        first = await anext(lines)
        headers = {"Cache-Control": "no-store", "X-Accel-Buffering": "no", **_SAFE}
        return StreamingResponse(
            self._lines(first, lines, session, number, lang),
            media_type="application/x-ndjson",
            headers=headers,
        )

    def _put_beside(self, text: str, name: str, folder: Path) -> None:
        """Put the table of variants that one's own file names where it is looked for."""
        desk = self.settings.desk
        named = re.search(r'(?m)^\s*variants\s*=\s*"([^"/\\]+\.(?:csv|txt))"', text)
        if desk is None or named is None or (path := desk.at(name)) is None:
            return
        with contextlib.suppress(OSError):
            shutil.copyfile(path.parent / named[1], folder / named[1])

    async def _lines(
        self,
        first: Mapping[str, Any],
        told: AsyncIterator[Mapping[str, Any]],
        session: StudioSession,
        number: int,
        lang: str,
    ) -> AsyncIterator[bytes]:
        yield json.dumps(first).encode() + b"\n"
        async for one in told:
            line: dict[str, Any] = dict(one)
            if "found" in line:
                found = line["found"] = dict(line["found"])
                if "refused" in found:
                    with speaking(lang):
                        found["refused"] = str(say(*found["refused"]))
                found["files_at"] = f"/files/{session.key}/{number}/"
            yield json.dumps(line, ensure_ascii=False).encode() + b"\n"

    # What was made -------------------------------------------------------------------------------

    async def made(self, request: Request) -> Response:
        """Give a file to whom it was made for; ``all.zip``: all of them."""
        key, number, name = (request.path_params[k] for k in ("key", "number", "path"))
        session = self.sessions.of(key)
        if session is None or not number.isdecimal():
            raise HTTPException(404)
        if name == "all.zip":
            data = await asyncio.to_thread(session.zipped, number)
            headers = {"Content-Disposition": 'attachment; filename="planmethod.zip"', **_SAFE}
            return Response(data, media_type="application/zip", headers=headers)
        path = session.file(number, name)
        if path is None:
            raise HTTPException(404)
        ending = path.suffix.lower()
        headers = {"Content-Security-Policy": _LIVE if "-live" in path.stem else _FILE, **_SAFE}
        shown = ending in (".html", ".svg") and "download" not in request.query_params
        return FileResponse(
            path,
            media_type=_KINDS.get(ending, "application/octet-stream"),
            headers=headers,
            filename=path.name,
            content_disposition_type="inline" if shown else "attachment",
        )


_SAFE = {
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Resource-Policy": "same-origin",
}
