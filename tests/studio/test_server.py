"""The studio does the work of the commands, by the same code; faults are shown at their place."""

from __future__ import annotations

import json
import re
import tomllib
from collections.abc import Iterator
from html import escape
from pathlib import Path
from typing import Any

import pytest
from cases import each
from click.testing import CliRunner
from visiting import enter, visiting
from worked import PROBLEMS, ROOT

pytest.importorskip("starlette", reason="the studio's extra is not installed")
pytest.importorskip("httpx2", reason="starlette's test client needs httpx2")

from doors import (
    LACKING,
    Fault,
    ProblemError,
    StudioOptions,
    act,
    cli,
    get_language,
    kind_of,
    place_of,
    settings_of,
    tasks,
)
from starlette.testclient import TestClient

EX3 = (PROBLEMS / "linkages/ex3.toml").read_text("utf-8")
FAULTY = sorted((ROOT / "tests/problem/faulty").glob("*.toml"))


@pytest.fixture(scope="module")
def client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    settings = settings_of(StudioOptions(jobs=2))
    root = tmp_path_factory.mktemp("studio") / "sessions"
    with visiting(settings, act, root) as client:
        client.headers |= enter(client)
        yield client


def do(client: TestClient, do: str, text: str, lang: str = "ru", **more: Any) -> dict[str, Any]:
    told = {"text": text, "name": "ex3", **more}
    answer = client.post(f"/api/do/{do}?lang={lang}", json=told)
    assert answer.status_code == 200, answer.text
    found: dict[str, Any] = json.loads(answer.text.splitlines()[-1])["found"]
    return found


def run(folder: Path, *args: str) -> str:
    done = CliRunner(env={"PLANMETHOD_LANG": "ru"}).invoke(cli, args, catch_exceptions=False)
    assert done.exit_code in (0, 1), done.output
    return done.stdout


# The page ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("lang", ["ru", "en"])
def test_the_page_is_in_a_language_and_admits_no_other_sources(
    client: TestClient, lang: str
) -> None:
    answer = client.get(f"/?lang={lang}")
    words = get_language(lang).studio["page"]
    policy = answer.headers["content-security-policy"]
    assert "default-src 'none'" in policy
    assert "unsafe" not in policy
    assert f'<html lang="{lang}">' in answer.text
    assert words["bank"] in answer.text
    assert not re.search(r"\{\{|\[\[", answer.text)
    inline = r"<script(?! type=\"module\" src| type=\"application/json\")|\son\w+=|style="
    assert not re.search(inline, answer.text)


def test_every_word_of_the_page_is_used_and_every_word_it_uses_is_there() -> None:
    folder = ROOT / "planmethod/studio/page"
    scripts = "".join(
        path.read_text("utf-8") for path in folder.glob("*.js") if path.stem != "codemirror"
    )
    html = (folder / "studio.html").read_text("utf-8")
    ids = re.findall(r' id="([^"{]+)"', html)
    assert len(ids) > 50 and len(ids) == len({*ids})  # the script would take the first one
    used = {*re.findall(r"\{\{(\w+)\}\}", html), *re.findall(r"\bW\.(\w+)", scripts)}
    used |= {*re.findall(r'(?:say\(|tell\(|failed: |why = )"(\w+)"', scripts)}
    used |= {*re.findall(r"\b(chip_\w+):", scripts)}  # W[chip]
    known = {*get_language("ru").studio["page"]}
    for start in re.findall(r"\bW\[`(\w+)\$\{", scripts):  # W[`start${end}`]
        used |= {word for word in known if word.startswith(start)}
    assert (used - known, known - used) == (set(), set())


def test_the_scripts_contact_no_other_host_and_turn_no_text_into_markup_or_code() -> None:
    for path in (ROOT / "planmethod/studio/page").glob("*.*"):
        text = path.read_text("utf-8")
        if path.name.startswith("codemirror"):
            continue
        if path.name == "frame.html":  # it writes a page into itself, apart from all else
            assert "default-src 'none'" in text
            continue
        assert not re.search(r"https?://(?!www\.w3\.org/2000/svg)", text), path
        assert not re.search(r"innerHTML|outerHTML|insertAdjacent|document\.write|\beval\b", text)


def test_the_bundle_names_its_licences(client: TestClient) -> None:
    told = client.get("/static/codemirror-licences.txt").text
    locked = json.loads((ROOT / "scripts/editor/package-lock.json").read_text("utf-8"))
    asked = locked["packages"][""]["dependencies"]
    for name, version in asked.items():
        assert f"{name} {version}" in told
    assert told.count("Permission is hereby granted") >= len(asked)


@pytest.mark.parametrize(
    "address",
    ["/", "/api/tasks", "/api/schema", "/api/start/linkages-ex3", "/static/codemirror.js",
     "/picture/linkages-ex3.svg"],
)  # fmt: skip
def test_text_is_compressed_and_comes_once(client: TestClient, address: str) -> None:
    plain = client.get(address, headers={"accept-encoding": "identity"})
    packed = client.get(address, headers={"accept-encoding": "gzip"})
    assert "content-encoding" not in plain.headers
    assert packed.headers["content-encoding"] == "gzip"
    assert "accept-encoding" in packed.headers["vary"].lower()
    assert int(packed.headers["content-length"]) < len(plain.content) / 2
    if address == "/":  # its nonce is new each time
        assert packed.headers["cache-control"] == "no-store"
        return
    assert packed.content == plain.content
    again = client.get(address, headers={"if-none-match": packed.headers["etag"]})
    assert (again.status_code, again.content) == (304, b"")


def test_scripts_and_style_are_kept_for_ever_at_an_address_of_their_version(
    client: TestClient,
) -> None:
    found = re.findall(r'(?:src|href)="(static/\w{16}/[\w.]+)"', client.get("/").text)
    assert [one.rpartition("/")[2] for one in found] == ["studio.css", "studio.js"]
    for address in (*found, found[1].replace("studio.js", "codemirror.js")):
        answer = client.get(f"/{address}")
        assert answer.headers["cache-control"] == "public, max-age=31536000, immutable"
    assert client.get(f"/{found[0].replace('static/', 'static/0')}").status_code == 404
    assert client.get("/static/studio.js").headers["cache-control"] == "no-cache"


# The same code -----------------------------------------------------------------------------------


def test_the_scheme_is_that_of_the_command(client: TestClient, tmp_path: Path) -> None:
    (tmp_path / "ex3.toml").write_text(EX3, "utf-8")
    run(tmp_path, "sketch", str(tmp_path / "ex3.toml"), "-o", str(tmp_path))
    found = do(client, "sketched", EX3)
    assert found["faults"] == []
    assert found["svg"] == (tmp_path / "ex3-sketch.svg").read_text("utf-8")


def test_a_scheme_has_the_language_of_the_page(client: TestClient) -> None:
    text = client.get("/api/start/moving-point?lang=en").json()["text"]
    found = do(client, "sketched", f"{text}\n[sheet]\nlang = 'ru'\n", "en")
    assert "</svg>" in found["svg"]  # its sheet, which is full of words
    assert not re.search("[а-яё]{3}", found["svg"])


def test_results_that_a_kind_of_problem_does_not_have_are_named_in_a_sentence(
    client: TestClient,
) -> None:
    acts = ("assemblies", "questions", "verdicts", "checked")
    alike = ("project", "assemblies")
    answers = ("form", "key", "questions", "verdicts", "checked")
    for name, lacks, has in (
        ("cam", ("structure", *alike), "live"),
        ("planetary-train", alike, "structure"),
        ("meshing", ("structure", *alike, *answers), "tables"),
        ("moving-point", ("structure", *alike), "questions"),
    ):
        text = client.get(f"/api/start/{name}?lang=en").json()["text"]
        for what in (*lacks, has):
            asked = {"what": what} if what not in acts else {}
            found = do(client, what if what in acts else "command", text, "en", **asked)
            said = [fault["message"] for fault in found.get("faults", ())]
            assert said == ([] if what == has else [LACKING[what][1]]), (name, what)
            assert found.get("code", 0) == 0


@pytest.mark.usefixtures("russian")
def test_sheets_and_tables_are_those_of_the_commands(client: TestClient, tmp_path: Path) -> None:
    path = tmp_path / "ex3.toml"
    path.write_text(EX3, "utf-8")
    run(tmp_path, "sheet", str(path), "--format", "svg,pdf", "-o", str(tmp_path / "out"))
    (page,) = do(client, "sheets", EX3)["pages"]
    assert page["svg"] == (tmp_path / "out/ex3.svg").read_text("utf-8")
    made = do(client, "command", EX3, what="pdf")
    assert [one["name"] for one in made["files"]] == ["ex3.pdf"]
    data = client.get(made["files_at"] + "ex3.pdf").content
    assert data == (tmp_path / "out/ex3.pdf").read_bytes()
    tables = do(client, "command", EX3, what="tables")
    assert tables["output"] == run(tmp_path, "solve", "--lang", "ru", str(path))


def test_an_english_page_gets_english_sheets_of_a_russian_file(client: TestClient) -> None:
    text = EX3.replace("[sheet]\n", '[sheet]\nlang = "ru"\n')
    (page,) = do(client, "sheets", text, lang="en")["pages"]
    drawn = {lang: do(client, "sheets", EX3, lang=lang)["pages"][0]["svg"] for lang in ("en", "ru")}
    assert page["svg"] == drawn["en"] != drawn["ru"]
    made = {
        lang: do(client, "command", text, lang=lang, what="svg")["files_at"] + "ex3.svg"
        for lang in ("en", "ru")
    }
    assert {lang: client.get(at).text for lang, at in made.items()} == drawn


def test_the_ruler_knows_the_segments_of_the_plans(client: TestClient) -> None:
    (page,) = do(client, "sheets", EX3)["pages"]
    view = next(view for view in page["views"] if view["kind"] == "velocity")
    assert (view["per_mm"], view["unit"], view["scale"]) == (0.05, "м/с", "μ_v")
    span = next(span for span in view["spans"] if span["name"].startswith("pb"))
    x, y, z, t = span["ends"]
    assert abs(complex(z - x, t - y)) * view["per_mm"] == pytest.approx(3.2, abs=1e-9)


def test_a_project_reports_its_progress_and_is_one_archive(client: TestClient) -> None:
    told = {"text": EX3, "name": "ex3", "what": "project"}
    lines = client.post("/api/do/command?lang=ru", json=told).text.splitlines()
    shares = [one["share"] for one in map(json.loads, lines) if "share" in one]
    assert shares == sorted(shares)
    assert {0.2, 0.4, 0.6, 0.8, 1.0} <= {*shares}
    found = json.loads(lines[-1])["found"]
    assert "planmethod  [" not in found["errors"]
    assert {"ex3/note.docx", "ex3/project.pdf"} <= {one["name"] for one in found["files"]}
    whole = client.get(found["files_at"] + "all.zip")
    assert whole.content[:2] == b"PK"


def test_a_picture_of_the_bank_has_the_language_of_the_page(client: TestClient) -> None:
    drawn = {lang: client.get(f"/picture/cams-flat.svg?lang={lang}").text for lang in ("ru", "en")}
    assert drawn["ru"] != drawn["en"]


@each("task", [*{task.kind: task for task in tasks()}.values()])
def test_every_kind_of_task_is_drawn(client: TestClient, task: Any) -> None:
    for lang in ("ru", "en"):
        drawn = client.get(f"/picture/{task.name}.svg?lang={lang}").text
        assert drawn.startswith("<?xml")
        assert client.get(f"/picture/{task.name}.svg?lang={lang}").text == drawn
    found = do(client, "sketched", client.get(f"/api/start/{task.name}").json()["text"])
    assert found["faults"] == []
    assert found["svg"].startswith("<?xml")


def test_both_assemblies_are_offered(client: TestClient) -> None:
    ways = do(client, "assemblies", EX3)["ways"]
    assert [way["rules"] for way in ways] == [{"E": "right of D"}, {"E": "left of D"}]
    assert ways[0]["svg"] != ways[1]["svg"]
    bare = EX3.replace('[assembly]\nE = "right of D"\n', "")
    assert do(client, "sketched", bare)["ways"] == 2


# Faults at their place ---------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("old", "new"),  # the place of the fault: after the mark
    [
        ("DE = 0.18", "DE = 0.18 ‸m"),
        ('on = "3"', '‸on = "7"'),
        ("omega = 50", "omega = ‸fast"),
        ('E = "right of D"', '‸E = "beside D"'),
        ("mu_v = 0.05", "‸mu_v = -1"),
        ('[[answers]]\nwhat = "v B3"', '[[answers]]\n‸what = "v Q3"'),
        ('\n[driver]\nlink = "1"', '\n[driver]\n‸link = "9"'),
        ("epsilon = 0", "‸epsilom = 0"),
    ],
)
def test_a_fault_is_shown_at_its_place(client: TestClient, old: str, new: str) -> None:
    assert EX3.count(old) == 1
    above = EX3.replace(old, new).partition("‸")[0].split("\n")
    for lang in ("ru", "en"):
        faults = do(client, "sketched", EX3.replace(old, new.replace("‸", "")), lang)["faults"]
        place = faults[0]["line"], faults[0]["column"]
        assert place == (len(above), len(above[-1]) + 1), faults
        assert bool(re.search("[а-яё]{3}", faults[0]["message"])) == (lang == "ru")
    assert do(client, "sketched", EX3)["faults"] == []


def faults_of(path: Path) -> list[Fault]:
    try:
        kind_of(path).load(path, None)
    except ProblemError as error:
        return [*error.faults]
    return []


def test_most_faults_of_faulty_files_are_placed_at_a_key_of_their_path() -> None:
    placed, all_of_them = 0, 0
    for path in FAULTY:
        text = path.read_bytes().decode("utf-8", "replace")
        lines = text.split("\n")
        for fault in faults_of(path):
            all_of_them += 1
            where = place_of(text, fault)
            if where is None:
                continue
            line, _ = where
            assert 1 <= line <= len(lines)
            placed += 1
            if fault.path and " " not in fault.path:
                parts = [part for part in re.split(r"[.\[\]\"]+", fault.path) if part]
                assert any(part in lines[line - 1] for part in parts) or "[[" in lines[line - 1]
    assert placed > 0.8 * all_of_them


def test_an_array_is_counted_from_zero() -> None:
    text = '[[answers]]\nwhat = "a"\n\n[[answers]]\nwhat = "b"\n[answers.inner]\nc = 1\n'
    assert place_of(text, Fault("answers.1.what", "m")) == (5, 1)
    assert place_of(text, Fault("answers[1]", "m")) == (4, 1)
    assert place_of(text, Fault("answers.1.inner.c", "m")) == (7, 1)
    assert place_of(text, Fault("driver.phi", "m")) is None


# Answers and works -------------------------------------------------------------------------------


def test_the_form_has_questions_and_no_answers(client: TestClient) -> None:
    found = do(client, "questions", EX3)
    first = found["rows"][0]
    assert (first["id"], first["unit"], first["scale"], first["mm"]) == ("v_B", "м/с", "mu_v", True)
    assert first["units"]["мм/с"] == 0.001
    assert "3.2" not in json.dumps(found["rows"])
    assert [*found["scales"]] == ["mu_v", "mu_a"]


def test_a_work_is_judged_with_reasons(client: TestClient) -> None:
    work = {"student": "Я", "answers": [{"id": "v_B", "value": "3,2"}, {"id": "v_E", "value": "2"}]}
    found = do(client, "verdicts", EX3, work=work)
    page = next(one["name"] for one in found["files"] if one["name"].endswith(".html"))
    answer = client.get(found["files_at"] + page)
    assert "sandbox" in answer.headers["content-security-policy"]
    assert "allow-scripts" not in answer.headers["content-security-policy"]
    assert re.search('class="[^"]*wrong', answer.text)
    assert re.search('class="[^"]*ok', answer.text)


GROUP = "student;what;value;unit\nИванов;v B;3,2;м/с\nИванов;v E;3,9;м/с\nПетров;v B;3,3;м/с\n"


def test_marks_are_those_of_the_command_and_change_by_hand(
    client: TestClient, tmp_path: Path
) -> None:
    (tmp_path / "ex3.toml").write_text(EX3, "utf-8")
    (tmp_path / "group.csv").write_text(GROUP, "utf-8")
    files = [str(tmp_path / name) for name in ("ex3.toml", "group.csv")]
    run(tmp_path, "check", *files, "--gradebook", "--lang", "ru", "-o", str(tmp_path / "out"))
    assert client.put("/api/works/group.csv", content=GROUP.encode()).json() == ["group.csv"]
    found = do(client, "checked", EX3, by_hand=[])
    text = (tmp_path / "out/gradebook.csv").read_text("utf-8-sig")
    assert [";".join(row) for row in found["marks"]] == text.splitlines() or [
        ",".join(row) for row in found["marks"]
    ] == text.splitlines()
    by_hand = [{"student": "Петров", "id": "v_B", "points": "0,5", "remark": "=1+1"}]
    again = do(client, "checked", EX3, by_hand=by_hand)
    rows = {(row[0], row[2]): row for row in again["answers"]}
    before = {(row[0], row[2]): row for row in found["answers"]}
    points = again["answers"][0].index("points")
    assert rows["Петров", "v_B"][points] == "0.5" != before["Петров", "v_B"][points]
    assert rows["Иванов", "v_B"] == before["Иванов", "v_B"]
    assert client.delete("/api/works/all").json() == []


def test_a_file_that_cannot_be_read_stops_no_other_and_names_have_their_pages(
    client: TestClient,
) -> None:
    """Before: no grades at all, and no page for a student whose name has a full stop."""
    names = ["Петров П.П.", "=1+1", "a-b", "a b"]
    rows = "".join(f"{name};v B;3,2;м/с\n" for name in names)
    works = {
        "good.csv": f"student;what;value;unit\n{rows}".encode(),
        "cut.json": b'{"student": "b", "answers": [',
        "nul.csv": b"student;what;value\nb;v B;3\0\n",
    }
    for name, data in works.items():
        client.put(f"/api/works/{name}", content=data)
    found = do(client, "checked", EX3, by_hand=[])
    client.delete("/api/works/all")
    assert found["code"] == 1
    assert "cut.json" in found["errors"] and "nul.csv" in found["errors"]
    students = [row[0] for row in found["answers"][1:]]
    assert students and {*students} == {*found["pages"]}
    assert len({*found["pages"].values()}) == len(found["pages"]) == 4
    for student, page in found["pages"].items():
        assert escape(student.removeprefix("'")) in client.get(found["files_at"] + page).text


def test_variants_are_made_with_questions(client: TestClient) -> None:
    found = do(client, "varied", EX3, count=2, seed=3, moodle=True)
    names = [one["name"] for one in found["files"]]
    assert {"ex3-variants.toml", "ex3-moodle.xml"} <= {*names}
    made = client.get(found["files_at"] + "ex3-variants.toml").text
    assert len(tomllib.loads(made)["variants"]) == 2


def test_no_message_shows_where_the_server_keeps_files(client: TestClient) -> None:
    client.put("/api/works/bad.json", content=b"{")
    found = do(client, "checked", EX3, by_hand=[])
    client.delete("/api/works/all")
    assert "bad.json" in found["errors"]
    assert "sessions" not in json.dumps(found["errors"])
    assert "/tmp" not in found["errors"]


def test_a_drawing_is_measured_as_a_work(client: TestClient) -> None:
    made = do(client, "command", EX3, what="dxf")
    drawing = client.get(made["files_at"] + "ex3.dxf").content
    assert client.put("/api/works/Белов.dxf", content=drawing).json() == ["Белов.dxf"]
    head, row = do(client, "checked", EX3, by_hand=[])["marks"]
    marks = dict(zip(head, row, strict=True))
    assert (marks["Студент"], marks["Оценка из 100"]) == ("Белов", "100.00")
    client.delete("/api/works/all")
