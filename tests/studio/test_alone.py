"""The studio without a server: the same answers, a folder that is whole, and Python in Chromium."""

from __future__ import annotations

import contextlib
import functools
import gc
import http.server
import json
import os
import re
import subprocess
import sys
import threading
import tomllib
import zipfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from browser import PROGRAM, Page, browsing
from click.testing import CliRunner
from doors import (
    CORE,
    LOADED,
    OFFICIAL,
    PACKED,
    SHIPPED,
    VERSION,
    WORKS,
    OutputError,
    Runtime,
    act,
    cli,
    runtime_of,
    start_studio,
    write_studio,
)
from worked import PROBLEMS, ROOT

EX3 = PROBLEMS / "linkages/ex3.toml"
PYODIDE = os.environ.get("PLANMETHOD_PYODIDE")
"""Folder of a Pyodide runtime with its libraries, if there is one."""


def silent(_: object) -> None:
    """Do not report progress."""


def written(folder: Path, runtime: Runtime) -> Path:
    """Write the page with one picture for all tasks: drawing them takes longer than the rest."""
    one = '<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"/>'
    layouts = tuple(SHIPPED)
    write_studio(folder, runtime, layouts, lambda file: one, lang="ru", done=silent)
    return folder


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The page of a runtime that is nowhere."""
    return written(tmp_path_factory.mktemp("alone") / "site", Runtime("nowhere/", "nowhere/"))


def answered(do: str, lang: str = "ru", **more: Any) -> tuple[Any, dict[str, Any]]:
    alone = start_studio(act)
    told = {"text": EX3.read_text("utf-8"), "name": "ex3", **more}
    body = json.dumps(told).encode()
    status, data = alone.answer("POST", f"api/do/{do}?lang={lang}", body, silent)
    assert status == 200
    found: dict[str, Any] = json.loads(data)["found"]
    return alone, found


# The same answers --------------------------------------------------------------------------------


def test_its_answers_are_those_of_the_server(tmp_path: Path) -> None:
    pytest.importorskip("starlette", reason="the studio's extra is not installed")
    pytest.importorskip("httpx2", reason="starlette's test client needs httpx2")
    from doors import StudioOptions, settings_of
    from visiting import enter, visiting

    alone = start_studio(act)
    with visiting(settings_of(StudioOptions(jobs=2)), act, tmp_path / "s") as client:
        client.headers |= enter(client)
        for address in (
            "api/tasks?search=кулис", "api/schema?lang=ru", "api/schema?lang=en",
            "api/start/linkages-ex3", "api/start/levers-13?variant=2", "api/start/nothing",
        ):  # fmt: skip
            one, other = client.get(address), alone.answer("GET", address, b"", silent)
            assert one.status_code == other[0], address
            assert other[0] == 404 or one.json() == json.loads(other[1]), address
        asked = {"text": EX3.read_text("utf-8"), "name": "ex3", "what": "tables"}
        for do in ("command", "sketched", "questions", "sheets"):
            lines = client.post(f"/api/do/{do}?lang=ru", json=asked).text.splitlines()
            mine = alone.answer("POST", f"api/do/{do}?lang=ru", json.dumps(asked).encode(), silent)
            one, other = json.loads(lines[-1])["found"], json.loads(mine[1])["found"]
            assert one.pop("files_at") != other.pop("files_at")
            assert one == other, do


def test_made_files_are_served_and_no_others() -> None:
    alone, found = answered("command", what="svg")
    (made,) = found["files"]
    status, data = alone.answer("GET", f"{found['files_at']}{made['name']}?download", b"", silent)
    assert (status, len(data)) == (200, made["bytes"])
    status, data = alone.answer("GET", f"{found['files_at']}all.zip", b"", silent)
    assert data[:2] == b"PK"
    for name in ("../ex3.toml", "%2e%2e/ex3.toml", "none.svg"):
        assert alone.answer("GET", f"{found['files_at']}{name}", b"", silent)[0] == 404
    assert alone.answer("POST", "api/do/pictured", b"{}", silent)[0] == 404
    assert alone.answer("POST", "api/do/command", b'{"what": "bench"}', silent)[0] == 404


def test_works_are_accepted_checked_and_deleted() -> None:
    alone = start_studio(act)
    text = "student;id;value;unit\nИванов;v_B;3.2;м/с\nПетров;v_B;3.0;м/с\n".encode()
    assert alone.answer("PUT", "api/works/a.csv?lang=ru", text, silent)[1] == b'["a.csv"]\n'
    status, said = alone.answer("PUT", "api/works/a.exe?lang=en", text, silent)
    assert (status, ".csv" in said.decode()) == (415, True)
    told = json.dumps({"text": EX3.read_text("utf-8"), "name": "ex3", "by_hand": []}).encode()
    found = json.loads(alone.answer("POST", "api/do/checked?lang=ru", told, silent)[1])["found"]
    assert [row[0] for row in found["marks"][1:]] == ["Иванов", "Петров"]
    assert alone.answer("DELETE", "api/works/all", b"", silent)[1] == b"[]\n"
    assert not [*alone.session.works.iterdir()]


def test_its_folder_goes_with_it() -> None:
    alone, found = answered("command", what="svg")
    folder = alone.session.folder
    assert [*folder.rglob(found["files"][0]["name"])]
    del alone
    gc.collect()
    assert not folder.exists()


def test_a_request_beyond_the_memory_is_reported() -> None:
    def spent(asked: object, tell: object) -> dict[str, Any]:
        raise MemoryError

    _, data = start_studio(spent).answer("POST", "api/do/sketched?lang=en", b"{}", silent)
    assert "memory" in json.loads(data)["found"]["refused"]


# The folder --------------------------------------------------------------------------------------


def test_the_pages_state_their_policy_and_contact_no_other_host(folder: Path) -> None:
    for name, lang in (("index.html", "ru"), ("en.html", "en")):
        text = (folder / name).read_text("utf-8")
        (policy,) = re.findall(r'Content-Security-Policy" content="([^"]+)"', text)
        assert policy.startswith("default-src 'none'")
        assert "http" not in policy
        assert "'unsafe-eval'" not in policy
        assert f'<html lang="{lang}">' in text
        assert not re.search(r'(?:href|src)="/', text), "it may lie below other pages"
    told = re.findall(r'id="data">(.*?)</script>', text, re.DOTALL)[0]
    assert json.loads(told)["works"] == [*WORKS]
    assert json.loads(told)["pages"] == {"ru": "index.html", "en": "en.html"}
    assert json.loads((folder / "tasks-ru.json").read_text("utf-8"))[0]["name"]
    transport = (folder / "static/transport.js").read_text("utf-8")
    assert transport == (ROOT / "planmethod/studio/page/alone.js").read_text("utf-8")


def test_the_policy_admits_the_runtime_and_no_other_source(tmp_path: Path) -> None:
    address = OFFICIAL.format(VERSION)
    text = (written(tmp_path / "s", runtime_of(None)) / "index.html").read_text("utf-8")
    (policy,) = re.findall(r'Content-Security-Policy" content="([^"]+)"', text)
    assert {*re.findall(r"https?://[^ ;]+", policy)} == {address}


def test_every_library_is_packed_or_in_the_index_of_the_runtime() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    extras = project["optional-dependencies"]
    asked = [*project["dependencies"], *extras["dxf"], *extras["referee"]]
    assert {re.split(r"[<>=]", one)[0] for one in asked} <= {*LOADED, *PACKED}


def test_the_archive_is_the_project_with_its_tasks(folder: Path, tmp_path: Path) -> None:
    with zipfile.ZipFile(folder / "planmethod.zip") as book:
        names = {*book.namelist()}
        assert not [name for name in names if name.endswith((".so", ".pyc", ".pyd"))]
        book.extractall(tmp_path)
    assert {"planmethod/problems/linkages/ex3.toml", "click/core.py", "docx/api.py"} <= names
    code = "import planmethod.problem.tasks as t; print(t.home(), len(t.tasks()))"
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=True,
        env={**os.environ, "PYTHONPATH": str(tmp_path)},
    )  # fmt: skip
    assert done.stdout.split()[0] == str(tmp_path / "planmethod/problems")


def test_the_runtime_is_copied_from_a_folder(tmp_path: Path) -> None:
    core = tmp_path / "core"
    core.mkdir()
    with pytest.raises(LookupError, match=r"pyodide\.mjs"):
        runtime_of(str(core))
    for name in CORE:
        (core / name).write_bytes(b"")
    packages = {
        name: {"name": name, "file_name": f"{name}.whl", "depends": ["six"] * (name == "lxml")}
        for name in (*LOADED, "six")
    }
    (core / "pyodide-lock.json").write_text(json.dumps({"packages": packages}))
    (core / "package.json").write_text('{"version": "9.8.7"}')
    found = runtime_of(str(core))
    assert (found.core, found.hosts) == ("pyodide/", (OFFICIAL.format("9.8.7"),))
    for name in (*LOADED, "six"):
        (core / f"{name}.whl").write_bytes(b"")
    found = runtime_of(str(core))
    assert found.hosts == ()
    assert {"six.whl", "numpy.whl", "pyodide.asm.wasm"} <= {*found.copied}
    site = written(tmp_path / "site", found)
    assert {path.name for path in (site / "pyodide").iterdir()} == {*found.copied}


def test_a_folder_with_other_files_is_left_alone_and_an_own_one_is_rewritten(
    folder: Path, tmp_path: Path
) -> None:
    before = (folder / "planmethod.zip").read_bytes()
    written(folder, Runtime("nowhere/", "nowhere/"))
    assert (folder / "planmethod.zip").read_bytes() == before
    (tmp_path / "mine.txt").write_text("mine")
    for where in (tmp_path, tmp_path / "mine.txt"):
        with pytest.raises(OutputError):
            written(where, Runtime("nowhere/", "nowhere/"))


@pytest.mark.parametrize(
    ("args", "said"),
    [
        (("--static", "new", "--open"), "only --pyodide may go with it"),
        (("--static", "new", "--serve"), "only --pyodide may go with it"),
        (("--pyodide", "."), "requires --static"),
        (("--static", "new", "--pyodide", "."), "pyodide.mjs"),
    ],
)
def test_incompatible_options_are_reported(
    args: tuple[str, ...], said: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    done = CliRunner().invoke(cli, ["studio", "--lang", "en", *args])
    assert (done.exit_code, said in done.output) == (2, True), done.output


# In Chromium -------------------------------------------------------------------------------------


class Files(http.server.SimpleHTTPRequestHandler):
    """A host of files."""

    extensions_map = http.server.SimpleHTTPRequestHandler.extensions_map | {
        ".js": "text/javascript", ".mjs": "text/javascript", ".wasm": "application/wasm",
    }  # fmt: skip

    def log_message(self, *args: object) -> None:
        """Keep quiet."""


@contextlib.contextmanager
def hosted(folder: Path) -> Iterator[str]:
    """Serve files from below a path, as such hosts do; the address."""
    host = functools.partial(Files, directory=str(folder.parent))
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), host) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}/{folder.name}/"
        server.shutdown()


chromium = pytest.mark.skipif(PROGRAM is None, reason="Chromium looks at the page")


@chromium
def test_without_its_runtime_the_page_reports_it_and_shows_the_tasks(
    folder: Path, tmp_path: Path
) -> None:
    with hosted(folder) as address, browsing(tmp_path) as page:
        page.open(f"{address}en.html")
        page.wait("document.querySelectorAll('#tasks li').length > 3")
        page.wait("document.querySelector('#said').textContent.includes('has not loaded')")
        assert "nowhere/pyodide.mjs" in page.ask("document.querySelector('#said').textContent")
        assert page.ask("document.querySelectorAll('#said-do button').length") == 1
        page.ask("studio.put('title = 1')")
        page.wait("document.querySelector('#said').textContent.includes('has not loaded')")
        page.ask("document.querySelector('#lang').value = 'ru'")
        page.leave("document.querySelector('#lang').dispatchEvent(new Event('change'))")
        assert page.ask("document.documentElement.lang") == "ru"
        assert page.ask("location.pathname").endswith("index.html")
        assert not [said for said in page.said if "Security Policy" in said]


def of_command(*args: str) -> str:
    done = CliRunner().invoke(cli, [*args, str(EX3)], catch_exceptions=False)
    return done.stdout


def drawn(page: Page) -> None:
    page.wait(
        "document.querySelector('#sketch').naturalWidth > 0 &&"
        " !document.querySelector('#scheme').classList.contains('old')"
    )


@chromium
@pytest.mark.skipif(not PYODIDE, reason="PLANMETHOD_PYODIDE names no folder of a runtime")
def test_python_in_the_browser_does_the_work_of_the_commands(tmp_path: Path) -> None:
    site = written(tmp_path / "site", runtime_of(PYODIDE))
    with hosted(site) as address, browsing(tmp_path / "browser") as page:
        page.open(f"{address}#task=linkages-ex3", width=1360)
        drawn(page)
        for view, command in (
            ("tables", ("solve", "--lang", "ru")),
            ("protocol", ("protocol", "--lang", "ru")),
            ("structure", ("structure", "--no-drawing", "--lang", "ru")),
        ):
            page.ask(f"document.querySelector('#to-{view}').click()")
            said = page.wait(f"document.querySelector('#{view} pre').textContent")
            assert said.splitlines()[1:] == of_command(*command).splitlines()[1:], view
        page.ask("document.querySelector('#to-motion').click()")
        page.wait("document.querySelector('#motion iframe')?.src.endsWith('frame.html')")
        page.ask("document.querySelector('#to-sheets').click()")
        page.wait("document.querySelector('#sheet img')?.naturalWidth")
        page.ask("studio.put(studio.text().replace('AB = ', 'AV = '))")
        page.wait("document.querySelector('#faults button')")
        page.ask("studio.put(studio.text().replace('AV = ', 'AB = '))")
        page.wait("document.querySelector('#faults .good')")
        page.ask("document.querySelector('#to-answers').click()")
        page.ask("document.querySelector('#ask').click()")
        page.wait("document.querySelectorAll('#rows tr').length > 3")
        page.ask(
            "{ const field = document.querySelector('#rows tr input[aria-label]');"
            " field.value = '3.2'; field.dispatchEvent(new Event('input'));"
            " document.querySelector('#judge').click(); }"
        )
        assert "Проверка работы" in page.wait("document.querySelector('#verdicts iframe')?.srcdoc")
        assert not [said for said in page.said if "Security Policy" in said]
