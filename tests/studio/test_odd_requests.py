"""Every request to the studio is answered: with the requested result, or with a sentence."""

from __future__ import annotations

import json
import os
import pickle
import re
from collections.abc import Iterator
from itertools import product
from pathlib import Path
from typing import Any

import odd_acts
import pytest
from cases import sampled, thinned

pytest.importorskip("starlette", reason="the studio's extra is not installed")
pytest.importorskip("httpx2", reason="starlette's test client needs httpx2")

from doors import (
    ACTS,
    LOCAL_LIMITS,
    ArgumentError,
    Desk,
    StudioRequest,
    StudioSettings,
    act,
    build_job,
    request_of,
)
from msgspec.structs import fields, replace
from starlette.applications import Starlette
from starlette.routing import Route
from starlette.testclient import TestClient
from visiting import enter, visiting
from worked import PROBLEMS

PARTS = (
    "%00", "a%00.toml", "a" * 300, f"{'a' * 300}.toml", f"{'a' * 300}.csv", "9" * 300, "9" * 5000,
    "-1", "0", "00", "1e9", "%D9%A1", "%C2%B2", "%F0%9F%99%82", f"{'%F0%9F%99%82' * 60}.toml",
    f"{'%F0%9F%99%82' * 60}.csv", f"{'%F0%9F%99%82' * 30}.csv", "%ED%A0%80", "%FF.toml", "%0A",
    ".", "..", "%2e%2e", "%2e%2e%2fx.csv", "x%5cy.csv", ".csv", "CON.csv", "%20", "%25",
    "pipe.toml", "1", "all.zip", "1251.toml", "large.toml", "folder.toml",
)  # fmt: skip
"""Parts of an address."""

DEEP = "[" * 600 + "]" * 600
VALUES = (
    "null", "true", "-1", "0", "2.5", "1e400", "-1e-400", "NaN", "9" * 300, "9" * 5000, '""',
    '"\\u0000"', '"\\ud800"', '"\\udfff\\ud800"', '"\\ud83d\\ude42"', f'"{"a" * 300}"',
    f'"{"9" * 300}"', '"--out"', '"../../x"', '"\\u202e"', '"project"', "[]", "{}", "[{}]",
    '[{"student": 1}]', '{"a": {"a": []}}', DEEP, f'{{"a": {DEEP}}}', f'{{"a": {DEEP * 20}',
    '{"\\ud800": 1}', '"variants = \\"\\\\u0000.csv\\""', f'"variants = \\"{"a" * 300}.csv\\""',
)  # fmt: skip
"""Values of a field, as JSON has them."""

BODIES = (
    b"", b"[]", b"1", b'"a"', b"null", b"{", b"}", b"\xff", b"\x00", b'{"text": "\xff"}', b"{}{}",
    b'{"text": "\xed\xa0\x80"}', b"[" * 5000, b'{"a": ' * 5000, b"x" * (LOCAL_LIMITS.text + 1),
    '{"text": "x"}'.encode("utf-16"),
)  # fmt: skip

CYRILLIC = re.compile("[а-яё]", re.IGNORECASE)


@pytest.fixture(scope="module")
def client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    folder = tmp_path_factory.mktemp("odd")
    (folder / "1251.toml").write_bytes("title = 'Кулиса'".encode("cp1251"))
    (folder / "large.toml").write_bytes(b"#" * 300_000)
    (folder / "folder.toml").mkdir()
    if os.name != "nt":
        os.mkfifo(folder / "pipe.toml")
    settings = StudioSettings(
        limits=replace(LOCAL_LIMITS, rate=1e9, stored_results=10**6),
        token="t",
        processes=2,
        desk=Desk(folder),
    )
    with visiting(settings, odd_acts.act, folder / "sessions") as client:
        client.headers |= enter(client)
        client.post("/api/do/sketched", json={})
        (first,) = (folder / "sessions").glob("*/1")
        (first / "out").mkdir()
        (first / "out/x").write_text("made")
        yield client


def tell(answer: Any, what: object) -> None:
    """Assert that an answer is the requested result, or one sentence."""
    assert answer.status_code < 500, what
    if answer.status_code >= 400 and answer.request.method != "HEAD":
        if answer.status_code == 409 and answer.headers["content-type"] == "application/json":
            return  # another state of a file
        assert re.fullmatch(r"[^\n]+\.", answer.text), (what, answer.text)
        assert not CYRILLIC.search(answer.text.partition(":")[2]), (what, answer.text)
        assert len(answer.text) < 400, what


def patterns(client: TestClient) -> list[str]:
    assert isinstance(client.app, Starlette)
    return [one.path for one in client.app.routes if isinstance(one, Route)]


METHODS = ("HEAD", "POST", "PUT", "DELETE", "OPTIONS", "TRACE")


def test_every_address_is_answered(client: TestClient) -> None:
    usual = {"key": client.headers["x-studio"], "number": "1", "name": "x", "mark": "x"}
    usual |= {"do": "sketched", "path": "x"}
    places = [
        (pattern.replace(":path", ""), name)
        for pattern in patterns(client)
        for name in re.findall(r"\{(\w+)(?::path)?\}", pattern)
    ]
    others = thinned([*product(PARTS, METHODS, places)], 11)
    for part, method, place in sampled([*product(PARTS, ("GET",), places), *others], 3):
        address = place[0].format(**usual | {place[1]: part})
        body = b"{}" if method in ("POST", "PUT") else None
        heads = {"content-type": "application/json"}
        answer = client.request(method, f"{address}?lang=en", content=body, headers=heads)
        tell(answer, (method, address))


def test_every_question_of_an_address_is_answered(client: TestClient) -> None:
    for pattern in patterns(client):
        address = re.sub(r"\{\w+(:path)?\}", "linkages-ex3", pattern)
        for part in thinned(PARTS, 3):
            answer = client.get(f"{address}?lang={part}&variant={part}&search={part}&mark={part}")
            assert answer.status_code < 500, (address, part)


def test_every_body_is_answered(client: TestClient) -> None:
    for pattern in patterns(client):
        address = pattern.replace("{do}", "sketched").replace("{name}", "x.toml")
        for body in BODIES:
            heads = {"content-type": "application/json"}
            answer = client.post(f"{address}?lang=en", content=body, headers=heads)
            tell(answer, (address, body[:20]))


def test_every_field_is_answered_for_any_value(client: TestClient) -> None:
    names = [one.name for one in fields(StudioRequest)]
    for number, (field, value) in enumerate(sampled(thinned([*product(names, VALUES)], 3), 3)):
        do = ACTS[number % len(ACTS)]
        body = f'{{"what": "tables", "file": "x.toml", "{field}": {value}}}'.encode()
        heads = {"content-type": "application/json"}
        for address in (f"/api/do/{do}", "/api/session", "/api/file/x.toml"):
            answer = client.post(f"{address}?lang=en", content=body, headers=heads)
            tell(answer, (address, body[:80]))
            if answer.status_code == 200 and do in address:
                found = json.loads(answer.text.splitlines()[-1])["found"]
                assert "refused" not in found, (address, body[:80])


def test_every_field_is_validated_before_the_work_begins() -> None:
    for one in fields(StudioRequest):
        refused = 0
        for value in VALUES:
            try:
                request_of(f'{{"{one.name}": {value}}}'.encode())
            except ArgumentError:
                refused += 1
        assert refused > len(VALUES) // 2 - 2, one.name
    for value in VALUES:
        if DEEP in value:
            with pytest.raises(ArgumentError):
                request_of(f'{{"work": {value}}}'.encode())


EX3 = (PROBLEMS / "linkages/ex3.toml").read_text("utf-8")
ODD: list[Any] = ["\0", "a" * 300, "9" * 300, "🙂", "", None, True, 10**19, 1e300, [], {}, [[]]]
WORKS = [
    {"student": value, "answers": [{"id": value, "value": value, "unit": value, "mm": value}]}
    for value in ODD
]
TEXTS = ["\0", "\ufeff", "🙂 = 1", "[" * 3000, "a." * 60 + "b = 1", "x = 1e999", f"x = {'9' * 300}",
         f'title = "{"🙂" * 200}"', "[links]\n1 = 2", "[[answers]]\nwhat = []", "\u2028",
         "\x85="]  # fmt: skip


@pytest.mark.parametrize("number", thinned(range(len(WORKS)), 5))
def test_no_work_and_no_text_causes_an_internal_error(tmp_path: Path, number: int) -> None:
    told: list[tuple[str, dict[str, Any]]] = [
        (do, {"text": TEXTS[number], "name": "\u202e🙂" * 40, "what": "tables"})
        for do in ("sketched", "assemblies", "questions", "command")
    ]
    told.append(("verdicts", {"text": EX3, "work": WORKS[number]}))
    for count, (do, more) in enumerate(told):
        request = request_of(json.dumps(more).encode())
        asked = build_job(do, request, lang="en", layouts=(), works=tmp_path, served=True)
        assert asked is not None
        folder = tmp_path / str(count)
        folder.mkdir()
        found = act(asked | {"folder": str(folder)}, lambda share: None)
        pickle.dumps(found)
        text = json.dumps(found, ensure_ascii=False).encode().decode()
        assert "Internal error" not in text, (do, more)
        assert "Traceback" not in text
