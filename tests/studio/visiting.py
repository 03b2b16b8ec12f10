"""A studio whose routes are called without a network, by a client with its printed address."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from pathlib import Path

from doors import Act, StudioSettings, application
from starlette.testclient import TestClient

HOME = "http://127.0.0.1:8765"


@contextlib.contextmanager
def visiting(settings: StudioSettings, act: Act, root: Path) -> Iterator[TestClient]:
    """Start a studio and come in."""
    with TestClient(application(settings, act, root), base_url=HOME) as client:
        if not settings.served:
            assert client.get(f"/?token={settings.token}").status_code == 200
        yield client


def enter(client: TestClient, token: str = "") -> dict[str, str]:
    """Begin a session; the header that names it."""
    return {"x-studio": client.post("/api/session", json={"token": token}).json()["key"]}
