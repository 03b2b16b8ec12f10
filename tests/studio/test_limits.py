"""Limits of the studio's processes, queue and sessions against excessive requests."""

from __future__ import annotations

import contextlib
import json
import re
import sys
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from unittest.mock import ANY

import odd_acts
import pytest
from msgspec.structs import replace
from visiting import enter, visiting
from waiting import PATIENCE, wait_until

pytest.importorskip("starlette", reason="the studio's extra is not installed")
pytest.importorskip("httpx2", reason="starlette's test client needs httpx2")

from doors import (
    LOCAL_LIMITS,
    MB,
    PUBLIC_LIMITS,
    Bucket,
    Desk,
    Sessions,
    StudioLimits,
    StudioSession,
    StudioSettings,
)
from starlette.testclient import TestClient
from worked import ROOT

LIMITS = replace(
    PUBLIC_LIMITS, seconds=PATIENCE, slow_seconds=PATIENCE, trusted_seconds=PATIENCE,
    memory=500 * MB, text=4096, upload=2000, uploads=3000, waiting=6, session_waiting=2,
    sessions=40, rate=0.001, burst=30.0, stored_results=3,
)  # fmt: skip
TOKEN = "a token of the instructor"


@pytest.fixture(scope="module")
def client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    yield from serving(tmp_path_factory, LIMITS)


@pytest.fixture(scope="module")
def hurried(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    """A studio with a short time limit for strangers."""
    yield from serving(tmp_path_factory, replace(LIMITS, seconds=0.5))


def serving(factory: pytest.TempPathFactory, limits: StudioLimits) -> Iterator[TestClient]:
    settings = StudioSettings(limits=limits, served=True, token=TOKEN, processes=2)
    root = factory.mktemp("studio") / "sessions"
    with visiting(settings, odd_acts.act, root) as client:
        yield client
    assert not root.exists()  # no file is left behind


def lines(
    client: TestClient, who: dict[str, str], text: str, do: str = "sketched", **more: Any
) -> list[Any]:
    answer = client.post(f"/api/do/{do}?lang=en", headers=who, json={"text": text, **more})
    assert answer.status_code == 200, answer.text
    return [json.loads(line) for line in answer.text.splitlines()]


def found(client: TestClient, who: dict[str, str], text: str, do: str = "sketched") -> Any:
    return lines(client, who, text, do)[-1]["found"]


def ask_whole(client: TestClient, who: dict[str, str], text: str, what: str) -> Any:
    return lines(client, who, text, "command", what=what)[-1]["found"]


@contextlib.contextmanager
def three_processes(folder: Path) -> Iterator[TestClient]:
    settings = StudioSettings(limits=LIMITS, served=True, token=TOKEN, processes=3)
    with visiting(settings, odd_acts.act, folder / "sessions") as client:
        yield client


def test_a_request_that_takes_too_long_is_stopped_and_another_process_goes_on(
    hurried: TestClient,
) -> None:
    said = found(hurried, enter(hurried), "burn 60")["refused"]
    assert said.startswith("This takes more than 0.5 s of processor time")
    who = enter(hurried, TOKEN)
    assert found(hurried, who, "good morning")["said"] == "good morning"


def test_an_instructor_has_more_time(hurried: TestClient) -> None:
    told = lines(hurried, enter(hurried, TOKEN), "burn 1")
    assert told[-1]["found"]["said"] == "burn 1"
    shares = [one["share"] for one in told if "share" in one]
    assert shares == sorted(shares)
    assert len(shares) == 10


def test_time_is_that_of_a_processor_and_waiting_is_free(hurried: TestClient) -> None:
    assert found(hurried, enter(hurried), "sleep 1")["said"] == "sleep 1"


def test_a_project_has_more_time_than_a_sheet_and_a_session_one_at_a_time(
    hurried: TestClient, tmp_path: Path
) -> None:
    who, other, gate = enter(hurried), enter(hurried), tmp_path / "gate"
    assert ask_whole(hurried, who, "burn 1", "project")["said"] == "burn 1"
    assert "0.5 s" in ask_whole(hurried, who, "burn 60", "tables")["refused"]
    with three_processes(tmp_path) as client:
        who, other = enter(client), enter(client)
        first = Asking(client, who, f"hold {gate}", "command", what="project")
        second = Asking(client, who, f"hold {gate}", "command", what="note")
        assert waiting(client) == 1  # though one more process is free
        assert ask_whole(client, other, "x", "note")["said"] == "x"
        gate.touch()
        for one in (first, second):
            one.join()
        assert all("said" in one.told[-1]["found"] for one in (first, second))


@pytest.mark.skipif(sys.platform == "win32", reason="this system bounds no process")
def test_memory_is_bounded(client: TestClient) -> None:
    who = enter(client, TOKEN)
    assert "more memory" in found(client, who, "fill 600")["refused"]
    assert found(client, who, "fill 40")["held"] == 40


@pytest.mark.skipif(sys.platform == "win32", reason="there are no signals")
@pytest.mark.parametrize(
    ("text", "why"),
    [("die 1", "code 1)"), ("kill SIGKILL", "code SIGKILL)"), ("kill SIGSEGV", "SIGSEGV)"),
     ("fill 600", "more memory"), ("nest", "nested too deep")],
)  # fmt: skip
def test_a_process_that_ends_is_replaced_and_the_known_reason_is_reported(
    client: TestClient, text: str, why: str
) -> None:
    who = enter(client)
    said = found(client, who, text)["refused"]
    assert why in said
    assert ("memory" in said) == (text == "fill 600")
    assert found(client, who, "b")["said"] == "b"


class Asking(threading.Thread):
    """A client whose request is running or queued once this exists; ``told`` has its answers."""

    def __init__(
        self, client: TestClient, who: dict[str, str], text: str, do: str, **more: Any
    ) -> None:
        super().__init__()
        self.client, self.who, self.text, self.do, self.more = client, who, text, do, more
        self.told: list[Any] = []
        before = taken(client)
        self.start()
        wait_until(lambda: taken(client) > before or not self.is_alive())

    def run(self) -> None:
        self.told = lines(self.client, self.who, self.text, self.do, **self.more)


def taken(client: TestClient) -> int:
    """Return how many the server has ever taken, that are not superseded."""
    told = client.get("/health").json()
    return int(told["busy"] + told["waiting"] + told["done"])


def waiting(client: TestClient) -> int:
    return int(client.get("/health").json()["waiting"])


def test_a_waiting_client_gets_its_place_and_quick_requests_go_first(
    client: TestClient, tmp_path: Path
) -> None:
    def ask(do: str, name: str) -> Asking:
        return Asking(client, enter(client), f"hold {tmp_path / name}", do)

    long = [ask("sheets", "long") for _ in range(3)]
    assert waiting(client) == 2  # the long ones have one process
    assert found(client, enter(client), "at once")["said"] == "at once"
    assert waiting(client) == 2
    quick = [ask("sketched", "quick") for _ in range(2)]
    assert waiting(client) == 3
    (tmp_path / "quick").touch()
    for one in quick:
        one.join()
    assert waiting(client) == 2
    (tmp_path / "long").touch()
    for one in long:
        one.join()
    assert quick[1].told[0] == {"place": 1}  # before the long ones that were there
    places = [one["place"] for one in long[2].told if one.get("place")]
    assert places[0] == 2
    assert places == sorted(places, reverse=True)
    assert all("said" in one.told[-1]["found"] for one in (*long, *quick))  # no job is lost


def test_later_typing_replaces_a_waiting_request(client: TestClient, tmp_path: Path) -> None:
    who, gate = enter(client), tmp_path / "gate"
    at_work = [Asking(client, enter(client), f"hold {gate}", "sketched") for _ in range(2)]
    old = Asking(client, who, "old", "sketched")
    other = Asking(client, enter(client), "other", "sketched")
    new = threading.Thread(target=lambda: told.extend(lines(client, who, "new")))
    told: list[Any] = []
    new.start()
    old.join()  # it goes while the others wait
    assert waiting(client) == 2
    gate.touch()
    for one in (*at_work, other, new):
        one.join()
    assert old.told[-1]["found"] == {"superseded": True, "files_at": ANY}
    assert told[0] == {"place": 1}  # before a client that came later than the older one
    assert told[-1]["found"]["said"] == "new"
    assert other.told[-1]["found"]["said"] == "other"
    assert told[-1]["waited"] > 0


def test_one_session_cannot_fill_the_queue(client: TestClient, tmp_path: Path) -> None:
    who, gate = enter(client), tmp_path / "gate"
    two = [Asking(client, who, f"hold {gate}", "sheets") for _ in range(2)]
    codes = [
        client.post("/api/do/sheets?lang=en", headers=who, json={"text": "x"}).status_code
        for _ in range(3)
    ]
    assert codes == [503] * 3
    gate.touch()
    for one in two:
        one.join()
    assert all("said" in one.told[-1]["found"] for one in two)
    assert found(client, who, "x", "sheets")["said"] == "x"


def test_a_client_that_asks_too_often_has_to_wait(client: TestClient) -> None:
    who = enter(client)
    codes = [
        client.post("/api/do/sketched?lang=en", headers=who, json={"text": "x"}).status_code
        for _ in range(31)
    ]
    assert codes.count(200) == 30
    assert set(codes[30:]) == {429}


def test_sizes_are_bounded(client: TestClient) -> None:
    who = enter(client, TOKEN)
    answer = client.post("/api/do/sketched?lang=en", headers=who, json={"text": "x" * 5000})
    assert (answer.status_code, answer.text) == (413, "This is larger than 4 KiB. Send less.")
    put = [
        client.put(f"/api/works/{name}?lang=en", headers=who, content=b"x" * size).status_code
        for name, size in (("a.csv", 2001), ("a.csv", 1900), ("b.csv", 1900), ("c.exe", 10))
    ]
    assert put == [413, 200, 413, 415]


@pytest.mark.parametrize(
    "address",
    ["/files/{key}/1/../../x", "/files/{key}/../1/x", "/files/{key}/1/%2e%2e/%2e%2e/works/a.csv",
     "/files/{key}/1//etc/passwd", "/files/nobody/1/x", "/files/{key}/0x1/all.zip",
     "/static/..%2fserver.py", "/static/studio.html", "/api/start/..%2f..%2fsetup"],
)  # fmt: skip
def test_no_address_leads_out(client: TestClient, address: str) -> None:
    who = enter(client)
    found(client, who, "something")
    assert client.get(address.format(key=who["x-studio"])).status_code == 404


def test_requests_need_a_key_and_those_of_instructors_the_token(
    client: TestClient,
) -> None:
    assert client.post("/api/do/sketched", json={"text": ""}).status_code == 401
    guessed = client.post("/api/do/sketched", headers={"x-studio": "guess"}, json={})
    assert guessed.status_code == 401
    for token in ("", "wrong"):
        who = enter(client, token)
        for do, more in (("checked", {}), ("varied", {}), ("command", {"what": "key"})):
            answer = client.post(f"/api/do/{do}", headers=who, json={"text": "", **more})
            assert answer.status_code == 403
        assert client.put("/api/works/a.csv", headers=who, content=b"").status_code == 403
    for do in ("warm", "act", "nothing"):
        assert client.post(f"/api/do/{do}", headers=enter(client), json={}).status_code == 404
    answer = client.post("/api/do/command", headers=enter(client), json={"what": "batch"})
    assert answer.status_code == 404


def test_bodies_that_are_not_objects_are_rejected(client: TestClient) -> None:
    who = enter(client)
    for body in (b"[]", b"{", b"[" * 4000, b"\xff"):
        answer = client.post(
            "/api/do/sketched", headers=who | {"content-type": "application/json"}, content=body
        )
        assert answer.status_code == 400


def test_a_served_studio_has_no_file_of_the_machine(client: TestClient) -> None:
    assert client.get("/api/file/ex3.toml", headers=enter(client)).status_code == 404


def test_names_of_files_are_plain(client: TestClient) -> None:
    told = {
        "../../x": "x",
        "/etc/passwd": "passwd",
        "--out": "out",
        "": "problem",
        "Иванов 1": "Иванов-1",
    }
    for typed, plain in told.items():
        answer = client.post(
            "/api/do/sketched", headers=enter(client), json={"text": "x", "name": typed}
        )
        assert json.loads(answer.text.splitlines()[-1])["found"]["name"] == plain


# Sessions ----------------------------------------------------------------------------------------


def test_sessions_end_and_leave_no_files(tmp_path: Path) -> None:
    now = [0.0]
    sessions = Sessions(tmp_path, replace(LIMITS, idle=100.0), clock=lambda: now[0])
    first, second = sessions.enter("a", trusted=False), sessions.enter("a", trusted=False)
    assert first is not None
    assert second is not None
    assert first.folder != second.folder
    assert first.key not in str(first.folder)
    (first.folder / "1").mkdir()
    now[0] = 90.0
    assert sessions.of(second.key) is second
    now[0] = 120.0
    sessions.clean()
    assert sessions.of(first.key) is None
    assert [path.name for path in tmp_path.iterdir()] == [second.folder.name]
    assert LOCAL_LIMITS.idle < 7 * 24 * 3600  # also on one's own machine


def test_for_one_session_more_than_there_may_be_the_oldest_idle_one_ends(tmp_path: Path) -> None:
    now = [0.0]
    limits = replace(LIMITS, sessions=3, entries=1000.0)
    sessions = Sessions(tmp_path, limits, clock=lambda: now[0])

    def let(trusted: bool = False, busy: tuple[str, ...] = ()) -> StudioSession | None:
        now[0] += 1
        return sessions.enter("a", trusted=trusted, is_busy=lambda key: key in busy)

    owner, first, second = let(True), let(), let()
    assert owner is not None
    assert first is not None
    assert second is not None
    third = let(busy=(first.key,))
    assert third is not None
    there = [sessions.of(one.key) is one for one in (owner, first, second, third)]
    assert there == [True, True, False, True]  # not the owner's, not one that waits for an answer
    assert let(busy=(first.key, third.key)) is None
    assert len({path.name for path in tmp_path.iterdir()}) == 3
    for _ in range(200):
        assert let(True) is not None  # the owner is let in however many are there
    assert len(sessions) <= 4


def test_of_idle_sessions_the_one_that_was_used_least_lately_ends(tmp_path: Path) -> None:
    now = [0.0]
    limits = replace(LIMITS, sessions=3, entries=1000.0)
    sessions = Sessions(tmp_path, limits, clock=lambda: now[0])
    there: list[StudioSession] = []
    for _ in range(3):
        now[0] += 1
        one = sessions.enter("a", trusted=False)
        assert one is not None
        there.append(one)
    now[0] += 1
    assert sessions.of(there[0].key) is there[0]  # its page asks for something
    assert sessions.enter("a", trusted=False) is not None
    assert [sessions.of(one.key) is one for one in there] == [True, False, True]


def test_old_computations_go(tmp_path: Path) -> None:
    session = Sessions(tmp_path, LIMITS).enter("a", trusted=False)
    assert session is not None
    for _ in range(7):
        session.new_folder(LIMITS.stored_results)
    assert sorted(path.name for path in session.folder.iterdir()) == ["5", "6", "7", "works"]


def test_one_address_enters_no_more_than_a_class_does(tmp_path: Path) -> None:
    limits = replace(LIMITS, sessions=1000, entries=1.0, entered=5.0)
    now = [0.0]
    sessions = Sessions(tmp_path, limits, clock=lambda: now[0])
    let = [sessions.enter("a", trusted=False) is not None for _ in range(8)]
    assert let == [True] * 5 + [False] * 3
    assert sessions.enter("b", trusted=False) is not None
    now[0] = 2.5
    assert [sessions.enter("a", trusted=False) is not None for _ in range(3)] == [True, True, False]


def test_a_bucket_leaks() -> None:
    bucket = Bucket()
    taken = [bucket.admit(k * 0.1, rate=2.0, burst=3.0) for k in range(30)]
    assert all(taken[:3])
    assert 3 + 2 * 2.9 - 1 <= sum(taken) <= 3 + 2 * 2.9 + 1


# One's own file ----------------------------------------------------------------------------------


def test_a_file_changed_by_another_editor_is_not_overwritten(tmp_path: Path) -> None:
    path = tmp_path / "my.toml"
    path.write_text("a = 1\n")
    settings = StudioSettings(limits=LIMITS, token=TOKEN, processes=1, desk=Desk(path))
    with visiting(settings, odd_acts.act, tmp_path / "sessions") as client:
        who = enter(client)
        there = client.get("/api/file/my.toml", headers=who).json()
        assert there["text"] == "a = 1\n"
        saved = client.post(
            "/api/file/my.toml", headers=who, json={"text": "a = 2\n", "mark": there["mark"]}
        )
        assert path.read_text() == "a = 2\n"
        assert client.get("/api/file/my.toml?mark", headers=who).json() == saved.json()
        path.write_text("a = 3\n")  # an editor outside
        refused = client.post(
            "/api/file/my.toml", headers=who, json={"text": "a = 4\n", "mark": saved.json()["mark"]}
        )
        assert refused.status_code == 409
        assert refused.json()["text"] == path.read_text() == "a = 3\n"
        again = {"text": "a = 4\n", "mark": refused.json()["mark"]}
        assert client.post("/api/file/my.toml", headers=who, json=again).status_code == 200
        assert path.read_text() == "a = 4\n"
        for other in ("other.toml", "..%2fmy.toml", "my.txt", ".toml"):
            assert client.get(f"/api/file/{other}", headers=who).status_code == 404


def test_a_folder_shows_its_problem_files_alone(tmp_path: Path) -> None:
    for name in ("b.toml", "a.toml", "c.txt"):
        (tmp_path / name).write_text("")
    (tmp_path / "d.toml").mkdir()
    desk = Desk(tmp_path)
    assert desk.names == ["a.toml", "b.toml"]
    assert desk.at("a.toml") == tmp_path / "a.toml"
    assert [
        desk.at(name) for name in ("../a.toml", ".a.toml", "c.txt", "x/a.toml", "a\0.toml")
    ] == [None] * 5


@pytest.mark.parametrize("folder", ["docs", "docs/ru"])
def test_the_page_on_serving_has_the_limits(folder: str) -> None:
    page = (ROOT / folder / "how-to" / "serve-a-studio.md").read_text("utf-8")
    rows = [line for line in page.splitlines() if line.startswith("| ")][2:]
    words = {"two": "2", "one": "1", "два": "2", "один": "1"}
    numbers = [
        [int(words.get(word, word)) for word in re.findall(r"\d+|" + "|".join(words), row)]
        for row in rows
    ]
    limits = PUBLIC_LIMITS
    assert limits.slow_seconds == limits.trusted_seconds
    assert limits.memory is not None
    assert numbers == [
        [limits.seconds, limits.memory // MB, limits.slow_seconds],
        [limits.upload // MB, limits.uploads // MB, limits.works],
        [limits.burst, limits.rate, limits.session_waiting, limits.waiting],
        [limits.entered, limits.entries],
        [limits.sessions, limits.idle / 3600],
    ]
