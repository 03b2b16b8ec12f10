"""Headless Chromium by its protocol over a pipe: pages opened, queried, captured (браузер)."""

from __future__ import annotations

import base64
import contextlib
import json
import os
import shutil
import subprocess
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

PATIENCE = 600.0
"""Seconds after which a process counts as hung: a merely slow one is faster."""
PROGRAM = shutil.which("chromium")


class Page:
    """One page of a headless browser (страница).

    ``said`` has its console output and its exceptions.
    """

    def __init__(self, send: int, receive: int) -> None:
        self._send, self._receive, self._number = send, receive, 0
        self._session: str | None = None
        self._left = b""
        self.said: list[str] = []
        self._loaded = False
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        attached = self.call("Target.attachToTarget", targetId=target, flatten=True)
        self._session = attached["sessionId"]
        for domain in ("Page", "Runtime", "Log"):
            self.call(f"{domain}.enable")

    def call(self, method: str, **params: Any) -> dict[str, Any]:
        """Call a method of the protocol and return its result."""
        self._number += 1
        number = self._number
        message: dict[str, Any] = {"id": number, "method": method, "params": params}
        if self._session is not None:
            message["sessionId"] = self._session
        os.write(self._send, json.dumps(message).encode() + b"\0")
        while True:
            told = self._next()
            if told.get("id") == number:
                assert "error" not in told, told
                result: dict[str, Any] = told["result"]
                return result

    def _next(self) -> dict[str, Any]:
        while b"\0" not in self._left:
            more = os.read(self._receive, 1 << 20)
            assert more, "the browser has gone"
            self._left += more
        whole, _, self._left = self._left.partition(b"\0")
        told: dict[str, Any] = json.loads(whole)
        if told.get("method") in ("Runtime.consoleAPICalled", "Runtime.exceptionThrown",
                                  "Log.entryAdded"):  # fmt: skip
            self.said.append(json.dumps(told["params"]))
        self._loaded |= told.get("method") == "Page.loadEventFired"
        return told

    def open(
        self, page: Path | str, *, width: int = 1200, height: int = 900, dark: bool = False,
        leads: bool = False,
    ) -> None:  # fmt: skip
        """Open a file or address in a window of this size; ``leads``: it goes to another page."""
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height,
                  deviceScaleFactor=1, mobile=width < 600)  # fmt: skip
        scheme = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
        self.call("Emulation.setEmulatedMedia", features=[scheme])
        self._loaded = False
        self.call("Page.navigate", url=page if isinstance(page, str) else page.resolve().as_uri())
        self._until_loaded()
        if leads:
            self._loaded = False
            self._until_loaded()

    def leave(self, expression: str) -> None:
        """Run an expression that leads to another page, and wait until that is loaded."""
        self._loaded = False
        self.ask(expression)
        self._until_loaded()

    def _until_loaded(self) -> None:
        while not self._loaded:
            self._next()

    def ask(self, expression: str) -> Any:
        """Return the value of an expression of JavaScript."""
        told = self.call("Runtime.evaluate", expression=expression, returnByValue=True)
        assert "exceptionDetails" not in told, told["exceptionDetails"]
        return told["result"].get("value")

    def wait(self, expression: str) -> Any:
        """Return the value of an expression as soon as it is truthy."""
        end = time.monotonic() + PATIENCE
        plain = f"(found => found instanceof Node || found)({expression})"
        while not (value := self.ask(plain)):
            assert time.monotonic() < end, (expression, self.said)
            time.sleep(0.05)
        return value

    def look(self, file: Path) -> None:
        """Write a picture of the whole page."""
        told = self.call("Page.captureScreenshot", captureBeyondViewport=True)
        file.write_bytes(base64.b64decode(told["data"]))


@contextlib.contextmanager
def browsing(folder: Path) -> Iterator[Page]:
    """Open a browser whose files are in a folder (запуск браузера)."""
    assert PROGRAM is not None
    (to_browser, send), (receive, from_browser) = os.pipe(), os.pipe()

    def numbered() -> None:  # the browser reads from 3 and writes to 4
        spare = [os.dup(end) for end in (to_browser, to_browser, from_browser, from_browser)]
        os.dup2(spare[1], 3)
        os.dup2(spare[3], 4)

    command = [
        PROGRAM, "--headless", "--no-sandbox", "--hide-scrollbars", "--disable-gpu",
        "--remote-debugging-pipe",
        f"--user-data-dir={folder}",
    ]  # fmt: skip
    done = subprocess.Popen(
        command, pass_fds=(3, 4), preexec_fn=numbered, stderr=subprocess.DEVNULL
    )
    os.close(to_browser)
    os.close(from_browser)
    try:
        yield Page(send, receive)
    finally:
        # A browser told to close removes its temporary folder; a killed one does not.
        os.write(send, b'{"id": 0, "method": "Browser.close"}\0')
        while os.read(receive, 1 << 20):  # it cannot end until its last messages are read
            pass
        done.wait()
        os.close(send)
        os.close(receive)
