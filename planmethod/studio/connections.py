"""Connections of the studio: clients that do not send or read in time are cut off."""

from __future__ import annotations

import asyncio

import h11
from uvicorn.protocols.http.h11_impl import H11Protocol

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
