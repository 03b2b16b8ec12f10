"""Worker side of the studio, which runs the commands in a separate process (работа студии).

Every function gets its request as plain data and returns plain data; files go into the folder of
the request, which the server chose.
"""

from __future__ import annotations

import io
import json
import re
from collections.abc import Callable
from contextlib import redirect_stderr, redirect_stdout, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from planmethod.commands.helptext import answering
from planmethod.commands.watched import run
from planmethod.errors import Fault, PlanMethodError, ProblemError
from planmethod.languages import say

if TYPE_CHECKING:
    from planmethod.solved.part import MechanismPart

Asked = dict[str, Any]
Found = dict[str, Any]
Tell = Callable[[float], None]

OUT = "out"


def act(asked: Asked, tell: Tell) -> Found:
    """Process a request; its errors are in the response."""
    with answering(asked.get("lang", "ru")):
        try:
            _refuse_lacking(asked)
            return _cleaned(ACTS[asked["do"]](asked, tell), asked)
        except ProblemError as error:
            return _told(asked, error.faults)
        except PlanMethodError as error:
            return _told(asked, [Fault("", str(error))], placed=False)
        except click.ClickException as error:
            return _told(asked, [Fault("", error.format_message())], placed=False)
        except (MemoryError, RecursionError):
            raise
        except Exception as error:  # the last safety net, as that of the command line
            said = say(
                "Error: planmethod failed inside ({}: {}). Please report the problem file "
                "and the command.",
                type(error).__name__,
                error,
            )
            return _told(asked, [Fault("", said)], placed=False)


_NO_ANSWERS = "Answers to such problems are not checked. Their numbers are in the tables."
_NO_PROJECT = "Only a linkage has a note and a project. This file has sheets."
LACKING = {
    "live": ("live_page", "Such a problem has no page that moves. See its sheets and tables."),
    "structure": (
        "structure_document",
        "This problem has no links and joints, hence no structure.",
    ),
    "assemblies": (
        "",
        "Only linkages have several assembly configurations. This problem has only one.",
    ),
    "note": ("", _NO_PROJECT),
    "project": ("", _NO_PROJECT),
    **dict.fromkeys(("form", "key", "questions", "verdicts", "checked"), ("figures", _NO_ANSWERS)),
}
"""Features that some kinds of problem lack: their method, and the message when it is missing."""


def _refuse_lacking(asked: Asked) -> None:
    """Reject a feature that this kind of problem lacks.

    Raises
    ------
    PlanMethodError
    """
    from planmethod.kinds import kind_of

    method, said = LACKING.get(asked.get("what") or asked["do"], ("", ""))
    if not said:
        return
    with suppress(ProblemError):  # an unreadable file is reported where it is read
        kind = kind_of(_file(asked))
        if kind is not None and not (method and kind.has(method)):
            raise PlanMethodError(say(said))


def _told(asked: Asked, faults: Any, *, placed: bool = True) -> Found:
    from planmethod.studio.places import place_of

    text, told = asked.get("text", ""), []
    for fault in faults:
        line, column = (place_of(text, fault) if placed else None) or (None, None)
        told.append(
            {"path": fault.path, "message": fault.message, "hint": fault.hint,
             "choices": list(fault.choices), "line": line, "column": column}
        )  # fmt: skip
    return _cleaned({"faults": told}, asked)


def _cleaned(found: Found, asked: Asked) -> Found:
    """Return a response without the server's folders."""
    if "folder" not in asked:
        return found
    home = re.escape(str(Path(asked["folder"]).parent))
    place = rf"{home}[/\\](?:\d+[/\\](?:{OUT}[/\\])?|works[/\\])?"
    for key in ("output", "errors"):
        if key in found:
            found[key] = re.sub(place, "", found[key])
    for fault in found.get("faults", ()):
        fault["message"] = re.sub(place, "", fault["message"])
    return found


def _file(asked: Asked) -> Path:
    """Write the typed problem file, and return its path."""
    path = Path(asked["folder"]) / f"{asked['name']}.toml"
    path.write_bytes(asked["text"].encode("utf-8", "replace"))
    return path


# The scheme while one types ----------------------------------------------------------------------


def sketched(asked: Asked, _: Tell) -> Found:
    """Return the scheme as SVG, with the faults of the file at their places."""
    from planmethod.kinds import kind_of, part_of
    from planmethod.note.wording import language
    from planmethod.problem import variant_names
    from planmethod.render.sketch import VIEWS
    from planmethod.render.sketch import sketch as drawn

    path, variant = _file(asked), asked.get("variant")
    kind = kind_of(path)
    if kind is not None:
        return _other(kind, path, variant, asked["lang"])
    title, part = part_of(path, variant=variant, views=VIEWS)
    found, trouble = _told_of(asked, part)
    ways = len(part.assemblies)
    is_there = part.solution is not None or ways or part.fixed
    return found | {
        "svg": _svg(drawn(part, title, language(asked["lang"]), [])) if is_there else "",
        "title": title,
        "kind": "",
        "variants": [] if part.faults else list(variant_names(path)),
        "ways": ways,
        "moves": part.solution is not None and trouble is None,
    }


def _told_of(asked: Asked, part: MechanismPart) -> tuple[Found, PlanMethodError | None]:
    """Return the faults of a linkage's file, and the reason why it cannot be solved."""
    from planmethod.solved.failures import PositionError

    trouble = part.trouble
    if trouble is None and part.failure is not None:
        trouble = PositionError(part.failure)
    if trouble is not None and not part.faults:
        return _told(asked, [Fault("", str(trouble))], placed=False), trouble
    return _told(asked, part.faults), trouble


def _other(kind: Any, path: Path, variant: str | None, lang: str) -> Found:
    """Return the same for a problem of another kind: its scheme, or else its first sheet."""
    from msgspec.structs import replace

    from planmethod.options import drawn_by
    from planmethod.problem import variant_names

    problem = kind.load(path, variant)
    problem = replace(problem, sheet=replace(problem.sheet, lang=lang))
    drawing = kind.scheme(problem)
    if drawing is None:
        drawing = kind.drawings(problem, fields={}, profile=drawn_by(None, None))[0]
    return {
        "faults": [], "svg": _svg(drawing), "title": problem.title, "kind": kind.table,
        "variants": list(variant_names(path)), "ways": 0, "moves": True,
    }  # fmt: skip


def _svg(drawing: Any) -> str:
    from planmethod.render.backends import render

    return render(drawing, "svg").decode()


def assemblies(asked: Asked, _: Tell) -> Found:
    """Return the assembly configurations, each with the rules that choose it.

    If the file leaves several of them, those; else all, including those it excludes.
    """
    from msgspec.structs import replace

    from planmethod.kinds import part_of
    from planmethod.note.wording import language
    from planmethod.render.sketch import WAYS
    from planmethod.render.sketch import sketch as drawn

    path = _file(asked)
    whole = part = part_of(path, variant=asked.get("variant"), views=WAYS)[1]
    if not part.assemblies:
        bare = _without_assembly(asked["text"])
        path.write_bytes(bare.encode("utf-8", "replace"))
        part = part_of(path, variant=asked.get("variant"), views=WAYS)[1]
    words = language(asked["lang"])
    if not part.assemblies:
        found, trouble = _told_of(asked, whole)
        if trouble is not None:
            return found
    return {
        "faults": [],
        "ways": [
            {"rules": dict(way.rules), "svg": _svg(drawn(one, "", words, []))}
            for way in part.assemblies
            for one in [replace(part, solution=way.solution, assemblies=(), unsure=())]
        ],
    }


def _without_assembly(text: str) -> str:
    """Return a problem file without its rules of assembly."""
    kept, inside = [], False
    for line in text.split("\n"):
        if re.match(r"\s*\[", line):
            inside = re.match(r"\s*\[\s*assembly\b", line) is not None
        kept.append("" if inside or re.match(r"\s*assembly\b[^=]*=", line) else line)
    return "\n".join(kept)


def pictured(asked: Asked, _: Tell) -> Found:
    """Return the picture of a shipped task: its scheme, without results."""
    from planmethod.kinds import kind_of, part_of
    from planmethod.note.wording import language
    from planmethod.problem.tasks import home
    from planmethod.render.sketch import VIEWS, assigned
    from planmethod.render.sketch import sketch as drawn

    path = home() / asked["file"]
    kind = kind_of(path)
    if kind is not None:
        return _other(kind, path, None, asked["lang"])
    title, part = part_of(path, variant=asked.get("variant"), views=VIEWS)
    if part.solution is None:
        return {"svg": _svg(drawn(part, title, language(asked["lang"]), []))}
    return {"svg": _svg(assigned(part.solution))}


# Sheets ------------------------------------------------------------------------------------------


def sheets(asked: Asked, _: Tell) -> Found:
    """Draw the sheets, and return them with the data that the ruler needs of their views."""
    from planmethod.commands.asked import PaperRequest
    from planmethod.commands.problems import each
    from planmethod.commands.sheet import SheetOptions, drawn_for, settled_for
    from planmethod.problem.keys import known

    given = {**dict.fromkeys(known("sheet")), "lang": asked["lang"]}
    request = PaperRequest({}, given, no_config=asked["served"])
    options = SheetOptions(
        settled=request.settle(), phi=None, ruler=None, profile=None, errors=False, sigma=None,
        layout=asked.get("layout"), out=Path(asked["folder"]), formats=("svg",), dpi=100,
        dxf_text="strokes",
    )  # fmt: skip
    made: list[list[Any]] = []
    printed, errors = io.StringIO(), io.StringIO()
    with redirect_stdout(printed), redirect_stderr(errors):
        code = each(
            (_file(asked),), asked.get("variant"), False,
            lambda todo: drawn_for(settled_for(todo, options), options), take=made.append,
        )  # fmt: skip
    pages = [_page(drawing, asked["lang"]) for drawings in made for drawing in drawings]
    return {"code": int(code), "errors": errors.getvalue(), "pages": pages}


def _page(drawing: Any, lang: str) -> dict[str, Any]:
    from planmethod.note.plaintext import plain_text
    from planmethod.note.wording import language
    from planmethod.plans.model import FACTS

    known = language(lang).say.units
    units = {f.scale.removeprefix("mu_"): plain_text(known[f.unit]) for f in FACTS.values()}
    views = [
        {
            "kind": view.kind, "box": list(view.box), "per_mm": view.per_mm,
            "scale": plain_text(view.scale) if view.scale else "",
            "unit": units.get(re.sub(r"[^A-Za-z]", "", view.scale), ""),
            "spans": [
                {"name": plain_text(span.name), "share": span.share,
                 "ends": [span.start.real, span.start.imag, span.end.real, span.end.imag]}
                for span in view.spans
            ],
        }
        for view in drawing.views
    ]  # fmt: skip
    return {
        "svg": _svg(drawing), "width": drawing.width, "height": drawing.height,
        "title": drawing.title, "views": views,
    }  # fmt: skip


# Commands ----------------------------------------------------------------------------------------


def _listed(folder: Path) -> list[dict[str, Any]]:
    files = sorted(path for path in folder.rglob("*") if path.is_file())
    return [
        {"name": path.relative_to(folder).as_posix(), "bytes": path.stat().st_size}
        for path in files
    ]


def _paper(asked: Asked) -> list[str]:
    """Return the options of sheets; the server's config file is not for remote users."""
    return ["--no-config"] if asked["served"] else []


def _args(asked: Asked) -> dict[str, list[str]]:
    """Return the available command lines, without the problem and the folder."""
    layout = ["--layout", asked["layout"]] if asked.get("layout") else []
    lang = ["--lang", asked["lang"]]
    paper = [*_paper(asked), *lang]
    return {
        "tables": ["solve", *lang],
        "protocol": ["protocol", *lang],
        "structure": ["structure", "--no-drawing", *lang],
        "live": ["live", *lang],
        "pdf": ["sheet", "--format", "pdf", *layout, *paper],
        "dxf": ["sheet", "--format", "dxf", *layout, *paper],
        "svg": ["sheet", "--format", "svg", *layout, *paper],
        "note": ["note", *paper],
        "project": ["project", *paper],
        "form": ["form", *lang],
        "key": ["check", "--key", *lang],
    }


FILED = ("live", "pdf", "dxf", "svg", "note", "project", "form", "key")
"""Command lines that write files."""


def command(asked: Asked, tell: Tell) -> Found:
    """Run one of the command lines on the problem file."""
    name, *args = _args(asked)[asked["what"]]
    path, out = _file(asked), Path(asked["folder"]) / OUT
    folder = ["-o", str(out)] if asked["what"] in FILED else []
    if asked.get("variant"):
        args += ["--variant", asked["variant"]]
    found = run(name, *args, *folder, str(path), tell=tell)
    return {**found, "files": _listed(out)}


# Answers -----------------------------------------------------------------------------------------


def questions(asked: Asked, _: Tell) -> Found:
    """Return the questions without the answers."""
    from planmethod.check.form import asked_rows, unit_factor
    from planmethod.check.group import key_of_problem
    from planmethod.check.marks import DEFAULT
    from planmethod.commands.problems import each
    from planmethod.note.wording import language

    words = language(asked["lang"]).form
    keys: list[Any] = []
    errors = io.StringIO()
    with redirect_stderr(errors):
        each(
            (_file(asked),), asked.get("variant"), False,
            lambda todo: key_of_problem(todo.kind, todo.problem, DEFAULT), take=keys.append,
        )  # fmt: skip
    entries = keys[0].entries if keys else ()
    return {
        "errors": errors.getvalue(),
        "rows": [
            {
                "id": row.id, "letters": row.letters, "mm": row.mm, "unit": row.unit,
                "units": {one: unit_factor(one) for one in dict.fromkeys((row.unit, *row.units))},
                "senses": dict(row.senses), "scale": row.scale, "position": row.position,
            }
            for row in asked_rows(entries, words)
        ],
        "scales": {
            name: label for name, label in words["scales"].items()
            if name in {entry.scale for entry in entries if entry.mm is not None}
        },
    }  # fmt: skip


def verdicts(asked: Asked, tell: Tell) -> Found:
    """Grade one submission, as on the student's page."""
    path, folder = _file(asked), Path(asked["folder"])
    work = folder / "work.json"
    work.write_text(json.dumps(asked["work"], ensure_ascii=False), encoding="utf-8")
    variant = ["--variant", asked["variant"]] if asked.get("variant") else []
    found = run(
        "check", str(path), str(work), "-o", str(folder / OUT), "--lang", asked["lang"], *variant,
        tell=tell,
    )  # fmt: skip
    return found | {"files": _listed(folder / OUT)}


# The instructor ----------------------------------------------------------------------------------


def checked(asked: Asked, tell: Tell) -> Found:
    """Check the uploaded submissions, with the manually set scores."""
    from planmethod.check.pages.listing import safe
    from planmethod.check.pages.overrides import COLUMNS

    path, folder = _file(asked), Path(asked["folder"])
    out = folder / OUT
    by_hand = folder / "overrides.csv"
    rows = [COLUMNS, *([str(row.get(key, "")) for key in COLUMNS] for row in asked["by_hand"])]
    by_hand.write_bytes(_csv(rows))
    variant = ["--variant", asked["variant"]] if asked.get("variant") else []
    found = run(
        "check", str(path), *asked["works"], "-o", str(out), "--gradebook",
        "--overrides", str(by_hand), "--lang", asked["lang"], *variant, tell=tell,
    )  # fmt: skip
    return found | {
        "files": _listed(out),
        "marks": _table(out / "gradebook.csv"),
        "answers": _table(out / "results.csv"),
        "pages": {safe(student): page for student, page in _pages(out / "run.json").items()},
    }


def _pages(record: Path) -> dict[str, str]:
    """Return the page of each student by the record of a run, as names do not determine it."""
    return json.loads(record.read_bytes()).get("pages", {}) if record.exists() else {}


def _csv(rows: Any) -> bytes:
    import csv

    from planmethod.check.pages.listing import safe

    text = io.StringIO(newline="")
    csv.writer(text, delimiter=";", lineterminator="\r\n").writerows(
        [safe(cell) for cell in row] for row in rows
    )
    return text.getvalue().encode("utf-8-sig")


def _table(path: Path) -> list[list[str]]:
    import csv

    if not path.exists():
        return []
    text = path.read_text(encoding="utf-8-sig")
    mark = max(";,", key=text.partition("\n")[0].count)
    return list(csv.reader(io.StringIO(text, newline=""), delimiter=mark))


def varied(asked: Asked, tell: Tell) -> Found:
    """Choose variants; the file with them, their table, and questions for Moodle are written."""
    path, out = _file(asked), Path(asked["folder"]) / OUT
    lang, written = ["--lang", asked["lang"]], out / f"{asked['name']}-variants.toml"
    out.mkdir(exist_ok=True)
    found = run(
        "variants", str(path), "--count", str(asked["count"]), "--seed", str(asked["seed"]),
        "-o", str(written), *lang, tell=tell,
    )  # fmt: skip
    if written.exists() and asked.get("moodle"):
        quiz = out / f"{asked['name']}-moodle.xml"
        more = run("check", "--key", "--moodle", str(quiz), *lang, str(written), tell=tell)
        found = {**found, "errors": f"{found['errors']}\n{more['errors']}".strip()}
    return found | {"files": _listed(out)}


def warm(_: Asked, tell: Tell) -> Found:
    """Draw a shipped task, to load the modules and tables."""
    from tempfile import TemporaryDirectory

    from planmethod.problem.tasks import tasks

    task = next(task for task in tasks() if task.name == "linkages-ex3")
    with TemporaryDirectory() as folder:
        asked = {"folder": folder, "name": "warm", "text": task.text, "lang": "ru", "served": True}
        sketched(asked, tell)
        sheets(asked, tell)
    return {}


ACTS: dict[str, Callable[[Asked, Tell], Found]] = {
    one.__name__: one
    for one in (
        sketched, assemblies, pictured, sheets, command, questions, verdicts, checked, varied, warm,
    )
}  # fmt: skip
"""Requests by name."""
