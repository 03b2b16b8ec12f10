"""Worker side of the studio, which runs the commands in a separate process (работа студии)."""

from __future__ import annotations

import io
import json
import re
from collections.abc import Callable, Sequence
from contextlib import redirect_stderr, redirect_stdout, suppress
from importlib import import_module
from pathlib import Path
from typing import Any

import click

from planmethod.commands.command import answering
from planmethod.errors import Fault, PlanMethodError, ProblemError
from planmethod.languages import translate
from planmethod.options import ProblemChoice

_BAR = re.compile(r"planmethod\s+\[[^\]\r\n]*+\]\s+(\d++)%[^\r\n]*")
_ORDERS = re.compile(r"\x1b\[[?\d;]*[a-zA-Z]")
MAX_TEXT = 400_000
"""Maximum number of characters that are kept of a command's output."""


class _ProgressReader(io.StringIO):
    """Standard error of a command with a progress bar, which is reported, not kept."""

    def __init__(self, on_progress: Callable[[float], None]) -> None:
        super().__init__()
        self._told = on_progress

    def isatty(self) -> bool:
        """Return True, as for a terminal."""
        return True

    def write(self, text: str) -> int:
        """Report the progress of the bar; keep all other text."""
        text = _ORDERS.sub("", text)
        for share in _BAR.findall(text):
            self._told(int(share) / 100)
        super().write(_BAR.sub("", text).replace("\r", ""))
        return len(text)


def run(name: str, *args: str, on_progress: Callable[[float], None]) -> dict[str, Any]:
    """Run a command as the command line does; return its output and exit code."""
    command = getattr(import_module(f"planmethod.commands.{name}"), name)
    printed, errors, code = io.StringIO(), _ProgressReader(on_progress), 0
    with redirect_stdout(printed), redirect_stderr(errors):
        try:
            found = command.main(list(args), standalone_mode=False, prog_name=f"planmethod {name}")
            code = found if isinstance(found, int) else 0
        except SystemExit as end:
            code = end.code if isinstance(end.code, int) else 1
    return {
        "code": int(code),
        "output": printed.getvalue()[:MAX_TEXT],
        "errors": errors.getvalue().strip()[:MAX_TEXT],
    }


StudioRequest = dict[str, Any]
StudioResponse = dict[str, Any]
ProgressCallback = Callable[[float], None]

OUT = "out"


def act(request: StudioRequest, on_progress: ProgressCallback) -> StudioResponse:
    """Process a request; its errors are in the response."""
    with answering(request.get("lang", "ru")):
        try:
            _reject_unsupported(request)
            return _cleaned(ACTS[request["do"]](request, on_progress), request)
        except ProblemError as error:
            return _report_faults(request, error.faults)
        except PlanMethodError as error:
            return _report_faults(request, [Fault("", str(error))], placed=False)
        except click.ClickException as error:
            return _report_faults(request, [Fault("", error.format_message())], placed=False)
        except (MemoryError, RecursionError):
            raise
        except Exception as error:  # the last safety net, as that of the command line
            phrase = translate(
                "Internal error in planmethod ({}: {}). Please report the problem file and "
                "the command.",
                type(error).__name__,
                error,
            )
            return _report_faults(request, [Fault("", phrase)], placed=False)


_NO_ANSWERS = "Answers to this kind of problem are not checked. Its results are in the tables."
_NO_PROJECT = "Only a linkage has a project. This file has a note and sheets."
LACKING = {
    "live": (
        "live_page",
        "This kind of problem has no interactive page. See its sheets and tables.",
    ),
    "play": (
        "playback",
        "This kind of problem has no construction to play. See its sheets and tables.",
    ),
    "structure": (
        "structure_document",
        "This problem has no links and joints, hence no structure.",
    ),
    "assemblies": (
        "part",
        "Only linkages have several assembly configurations. This problem has only one.",
    ),
    "project": ("reject_as_project", _NO_PROJECT),
    **dict.fromkeys(
        ("form", "key", "questions", "verdicts", "checked"), ("answer_source", _NO_ANSWERS)
    ),
}
"""Features that some kinds of problem lack: their method, and the message when it is missing."""


def _reject_unsupported(request: StudioRequest) -> None:
    """Reject a feature that this kind of problem lacks.

    Raises
    ------
    PlanMethodError
    """
    from planmethod.kinds import kind_of

    what = request.get("what") or request["do"]
    if what not in LACKING:
        return
    method, phrase = LACKING[what]
    with suppress(ProblemError):  # an unreadable file is reported where it is read
        if not kind_of(_file(request)).has(method):
            raise PlanMethodError(translate(phrase))


def _report_faults(request: StudioRequest, faults: Any, *, placed: bool = True) -> StudioResponse:
    from planmethod.studio.requests import place_of

    text, told = request.get("text", ""), []
    for fault in faults:
        line, column = (place_of(text, fault) if placed else None) or (None, None)
        told.append(
            {"path": fault.path, "message": fault.message, "hint": fault.hint,
             "choices": list(fault.choices), "line": line, "column": column}
        )  # fmt: skip
    return _cleaned({"faults": told}, request)


def _cleaned(response: StudioResponse, request: StudioRequest) -> StudioResponse:
    """Return a response without the server's folders."""
    if "folder" not in request:
        return response
    home = re.escape(str(Path(request["folder"]).parent))
    place = rf"{home}[/\\](?:\d+[/\\](?:{OUT}[/\\])?|works[/\\])?"
    for key in ("output", "errors"):
        if key in response:
            response[key] = re.sub(place, "", response[key])
    for fault in response.get("faults", ()):
        fault["message"] = re.sub(place, "", fault["message"])
    return response


def _file(request: StudioRequest) -> Path:
    """Write the typed problem file, and return its path."""
    path = Path(request["folder"]) / f"{request['name']}.toml"
    path.write_bytes(request["text"].encode("utf-8", "replace"))
    return path


def _choice(request: StudioRequest) -> ProblemChoice:
    """Write the typed problem file, and return its chosen variant."""
    return ProblemChoice(problems=(_file(request),), variant=request.get("variant"))


# The scheme while one types ----------------------------------------------------------------------


def sketched(request: StudioRequest, _: ProgressCallback) -> StudioResponse:
    """Return the scheme as SVG, with the faults of the file at their places."""
    from planmethod.kinds import kind_of
    from planmethod.note.wording import get_language
    from planmethod.problem import variant_names

    path, language = _file(request), get_language(request["lang"])
    kind = kind_of(path)
    found = kind.sketched(path, request.get("variant"), language)
    return _report_sketched(request, found.faults, found.error) | {
        "svg": "" if found.drawing is None else _svg(found.drawing),
        "title": found.title,
        "variants": [] if found.faults else list(variant_names(path)),
        "ways": found.assemblies,
        "moves": found.moves,
        "lacks": [feature for feature, (method, _) in LACKING.items() if not kind.has(method)],
    }


def _report_sketched(
    request: StudioRequest, faults: Sequence[Fault], error: PlanMethodError | None
) -> StudioResponse:
    """Return the faults of a file, or else the reason why it cannot be solved."""
    if error is not None and not faults:
        return _report_faults(request, [Fault("", str(error))], placed=False)
    return _report_faults(request, faults)


def _svg(drawing: Any) -> str:
    from planmethod.render.backends import render

    return render(drawing, "svg").decode()


def assemblies(request: StudioRequest, _: ProgressCallback) -> StudioResponse:
    """Return the assembly configurations, each with the rules that choose it.

    If the file leaves several of them, those; else all, including those it excludes.
    """
    from msgspec.structs import replace

    from planmethod.kinds import kind_of
    from planmethod.note.wording import get_language
    from planmethod.render.sketch import ASSEMBLY_VIEWS, sketch as drawn

    path = _file(request)
    kind = kind_of(path)
    whole = part = kind.part(path, variant=request.get("variant"), views=ASSEMBLY_VIEWS)[1]
    if not part.assemblies:
        bare = _without_assembly(request["text"])
        path.write_bytes(bare.encode("utf-8", "replace"))
        part = kind.part(path, variant=request.get("variant"), views=ASSEMBLY_VIEWS)[1]
    language = get_language(request["lang"])
    if not part.assemblies and whole.error is not None:
        return _report_sketched(request, whole.faults, whole.error)
    return {
        "faults": [],
        "ways": [
            {"rules": dict(way.rules), "svg": _svg(drawn(one, "", language, []))}
            for way in part.assemblies
            for one in [replace(part, solution=way.solution, assemblies=(), unsure=())]
        ],
    }


# The mechanism that is moved by hand --------------------------------------------------------------

_AWAY = 0.01  # of the size of the drawing: a larger distance means another assembly


def modelled(request: StudioRequest, _: ProgressCallback) -> StudioResponse:
    """Return the contents of a file, and the model by which the page moves its mechanism.

    ``rules`` are those of the assembly that was drawn, where the file chooses another or none.
    """
    import tomllib

    from planmethod.errors import PlanMethodError
    from planmethod.kinds import kind_of
    from planmethod.note.wording import get_language
    from planmethod.problem.names import UNITS
    from planmethod.render.live.drawn import drawn_model
    from planmethod.render.sketch import VIEWS

    path, language = _file(request), get_language(request["lang"])
    kind = kind_of(path)
    if not kind.has("part"):
        raise PlanMethodError(translate("Only a linkage is drawn by hand. Edit the text."))
    part = kind.part(path, variant=request.get("variant"), views=VIEWS)[1]
    told = _report_sketched(request, part.faults, part.error)
    try:
        table = tomllib.loads(request["text"])
    except tomllib.TOMLDecodeError:  # it is among the faults
        return told
    found = {key: table.get(key) for key in ("frame", "links", "driver", "assembly", "loads")}
    told |= {"table": found, "per": UNITS.get(str(table.get("units", "m")), 1.0)}
    solution, rules = _drawn_way(request, kind, path, part)
    if solution is None or not (table.get("driver") or table.get("drivers")):
        # its position would be a guess
        return told | {"fixed": {name: _pair(at) for name, at in (part.fixed or {}).items()}}
    if rules:
        faults = told["faults"]
        told["faults"] = [one for one in faults if not one["path"].startswith("assembly")]
    whole = set(solution.problem.mechanism.links) == set(found["links"] or {})
    return told | {"model": drawn_model(solution, language), "rules": rules, "whole": whole}


def _drawn_way(
    request: StudioRequest, kind: Any, path: Path, part: Any
) -> tuple[Any, dict[str, str]]:
    """Return the solution of the assembly that was drawn, and the rules that the file lacks."""
    from planmethod.render.live.drawn import distance_of
    from planmethod.render.sketch import ASSEMBLY_VIEWS

    drawn = {name: complex(*place) for name, place in request["drawn"].items()}
    ways = part.assemblies
    if not drawn or part.solution is None:
        return part.solution, {}
    size = max(abs(a - b) for a in drawn.values() for b in drawn.values())
    if not ways and distance_of(part.solution, drawn) > _AWAY * size:
        bare = _without_assembly(request["text"])
        path.write_bytes(bare.encode("utf-8", "replace"))
        variant = request.get("variant")
        ways = kind.part(path, variant=variant, views=ASSEMBLY_VIEWS)[1].assemblies
    if not ways:
        return part.solution, {}
    best = min(ways, key=lambda way: distance_of(way.solution, drawn))
    return best.solution, dict(best.rules)


def _pair(place: complex) -> list[float]:
    return [place.real, place.imag]


def _without_assembly(text: str) -> str:
    """Return a problem file without its rules of assembly."""
    kept, inside = [], False
    for line in text.split("\n"):
        if re.match(r"\s*\[", line):
            inside = re.match(r"\s*\[\s*assembly\b", line) is not None
        kept.append("" if inside or re.match(r"\s*assembly\b[^=]*=", line) else line)
    return "\n".join(kept)


def pictured(request: StudioRequest, _: ProgressCallback) -> StudioResponse:
    """Return the picture of a shipped task: its scheme, without results."""
    from planmethod.kinds import kind_of
    from planmethod.note.wording import get_language
    from planmethod.problem.tasks import home

    path = home() / request["file"]
    picture = kind_of(path).task_picture(path, get_language(request["lang"]))
    return {"svg": "" if picture is None else _svg(picture)}


# Sheets ------------------------------------------------------------------------------------------


def sheets(job: StudioRequest, _: ProgressCallback) -> StudioResponse:
    """Draw the sheets, and return them with the data that the ruler needs of their views."""
    from planmethod.commands.problems import for_each_problem
    from planmethod.commands.sheet import SheetOptions, drawn_for, resolve_problem
    from planmethod.commands.sheet_options import PaperRequest

    colour = job.get("colour") or None
    paper = PaperRequest(lang=job["lang"], no_config=job["served"], colour=colour)
    order = SheetOptions(paper=paper, layout=job.get("layout")).order()
    made: list[list[Any]] = []
    printed, errors = io.StringIO(), io.StringIO()
    with redirect_stdout(printed), redirect_stderr(errors):
        code = for_each_problem(
            _choice(job),
            lambda item: drawn_for(resolve_problem(item, order), order.request),
            on_result=made.append,
        )
    pages = [_page(drawing, job["lang"]) for drawings in made for drawing in drawings]
    return {"code": int(code), "errors": errors.getvalue(), "pages": pages}


def _page(drawing: Any, lang: str) -> dict[str, Any]:
    from planmethod.note.document import plain_text
    from planmethod.note.wording import get_language
    from planmethod.plans.model import FACTS

    known = get_language(lang).notation.units
    units = {f.scale.removeprefix("mu_"): plain_text(known[f.unit]) for f in FACTS.values()}
    views = [
        {
            "kind": view.kind, "box": list(view.box), "per_mm": view.per_mm,
            "scale": plain_text(view.scale) if view.scale else "",
            "unit": units.get(re.sub(r"[^A-Za-z]", "", view.scale), ""),
            "spans": [
                {"name": plain_text(span.name), "share": span.magnification,
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


def _paper(request: StudioRequest) -> list[str]:
    """Return the options of sheets; the server's config file is not for remote users."""
    return ["--no-config"] if request["served"] else []


def _args(request: StudioRequest) -> dict[str, list[str]]:
    """Return the available command lines, without the problem and the folder."""
    layout = ["--layout", request["layout"]] if request.get("layout") else []
    lang = ["--lang", request["lang"]]
    paper = [*_paper(request), *lang]
    colour = ["--colour"] if request.get("colour") else []
    return {
        "tables": ["solve", *lang],
        "protocol": ["protocol", *lang],
        "structure": ["structure", "--no-drawing", *lang],
        "live": ["live", *colour, *lang],
        "play": ["play", *lang],
        "pdf": ["sheet", "--format", "pdf", *layout, *colour, *paper],
        "dxf": ["sheet", "--format", "dxf", *layout, *colour, *paper],
        "svg": ["sheet", "--format", "svg", *layout, *colour, *paper],
        "note": ["note", *paper],
        "project": ["project", *paper],
        "form": ["form", *lang],
        "key": ["check", "--key", *lang],
    }


FILED = ("live", "play", "pdf", "dxf", "svg", "note", "project", "form", "key")
"""Command lines that write files."""


def command(request: StudioRequest, on_progress: ProgressCallback) -> StudioResponse:
    """Run one of the command lines on the problem file."""
    name, *args = _args(request)[request["what"]]
    path, out = _file(request), Path(request["folder"]) / OUT
    folder = ["-o", str(out)] if request["what"] in FILED else []
    if request.get("variant"):
        args += ["--variant", request["variant"]]
    found = run(name, *args, *folder, str(path), on_progress=on_progress)
    return {**found, "files": _listed(out)}


# Answers -----------------------------------------------------------------------------------------


def questions(request: StudioRequest, _: ProgressCallback) -> StudioResponse:
    """Return the questions without the answers."""
    from planmethod.check.checking import key_of_problem
    from planmethod.check.form import list_form_rows, unit_factor
    from planmethod.check.marks import DEFAULT
    from planmethod.commands.problems import for_each_problem
    from planmethod.note.wording import get_language

    language = get_language(request["lang"])
    keys: list[Any] = []
    errors = io.StringIO()
    with redirect_stderr(errors):
        for_each_problem(
            _choice(request),
            lambda item: key_of_problem(item.kind, item.problem, DEFAULT),
            on_result=keys.append,
        )
    entries = keys[0].entries if keys else ()
    return {
        "errors": errors.getvalue(),
        "rows": [
            {
                "id": row.id, "words": row.words, "letters": row.letters, "mm": row.mm,
                "unit": row.unit,
                "units": {one: unit_factor(one) for one in dict.fromkeys((row.unit, *row.units))},
                "senses": dict(row.senses), "scale": row.scale, "position": row.position,
            }
            for row in list_form_rows(entries, language)
        ],
        "scales": {
            name: label for name, label in language.form["scales"].items()
            if name in {entry.scale for entry in entries if entry.mm is not None}
        },
    }  # fmt: skip


def verdicts(request: StudioRequest, on_progress: ProgressCallback) -> StudioResponse:
    """Grade one submission, as on the student's page; with the verdict on each answer."""
    from planmethod.note.wording import get_language

    path, folder = _file(request), Path(request["folder"])
    work = folder / "work.json"
    work.write_text(json.dumps(request["work"], ensure_ascii=False), encoding="utf-8")
    variant = ["--variant", request["variant"]] if request.get("variant") else []
    found = run(
        "check", str(path), str(work), "-o", str(folder / OUT), "--lang", request["lang"], *variant,
        on_progress=on_progress,
    )  # fmt: skip
    words = get_language(request["lang"]).check["verdicts"]
    head, *rows = _table(folder / OUT / "results.csv") or [[]]
    judged = [dict(zip(head, row, strict=False)) for row in rows]
    return found | {
        "files": _listed(folder / OUT),
        "judged": [
            {"id": one["id"], "verdict": one["verdict"], "words": words[one["verdict"]]}
            for one in judged
        ],
    }


# The instructor ----------------------------------------------------------------------------------


def checked(request: StudioRequest, on_progress: ProgressCallback) -> StudioResponse:
    """Check the uploaded submissions, with the manually set scores."""
    from planmethod.check.pages.listing import OVERRIDE_COLUMNS, safe

    path, folder = _file(request), Path(request["folder"])
    out = folder / OUT
    by_hand = folder / "overrides.csv"
    rows = [
        OVERRIDE_COLUMNS,
        *([str(row.get(key, "")) for key in OVERRIDE_COLUMNS] for row in request["by_hand"]),
    ]
    by_hand.write_bytes(_csv(rows))
    variant = ["--variant", request["variant"]] if request.get("variant") else []
    found = run(
        "check", str(path), *request["works"], "-o", str(out), "--gradebook",
        "--overrides", str(by_hand), "--lang", request["lang"], *variant, on_progress=on_progress,
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


def varied(request: StudioRequest, on_progress: ProgressCallback) -> StudioResponse:
    """Choose variants; the file with them, their table, and questions for Moodle are written."""
    path, out = _file(request), Path(request["folder"]) / OUT
    lang, written = ["--lang", request["lang"]], out / f"{request['name']}-variants.toml"
    out.mkdir(exist_ok=True)
    found = run(
        "variants", str(path), "--count", str(request["count"]), "--seed", str(request["seed"]),
        "-o", str(written), *lang, on_progress=on_progress,
    )  # fmt: skip
    if written.exists() and request.get("moodle"):
        quiz = out / f"{request['name']}-moodle.xml"
        more = run(
            "check", "--key", "--moodle", str(quiz), *lang, str(written), on_progress=on_progress
        )
        found = {**found, "errors": f"{found['errors']}\n{more['errors']}".strip()}
    return found | {"files": _listed(out)}


def warm(_: StudioRequest, on_progress: ProgressCallback) -> StudioResponse:
    """Draw a shipped task, to load the modules and tables."""
    from tempfile import TemporaryDirectory

    from planmethod.problem.tasks import tasks

    task = next(task for task in tasks() if task.name == "linkages-ex3")
    with TemporaryDirectory() as folder:
        asked = {"folder": folder, "name": "warm", "text": task.text, "lang": "ru", "served": True}
        sketched(asked, on_progress)
        sheets(asked, on_progress)
    return {}


ACTS: dict[str, Callable[[StudioRequest, ProgressCallback], StudioResponse]] = {
    one.__name__: one
    for one in (
        sketched, modelled, assemblies, pictured, sheets, command, questions, verdicts, checked,
        varied, warm,
    )
}  # fmt: skip
"""Requests by name."""
