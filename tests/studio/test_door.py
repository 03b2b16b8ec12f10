"""Access to one's own studio needs its address, and foreign pages cannot send requests."""

from __future__ import annotations

import contextlib
import functools
import http.server
import os
import re
import subprocess
import sys
import threading
from collections.abc import Iterator
from itertools import product
from pathlib import Path
from typing import Any

import odd_acts
import pytest

pytest.importorskip("starlette", reason="the studio's extra is not installed")
pytest.importorskip("uvicorn", reason="the studio's extra is not installed")
pytest.importorskip("httpx2", reason="starlette's test client needs httpx2")

from browser import PROGRAM, Page, browsing
from doors import LOCAL_LIMITS, PUBLIC_LIMITS, Desk, StudioSettings
from msgspec.structs import replace
from starlette.applications import Starlette
from starlette.routing import Route
from starlette.testclient import TestClient
from studying import come_in, studio
from visiting import HOME, enter, visiting
from waiting import wait_until
from worked import ROOT

TOKEN = "what-was-printed"
FEW = 30
"""Sessions that there may be."""


@pytest.fixture(scope="module")
def own(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    folder = tmp_path_factory.mktemp("own")
    (folder / "my.toml").write_text("mine = 1\n")
    settings = StudioSettings(
        limits=replace(LOCAL_LIMITS, sessions=FEW), token=TOKEN, processes=1, desk=Desk(folder)
    )
    with visiting(settings, odd_acts.act, folder / "sessions") as client:
        yield client


@pytest.fixture(scope="module")
def served(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    root = tmp_path_factory.mktemp("served") / "sessions"
    settings = StudioSettings(limits=PUBLIC_LIMITS, served=True, token=TOKEN, processes=1)
    with visiting(settings, odd_acts.act, root) as client:
        yield client


def addresses(client: TestClient) -> list[tuple[str, str]]:
    """Return a method and an address of every route."""
    assert isinstance(client.app, Starlette)
    found = [one for one in client.app.routes if isinstance(one, Route)]
    assert len(found) >= 12
    return [
        (method, re.sub(r"\{\w+(:path)?\}", "my.toml", one.path))
        for one in found
        for method in sorted(one.methods or ())
    ]


def asked(client: TestClient, method: str, address: str, **heads: str) -> Any:
    body = b"{}" if method in ("POST", "PUT") else None
    named = {key.replace("_", "-").encode(): value.encode() for key, value in heads.items()}
    kind = {b"content-type": b"application/json"}
    return client.request(method, address, headers=kind | named, content=body)


def sessions(client: TestClient) -> int:
    return int(client.get("/health").json()["sessions"])


@pytest.mark.parametrize("cookie", [None, "", "wrong", "\u043d\u0435\u0442", f"{TOKEN}x"])
def test_without_the_cookie_no_request_is_answered_or_carried_out(
    own: TestClient, cookie: str | None
) -> None:
    before, stranger = sessions(own), TestClient(own.app, base_url=HOME)
    heads = {"cookie": f"planmethod-8766={TOKEN}"}  # that of another studio
    if cookie is not None:
        heads["cookie"] += f"; planmethod-8765={cookie}"
    for method, address in addresses(own):
        answer = asked(stranger, method, f"{address}?lang=en", **heads)
        assert answer.status_code == 403, (method, address)
        assert method == "HEAD" or answer.text.startswith("Open the address that planmethod")
    assert stranger.get(f"/?token={TOKEN[:-1]}").status_code == 403
    assert stranger.get(f"/health?token={TOKEN}").status_code == 403
    assert sessions(own) == before


def test_the_address_gives_a_strict_cookie_and_leads_on_without_the_token(own: TestClient) -> None:
    stranger = TestClient(own.app, base_url=HOME, follow_redirects=False)
    answer = stranger.get(f"/?lang=en&token={TOKEN}")
    told = answer.headers["set-cookie"]
    assert re.match(r"planmethod-8765=", told)  # browsers do not separate cookies by port
    assert {"HttpOnly", "SameSite=strict", "Path=/"} <= {*told.split("; ")}
    assert answer.headers["refresh"] == "0; url=/?lang=en"
    assert answer.headers["referrer-policy"] == "no-referrer"
    assert answer.headers["cache-control"] == "no-store"
    page = stranger.get("/?lang=en")
    assert page.status_code == 200
    assert TOKEN not in page.text


@pytest.mark.parametrize("host", ["evil.example", "evil.example:8765", "127.0.0.1.evil.example",
                                  "localhost@evil.example", "[", "[::1", "", "a:b:c"])  # fmt: skip
def test_another_host_name_is_rejected(own: TestClient, host: str) -> None:
    for address in ("/", "/health", f"/?token={TOKEN}"):
        answer = asked(own, "GET", address, host=host)
        assert answer.status_code == 403
        assert "set-cookie" not in answer.headers


@pytest.mark.parametrize("host", ["localhost:8765", "127.0.0.1:9000", "[::1]:8765", "LOCALHOST"])
def test_every_own_name_of_the_machine_will_do(own: TestClient, host: str) -> None:
    assert asked(own, "GET", f"/?token={TOKEN}", host=host).status_code == 200


FOREIGN = (
    {"origin": "http://evil.example"}, {"origin": "null"}, {"origin": "http://127.0.0.1:8766"},
    {"origin": "http://localhost:8765"}, {"origin": "http://["}, {"origin": ""},
    {"sec_fetch_site": "cross-site"}, {"sec_fetch_site": "same-site"}, {"sec_fetch_site": "none"},
    {"sec_fetch_site": "cross-site", "origin": HOME},
)  # fmt: skip


def test_a_request_of_another_site_changes_no_state(own: TestClient, served: TestClient) -> None:
    for client, heads in product((own, served), FOREIGN):
        before = sessions(client)
        for method, address in addresses(client):
            if method not in ("GET", "HEAD"):
                answer = asked(client, method, f"{address}?lang=en", **heads)
                assert answer.status_code == 403, (method, address, heads)
                assert answer.text == "Another site made this request. Open the studio itself."
        assert sessions(client) == before


def test_its_own_page_is_let_in_also_behind_a_server_of_another_name(served: TestClient) -> None:
    for heads in (
        {"origin": HOME}, {"origin": HOME, "sec_fetch_site": "same-origin"}, {},
        {"origin": "https://studio.example", "sec_fetch_site": "same-origin"},
    ):  # fmt: skip
        assert asked(served, "POST", "/api/session", **heads).status_code == 200


KINDS = ("text/plain", "", "application/x-www-form-urlencoded", "multipart/form-data", "text/json")


def test_posted_data_must_be_json(own: TestClient, served: TestClient) -> None:
    for client, kind in product((own, served), KINDS):
        for method, address in addresses(client):
            if method == "POST":
                assert asked(client, method, address, content_type=kind).status_code == 415
    right = asked(own, "POST", "/api/session", content_type="Application/JSON; charset=utf-8")
    assert right.status_code == 200


def test_neither_strangers_nor_the_owners_pages_lock_the_owner_out(own: TestClient) -> None:
    stranger = TestClient(own.app, base_url=HOME)
    codes = {stranger.post("/api/session", json={}).status_code for _ in range(2 * FEW)}
    assert codes == {403}
    assert len({enter(own)["x-studio"] for _ in range(2 * FEW)}) == 2 * FEW
    assert sessions(own) == FEW


# With a browser ----------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Page]:
    with browsing(tmp_path_factory.mktemp("browser")) as page:
        yield page


@contextlib.contextmanager
def another_site(folder: Path) -> Iterator[int]:
    (folder / "index.html").write_text("<!DOCTYPE html><title>elsewhere</title>")

    class Silent(http.server.SimpleHTTPRequestHandler):
        def log_message(self, *_: object) -> None:
            """Do not log."""

    serving = functools.partial(Silent, directory=str(folder))
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), serving) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield server.server_port
        server.shutdown()


TRIED = """
(async () => {
  const tried = {}, at = ADDRESS;
  const json = { "Content-Type": "application/json" };
  for (const [name, options] of Object.entries({
    "read": {}, "read with cookies": { credentials: "include" },
    "post": { method: "POST", body: "{}", headers: json, credentials: "include" },
  })) {
    const path = options.method ? "api/session" : "";
    tried[name] = await fetch(at + path, options).then(one => one.text(), () => "no");
  }
  for (const kind of ["text/plain", "application/x-www-form-urlencoded"]) {
    await fetch(at + "api/session", { method: "POST", mode: "no-cors", credentials: "include",
      headers: { "Content-Type": kind }, body: "{}" }).catch(() => 0);
  }
  for (const tag of ["img", "script", "iframe"]) {
    const one = document.createElement(tag);
    tried[tag] = await new Promise(done => {
      one.onload = () => done(tag === "iframe" ? String(one.contentDocument) : "loaded");
      one.onerror = () => done("no");
      one.src = at + { img: "picture/linkages-ex3.svg", script: "static/api.js", iframe: "" }[tag];
      document.body.append(one);
    });
  }
  globalThis.tried = tried;
})()
"""


@pytest.mark.skipif(PROGRAM is None, reason="Chromium looks at the page")
def test_a_foreign_page_can_neither_read_nor_act(page: Page, tmp_path: Path) -> None:
    with studio() as (address,), another_site(tmp_path) as port:
        come_in(page, address)
        entered = (
            "fetch('health').then(one => one.json()).then(one => { globalThis.n = one.sessions; })"
        )
        page.wait("document.querySelectorAll('#tasks li').length > 3")
        for site in (f"http://127.0.0.1:{port}/", f"http://localhost:{port}/",
                     (tmp_path / "index.html").as_uri()):  # fmt: skip
            page.open(site)
            page.ask(f"void {TRIED.replace('ADDRESS', repr(address)).strip()}")
            told = page.wait("globalThis.tried")
            assert {*told.values()} == {"no", "null"}, (site, told)
        come_in(page, address)
        page.wait("document.querySelectorAll('#tasks li').length > 3")
        page.ask(entered)
        assert page.wait("globalThis.n") == 2  # those of the studio's own page


@pytest.mark.skipif(PROGRAM is None or os.name == "nt", reason="Chromium looks at the page")
def test_open_passes_the_token_to_the_browser_and_not_to_the_list_of_processes(
    page: Page, tmp_path: Path
) -> None:
    opener, told = tmp_path / "xdg-open", tmp_path / "told"
    opener.write_text(f'#!/bin/sh\necho "$@" > {told}.part\nmv {told}.part {told}\n')
    opener.chmod(0o755)
    command = [sys.executable, "-m", "planmethod", "studio", "--port", "0", "--lang", "en"]
    path = f"{tmp_path}{os.pathsep}{os.environ['PATH']}"
    with subprocess.Popen(
        [*command, "--open"], stdout=subprocess.PIPE, text=True, cwd=ROOT,
        env={**os.environ, "PATH": path},
    ) as running:  # fmt: skip
        assert running.stdout is not None
        try:
            printed = re.findall(r"http://\S+", running.stdout.readline())[0]
            wait_until(told.exists)
            leading = Path(told.read_text().strip())
            token = printed.partition("token=")[2]
            assert len(token) > 30
            lists = [one.read_bytes() for one in Path("/proc").glob("[0-9]*/cmdline")]
            assert all(token.encode() not in one for one in (*lists, str(leading).encode()))
            assert leading.parent.stat().st_mode & 0o077 == 0
            page.open(leading)
            page.wait("document.querySelectorAll('#tasks li').length > 3")
            assert page.ask("location.href") == printed.partition("?")[0]
            assert not page.ask("document.referrer")
        finally:
            running.terminate()
            running.wait()
