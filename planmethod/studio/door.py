"""Who is let in to the studio: slow clients, pages of elsewhere (вход)."""

from __future__ import annotations

import asyncio
import hmac
from urllib.parse import urlencode, urlsplit

import h11
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import PlainTextResponse, Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send
from uvicorn.protocols.http.h11_impl import H11Protocol

from planmethod.languages import LANGUAGES, speaking, translate

SLOW = 15.0
"""Seconds that a request may take."""

RATE = 1024
"""Bytes of a request that give it one second more."""

UNREAD = 60.0
"""Seconds in which a client must read part of an answer: the system buffers megabytes itself."""


class PatientProtocol(H11Protocol):
    """HTTP with timeouts (соединение): a request in progress is never cut off."""

    _end: float | None = None
    _timer: asyncio.TimerHandle | None = None
    _unread: asyncio.TimerHandle | None = None

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Wait for a request from now on."""
        super().connection_made(transport)
        self._wait(0)

    def connection_lost(self, exc: Exception | None) -> None:
        """Wait no more."""
        self._stop_waiting()
        self.resume_writing()
        super().connection_lost(exc)

    def data_received(self, data: bytes) -> None:
        """Take a part of a request, and wait for the rest."""
        super().data_received(data)
        if self.conn.their_state in (h11.IDLE, h11.SEND_BODY):
            self._wait(len(data))
        else:
            self._stop_waiting()

    def pause_writing(self) -> None:
        """Check whether the client reads."""
        super().pause_writing()
        self._check_reader(self.transport.get_write_buffer_size())

    def resume_writing(self) -> None:
        """Continue with a client that reads."""
        super().resume_writing()
        if self._unread is not None:
            self._unread.cancel()
            self._unread = None

    def _wait(self, received: int) -> None:
        if self._end is None:
            self._end = self.loop.time() + SLOW
            self._check_deadline()
        else:
            self._end += received / RATE

    def _check_deadline(self) -> None:
        assert self._end is not None
        if self.loop.time() < self._end:
            self._timer = self.loop.call_at(self._end, self._check_deadline)
        else:
            self.transport.abort()

    def _check_reader(self, before: int) -> None:
        left = self.transport.get_write_buffer_size()
        if self._unread is not None and left >= before:
            self.transport.abort()
        else:
            self._unread = self.loop.call_later(UNREAD, self._check_reader, left)

    def _stop_waiting(self) -> None:
        self._end = None
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None


OWN_HOSTS = ("127.0.0.1", "localhost", "::1")
"""Names of the local machine: no external page is served under one of them."""

PRINTED = (
    "Open the address that planmethod studio printed at the start: the studio accepts no other."
)
INSTRUCTORS = "This is for the instructor only: open the link that was printed at the start."

_STATUS_MESSAGES = {
    401: "This session has ended. Reload the page.",
    403: INSTRUCTORS,
    404: "This address does not exist.",
    405: "This address does not support this method.",
}
"""Default messages by status."""

_SAFE = {
    "x-content-type-options": "nosniff",
    "referrer-policy": "no-referrer",
    "cross-origin-resource-policy": "same-origin",
}


def lang_of(request: Request) -> str:
    """Return the language of a request: its parameter, else that of its browser."""
    asked = request.query_params.get("lang", "")
    spoken = (asked, *request.headers.get("accept-language", "").split(","))
    codes = (one.split(";")[0].strip().split("-")[0].lower() for one in spoken)
    return next((code for code in codes if code in LANGUAGES), LANGUAGES[0])


def reject(request: Request, status: int, message: str, *facts: object) -> Response:
    """Return a rejection: one sentence, in the language of a request."""
    with speaking(lang_of(request)):
        return PlainTextResponse(translate(message, *facts), status, {"Cache-Control": "no-store"})


class StudioRefusal(HTTPException):
    """A rejected request (отказ): a sentence, and its facts; the status's own one by default."""

    def __init__(self, status: int, message: str = "", *facts: object) -> None:
        super().__init__(status, message or _STATUS_MESSAGES[status])
        self.facts = facts


def reject_error(request: Request, error: Exception) -> Response:
    """Return the response to an error or rejection in a route."""
    if isinstance(error, StudioRefusal):
        return reject(request, error.status_code, error.detail, *error.facts)
    if isinstance(error, HTTPException):  # where there is no such route
        return reject(request, error.status_code, _STATUS_MESSAGES[error.status_code])
    why = error.strerror if isinstance(error, OSError) else None
    return reject(request, 507, "The server cannot write its files: {}.", why or error)


class Door:
    """Admits requests with the token, and none that another site makes (вход).

    Parameters
    ----------
    token : str or None
        What the address has, and a cookie after it; None where strangers come.
    """

    def __init__(self, app: ASGIApp, *, token: str | None) -> None:
        self.app, self.token = app, token

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer, or let the studio answer."""
        if scope["type"] != "http":
            await self.app(scope, receive, send)
            return

        async def safely(message: Message) -> None:
            if message["type"] == "http.response.start":
                safe = [(key.encode(), value.encode()) for key, value in _SAFE.items()]
                message["headers"] = [*message.get("headers", ()), *safe]
            await send(message)

        await (self._answer(Request(scope)) or self.app)(scope, receive, safely)

    def _answer(self, request: Request) -> Response | None:
        """Return the response that replaces the studio's own; None if there is none."""
        if self.token is not None:
            if _host_and_port(request)[0] not in OWN_HOSTS:
                return reject(request, 403, "This studio answers only at 127.0.0.1 and localhost.")
            if request.scope["path"] == "/" and "token" in request.query_params:
                return self._admit(request)
            if not self._is(request.cookies.get(_cookie(request), "")):
                return reject(request, 403, PRINTED)
        if request.method not in ("GET", "HEAD"):
            if _is_foreign(request):
                return reject(
                    request, 403, "Another site made this request. Open the studio itself."
                )
            kind = request.headers.get("content-type", "").partition(";")[0].strip().lower()
            if request.method == "POST" and kind != "application/json":
                return reject(request, 415, "Requests to this address must be JSON (Content-Type).")
        return None

    def _is(self, token: str) -> bool:
        return bool(self.token) and hmac.compare_digest(token.encode(), str(self.token).encode())

    def _admit(self, request: Request) -> Response:
        """Set the cookie, and have the browser continue without the token in its address.

        A redirect would not do: where a file or another site has led here, its next request has no
        strict cookie; one that this page makes has.
        """
        if not self._is(request.query_params["token"]):
            return reject(request, 403, PRINTED)
        more = [(key, value) for key, value in request.query_params.multi_items() if key != "token"]
        onward = f"/?{urlencode(more)}" if more else "/"
        headers = {"Refresh": f"0; url={onward}", "Cache-Control": "no-store"}
        answer = Response(headers=headers, media_type="text/html")
        answer.set_cookie(_cookie(request), str(self.token), httponly=True, samesite="strict")
        return answer


def _cookie(request: Request) -> str:
    """Return the name of the cookie: browsers do not distinguish the ports of a host."""
    return f"planmethod-{_host_and_port(request)[1] or 80}"


def _host_and_port(request: Request) -> tuple[str | None, int | None]:
    """Return the host and the port that the browser knows the studio by."""
    return _place(f"//{request.headers.get('host', '')}")


def _place(address: str) -> tuple[str | None, int | None]:
    """Return the host and the port of an address; None for an invalid one."""
    try:
        parts = urlsplit(address)
        return parts.hostname, parts.port
    except ValueError:
        return None, None


def _is_foreign(request: Request) -> bool:
    """Return whether another site makes the request, by the browser's header, else by its origin.

    Behind a server that speaks TLS the host may have another name than for the browser.
    """
    site, origin = (request.headers.get(name) for name in ("sec-fetch-site", "origin"))
    if site is not None:
        return site != "same-origin"
    return origin is not None and _place(origin) != _host_and_port(request)
