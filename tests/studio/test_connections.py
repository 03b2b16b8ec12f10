"""Slow visitors of a real server: cut off, while others are answered."""

from __future__ import annotations

import asyncio
import contextlib
import socket
import threading
import time
from collections.abc import Iterator
from typing import Any

import pytest

pytest.importorskip("uvicorn", reason="the studio's extra is not installed")

import uvicorn
from doors import connections
from waiting import wait_until

LARGE = 32 << 20


async def application(scope: Any, receive: Any, send: Any) -> None:
    """Read all that comes, and answer with how much it was, or with much."""
    assert scope["type"] == "http"
    size, more = 0, True
    while more:
        part = await receive()
        if part["type"] == "http.disconnect":
            return
        size, more = size + len(part["body"]), part["more_body"]
    await asyncio.sleep(2 * connections.SLOW if scope["path"] == "/long" else 0)
    body = b"x" * LARGE if scope["path"] == "/large" else str(size).encode()
    await send({"type": "http.response.start", "status": 200,
                "headers": [(b"content-length", str(len(body)).encode())]})  # fmt: skip
    await send({"type": "http.response.body", "body": body})


@pytest.fixture
def port(monkeypatch: pytest.MonkeyPatch) -> Iterator[int]:
    monkeypatch.setattr(connections, "SLOW", 0.5)
    monkeypatch.setattr(connections, "RATE", 100)
    monkeypatch.setattr(connections, "UNREAD", 1.0)
    with socket.socket() as listening:
        listening.bind(("127.0.0.1", 0))
        listening.listen(300)
        config = uvicorn.Config(
            application, http=connections.PatientProtocol, lifespan="off", log_level="warning"
        )
        server = uvicorn.Server(config)
        running = threading.Thread(target=server.run, kwargs={"sockets": [listening]}, daemon=True)
        running.start()
        wait_until(lambda: server.started)
        yield listening.getsockname()[1]
        server.should_exit = True
        running.join()


def connected(stack: contextlib.ExitStack, port: int, said: bytes) -> socket.socket:
    one = stack.enter_context(socket.create_connection(("127.0.0.1", port)))
    one.settimeout(60)
    one.sendall(said)
    return one


def answered(one: socket.socket, last: bytes) -> bool:
    """Return whether an answer ends so, which may come in parts."""
    got = one.recv(1000)
    while got and not got.endswith(b"\r\n" + last):
        got += one.recv(1000)
    return got.endswith(last)


def is_cut_off(one: socket.socket) -> bool:
    one.setblocking(False)
    try:
        return one.recv(1) == b""
    except BlockingIOError:
        return False
    except OSError:
        return True


HEAD = b"GET / HTTP/1.1\r\nHost: a\r\nX-Slow: "
BODY = b"POST / HTTP/1.1\r\nHost: a\r\nContent-Length: 5000\r\n\r\nx"
WHOLE = b"GET / HTTP/1.1\r\nHost: a\r\n\r\n"


def test_a_client_that_does_not_finish_is_cut_off_and_others_are_answered(port: int) -> None:
    with contextlib.ExitStack() as stack:
        slow = [connected(stack, port, said) for said in (b"", HEAD, BODY) for _ in range(70)]
        other = connected(stack, port, WHOLE)
        assert other.recv(12) == b"HTTP/1.1 200"

        def are_cut_off() -> bool:
            for one in slow:
                with contextlib.suppress(OSError):
                    one.send(b"y")  # each a letter now and then
            return all(is_cut_off(one) for one in slow)

        wait_until(are_cut_off)


def test_a_client_that_continues_is_never_cut_off(port: int) -> None:
    with contextlib.ExitStack() as stack:
        one = connected(stack, port, BODY)
        for _ in range(8):
            time.sleep(0.2)
            one.sendall(b"y" * 100)
        one.sendall(b"z" * 4199)
        assert answered(one, b"5000")
        one.sendall(WHOLE.replace(b"/ ", b"/long ", 1))  # a computed answer takes time
        assert answered(one, b"0")


def test_a_client_that_takes_no_answer_is_cut_off_and_a_slow_reader_is_not(port: int) -> None:
    with contextlib.ExitStack() as stack:
        asks = WHOLE.replace(b"/ ", b"/large ", 1)
        never, slowly = connected(stack, port, asks), connected(stack, port, asks)
        got, began = 0, time.monotonic()
        while time.monotonic() - began < 2.5:
            got += len(slowly.recv(1 << 20))
            time.sleep(0.1)
        while part := slowly.recv(1 << 20):
            got += len(part)
            if got > LARGE:
                break
        assert got > LARGE
        left = 0
        with contextlib.suppress(OSError):
            while part := never.recv(1 << 20):
                left += len(part)
        assert left < LARGE
