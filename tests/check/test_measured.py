"""A drawing measured: plans that a student drew in a CAD program are judged as a work."""

from __future__ import annotations

import json
import os
import random
import re
from pathlib import Path

import ezdxf
import pytest
from cad import Insert, Style, draw
from cases import sampled, thinned
from click.testing import CliRunner
from doors import (
    RATES,
    FaultsSubmissionError as SubmissionError,
    GradedSubmission,
    PlanKind,
    Task,
    Unread,
    Variants,
    Verdict,
    check,
    cli,
    list_drawing_items,
    normalize,
    open_drawing,
    plan_letters,
    plan_of_layer,
    read_drawing,
    read_layers,
    single_point,
    variant_of,
)
from msgspec.structs import replace

from planmethod.check.measured.drawing import DrawnLine
from planmethod.check.measured.vertices import align_parallel

PROBLEMS = (
    "linkages/ex3",
    "levers/task12",
    "linkages/2.1.121",
    "linkages/2.1.28",
    "linkages/2.1.4",
)
WAYS: dict[str, Style] = {
    "lines": Style(),
    "polylines with a vertex more": Style("chain"),
    "strokes for arrows": Style(barbs=True),
    "a block and texts of several lines": Style("line", "paragraph", (Insert(at=10 + 0j),)),
    "metres": Style(per_unit=1e-3, units=6),
    "inches": Style(per_unit=1 / 25.4, units=1),
    "turned by 30°": Style(turn=0.8660254 + 0.5j),
    "indices as stacks": Style("line", "stack"),
    "seen from behind": Style("back", "back"),
    "a mirrored block in a scaled one": Style(
        "old polyline", "text", (Insert(2.0, at=5 + 0j), Insert(0.5, mirrored=True, degrees=30.0))
    ),
    "the whole mirrored": Style(mirror=True),
    "centimetres that are not stated": Style("line", "small stack", per_unit=0.1, units=0),
    "metres that are millimetres": Style(per_unit=1.0, units=6),
}
FINE = (Verdict.OK, Verdict.UNSEEN)


def task_of(problem: str) -> Task:
    variants = Variants(Path("problems") / f"{problem}.toml")
    task = variants.task(variants.names[0] if variants.names else None)
    list_drawing_items(task)
    return task


def judged(path: Path, task: Task, layers: tuple[str, ...] = ()) -> GradedSubmission:
    return check(task, read_drawing(open_drawing(path), read_layers(layers), task))


def off(checked: GradedSubmission) -> dict[str, Verdict]:
    return {one.id: one.verdict for one in checked.answers if one.verdict not in FINE}


@pytest.mark.parametrize("way", tuple(WAYS))
@pytest.mark.parametrize("problem", thinned(PROBLEMS, 3))
def test_a_right_plan_is_right_however_it_is_drawn(problem: str, way: str, tmp_path: Path) -> None:
    task = task_of(problem)
    checked = judged(draw(task.sheet(task.first), tmp_path / "work.dxf", style=WAYS[way]), task)
    assert checked.answers and not off(checked)
    assert checked.points == checked.of > 0
    assert not checked.diagnosis and not checked.suspicious and not checked.strokes


@pytest.mark.parametrize("problem", thinned(PROBLEMS, 2))
def test_any_manner_gives_full_marks_and_a_wrong_length_only_its_answers_wrong(
    problem: str, tmp_path: Path
) -> None:
    task = task_of(problem)
    sheet, rng = task.sheet(task.first), random.Random(problem)
    items = [item for item in list_drawing_items(task) if item.question.ends is not None]
    for seed in sampled(range(60), 6):
        style = Style.random(seed)
        checked = judged(draw(sheet, tmp_path / "right.dxf", style=style), task)
        assert not off(checked) and checked.points == checked.of > 0, (seed, style)
        item = rng.choice(items)
        assert item.question.ends is not None and item.question.plan is not None
        head = item.question.ends[1]
        plan = sheet.questions.construction.plan(item.question.plan)
        letters = plan_letters(sheet.questions.solution.problem, plan).get(head)
        vector = sheet.vector(item.question)
        if not letters or vector is None or abs(vector) < 10.0:
            continue
        away = vector / abs(vector) * (5.0 + 0.1 * abs(vector))
        moved = {f"{item.question.plan.value} {normalize(letters[0])}": away}
        checked = judged(draw(sheet, tmp_path / "wrong.dxf", style=style, moved=moved), task)
        at = single_point(sheet.exact_trace.value[head])
        touched = {  # a point drawn over it moves as well: they share their letters
            one.name
            for one in items
            if one.question.plan is item.question.plan
            and one.question.ends is not None
            and any(
                abs(single_point(sheet.exact_trace.value[end]) - at) < 0.3
                for end in one.question.ends
            )
        }
        touched |= {f"angle_{name}" for name in touched}
        lost = {one.id for one in checked.answers if one.points < one.of}
        assert item.name in lost <= touched, (seed, style, lost)


@pytest.mark.parametrize("problem", thinned(PROBLEMS, 2))
def test_a_plan_drawn_to_another_scale_is_one_mistake(problem: str, tmp_path: Path) -> None:
    task = task_of(problem)
    sheet = task.sheet(task.first)
    sizes: tuple[dict[PlanKind, float], ...] = (
        dict.fromkeys(RATES, 2.0),
        {PlanKind.VELOCITY: 0.5},
        {PlanKind.ACCELERATION: 1.25},
    )
    for larger in sizes if problem != "linkages/2.1.4" else sizes[:1]:  # it has two of each plan
        checked = judged(draw(sheet, tmp_path / "larger.dxf", larger=larger), task)
        told = [one for one in checked.diagnosis if one.codes == ("scale",)]
        assert len(told) == len(checked.diagnosis) == 1, larger
        wrong = [one.id for one in checked.answers if one.verdict is Verdict.WRONG]
        assert wrong == [*told[0].roots] and checked.of - checked.points < 1.0
    fast = {PlanKind.VELOCITY: 2.0, PlanKind.ACCELERATION: 4.0}  # the speed is wrong, not a scale
    checked = judged(draw(sheet, tmp_path / "fast.dxf", larger=fast), task)
    assert not any("scale" in one.codes for one in checked.diagnosis)


def test_a_drawing_names_its_variant(tmp_path: Path) -> None:
    path = Path("problems/linkages/ex3-variants.toml")
    variants = Variants(path)
    for number, name in enumerate(variants.names[:3]):
        file = f"petrov {number}.dxf" if number else f"petrov_вар-{name}.dxf"
        note = f"Вариант № {name}" if number else ""
        task = variants.task(name)
        list_drawing_items(task)
        draw(task.sheet(task.first), tmp_path / file, note=note)
    drawn = sorted(map(str, tmp_path.iterdir()))
    shown = CliRunner().invoke(cli, ["check", str(path), *drawn, "--lang", "en", "--json"])
    works = json.loads(shown.stdout)
    assert [work["variant"] for work in works] == [*variants.names[1:3], variants.names[0]]
    assert all(work["points"] == work["of"] > 0 for work in works)
    with pytest.raises(SubmissionError, match="no variant"):
        variant_of(
            open_drawing(draw(task.sheet(task.first), tmp_path / "x.dxf", note="Variant 99")),
            variants.names,
        )


def turned(text: str) -> str:
    """Return the sheet of ex3 with the vector (pd), 68.28 mm, a little turned: shaft and arrow."""
    number, moved = r"(-?\d*\.?\d+)", 5 - 4j
    starts = [
        (found[0], complex(float(found[1]), float(found[2])))
        for found in re.finditer(rf"M{number} ?{number}l(?=[^M\"]*Z)", text)  # arrows are closed
    ]
    for shaft in re.finditer(rf"M{number} ?{number}l{number} ?{number}", text):
        x, y, dx, dy = map(float, shaft.groups())
        start, along = complex(x, y), complex(dx, dy)
        if not 62 < abs(along) < 68:
            continue
        tip = start + along * 68.27586 / abs(along)
        heads = [(head, at) for head, at in starts if abs(at - tip) < 0.01]
        if heads:
            ((head, at),) = heads
            line = f"M{x} {y}l{dx + moved.real:.3f} {dy + moved.imag:.3f}"
            at += moved
            return text.replace(shaft[0], line).replace(head, f"M{at.real:.3f} {at.imag:.3f}l", 1)
    raise AssertionError("the vector (pd) is not on the sheet")


@pytest.mark.parametrize("fmt", ("dxf", "svg"))
def test_a_vector_of_our_own_sheet_that_is_moved_is_found(fmt: str, tmp_path: Path) -> None:
    command = ["sheet", "problems/linkages/ex3.toml", "--format", fmt, "-o", str(tmp_path)]
    assert CliRunner().invoke(cli, command).exit_code == 0
    path, task = tmp_path / f"ex3.{fmt}", task_of("linkages/ex3")
    assert not off(judged(path, task))
    if fmt == "svg":
        path.write_text(turned(path.read_text(encoding="utf-8")), encoding="utf-8")
        assert {"angle_v_D"} <= set(off(judged(path, task))) <= {"v_D", "angle_v_D", "angle_v_B3"}
        return
    document = ezdxf.readfile(path)  # type: ignore[attr-defined]
    lines = list(document.modelspace().query("LINE[layer=='PLAN_VECTORS']"))
    for number in sampled(range(len(lines)), 11):
        end = lines[number].dxf.end
        lines[number].dxf.end = (end.x + 5.0, end.y - 4.0, 0.0)
        document.saveas(tmp_path / "moved.dxf")
        lines[number].dxf.end = end
        checked = judged(tmp_path / "moved.dxf", task)
        told = [remark for remark in checked.work.remarks if remark.reason is Unread.OPEN]
        assert off(checked) or told, number


def test_a_vector_beside_a_longer_one_of_its_line_is_moved_onto_it() -> None:
    long = DrawnLine(0j, 60 + 0j, "0")
    beside, chained = DrawnLine(10 + 1.8j, 40 + 1.8j, "0"), DrawnLine(40 + 1.8j, 50 + 1.8j, "0")
    for turn in (1.0, 1j, 0.6 - 0.8j):
        drawn = [
            replace(one, start=one.start * turn, end=one.end * turn)
            for one in (long, beside, chained)
        ]
        ends = {(round(abs(one.start), 6), round(abs(one.end), 6)) for one in align_parallel(drawn)}
        assert ends == {(0.0, 60.0), (10.0, 40.0), (40.0, 50.0)}
    for other in (
        DrawnLine(10 + 8j, 40 + 8j, "0"),  # not near
        DrawnLine(10 + 1.8j, 40 + 2.8j, "0"),  # not parallel
        DrawnLine(70 + 1.8j, 90 + 1.8j, "0"),  # past its end
    ):
        assert align_parallel([long, other]) == [long, other]


def test_a_mistake_in_a_drawing_is_named(tmp_path: Path) -> None:
    task = task_of("linkages/ex3")
    sheet = task.sheet(task.first)
    for code in ("A2", "A3", "N1", "V1"):
        made = next(e for e in task.named(sheet) if e.code == code)
        checked = judged(draw(sheet, tmp_path / f"{code}.dxf", made.trace), task)
        named = {one for diagnosis in checked.diagnosis for one in diagnosis.codes}
        assert code in named, (code, named)
        assert all(v in (Verdict.WRONG, Verdict.INHERITED) for v in off(checked).values())


def test_layers_and_colours_are_named(tmp_path: Path) -> None:
    task = task_of("linkages/ex3")
    layers = {PlanKind.VELOCITY: "Слой 1", PlanKind.ACCELERATION: "Слой 2"}
    path = draw(task.sheet(task.first), tmp_path / "work.dxf", layers=layers)
    with pytest.raises(SubmissionError, match="Слой 1"):
        judged(path, task)
    assert not off(judged(path, task, ("Слой 1=velocity", "слой_2=ускорения")))
    told = read_layers(["red=velocity", "цвет 30=acceleration"])
    assert [plan_of_layer(told, "0", colour) for colour in (1, 30, 7)] == [
        "velocity",
        "acceleration",
        "",
    ]
    with pytest.raises(SubmissionError, match="--layer"):
        read_layers(["red=green"])


def test_items_that_cannot_be_matched_are_reported_and_not_guessed(tmp_path: Path) -> None:
    task = task_of("linkages/ex3")
    sheet = task.sheet(task.first)
    checked = judged(draw(sheet, tmp_path / "d.dxf", without=("d",)), task)
    whys = [(remark.reason, remark.fault) for remark in checked.work.remarks]
    assert (Unread.LETTER, "d") in whys
    blank = {one.id for one in checked.answers if one.verdict is Verdict.BLANK}
    assert {"v_D", "a_D", "v_E_D"} <= blank and "v_E" not in blank
    # Two letters so near both vertices that either may be meant.
    document = ezdxf.readfile(tmp_path / "d.dxf")  # type: ignore[attr-defined]
    space = document.modelspace()
    texts = {text.dxf.text: text for text in space.query("TEXT") if text.dxf.text in ("b", "b3")}
    space.delete_all_entities()
    for start, end in (((0, 0), (60, 0)), ((0, 0), (60, 3))):
        space.add_line(start, end, dxfattribs={"layer": "velocity"})
    for text, at in (("p", (-3, 0)), ("d", (63, 1.4)), ("e", (63.1, 1.6))):
        space.add_text(text, height=2.5).set_placement(at)
    assert texts
    document.saveas(tmp_path / "doubt.dxf")
    checked = judged(tmp_path / "doubt.dxf", task)
    unread = {one.id for one in checked.answers if one.verdict is Verdict.UNREADABLE}
    assert {"v_D", "v_E"} <= unread
    assert Unread.PLAN in {remark.reason for remark in checked.work.remarks}


def test_the_scale_written_on_a_drawing_counts(tmp_path: Path) -> None:
    task = task_of("linkages/ex3")
    sheet = task.sheet(task.first, {"mu_v": 0.04})
    assert not off(judged(draw(sheet, tmp_path / "told.dxf"), task))
    assert off(judged(draw(sheet, tmp_path / "untold.dxf", scales=False), task))


def test_the_command_takes_drawings_beside_other_works(tmp_path: Path) -> None:
    task = task_of("linkages/ex3")
    draw(task.sheet(task.first), tmp_path / "petrov.dxf")
    command = ["check", "problems/linkages/ex3.toml", str(tmp_path / "petrov.dxf"), "--lang", "en"]
    shown = CliRunner().invoke(cli, [*command, "problems/groups/ex3.csv", "--json"])
    works = json.loads(shown.stdout)
    assert works[0]["student"] == "petrov" and works[0]["points"] == works[0]["of"]
    assert len(works) > 5 and not any(work["alike"] for work in works[:1])
    written = CliRunner().invoke(cli, [*command, "-o", str(tmp_path)])
    assert written.exit_code == 0 and (tmp_path / "pages" / "petrov.html").exists()


# Hostile files -------------------------------------------------------------------------------


def _nested(path: Path, depth: int, *, circle: bool = False) -> None:
    document = ezdxf.new()  # type: ignore[attr-defined]
    for number in range(depth):
        block = document.blocks.new(f"B{number}")
        block.add_line((0, 0), (1, 1))
        last = number + 1 == depth
        for _ in range(1 if circle else 10):
            if not last or circle:
                block.add_blockref("B0" if last else f"B{number + 1}", (0, 0))
    document.modelspace().add_blockref("B0", (0, 0))
    document.saveas(path)


def test_hostile_drawings_are_rejected_with_one_message(tmp_path: Path) -> None:
    task = task_of("linkages/ex3")
    bad = {
        "dwg.dxf": b"AC1032" + bytes(100),
        "binary.dxf": b"AutoCAD Binary DXF\r\n\x1a\x00",
        "empty.dxf": b"",
        "noise.dxf": bytes(range(256)) * 50,
        "half.dxf": b"0\nSECTION\n2\nENTITIES\n0\nLINE\n10\nnan\n",
        "large.dxf": b"0\n" * (5 * 2**20),
        "noise.svg": b"<svg",
        "other.svg": b'<svg xmlns="http://www.w3.org/2000/svg" width="3"/>',
        "bomb.svg": b'<!DOCTYPE s [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;">]><s>&b;</s>',
    }
    for name, data in bad.items():
        (tmp_path / name).write_bytes(data)
    _nested(tmp_path / "deep.dxf", 12)
    _nested(tmp_path / "circle.dxf", 3, circle=True)
    _nested(tmp_path / "wide.dxf", 7)
    many = ezdxf.new()  # type: ignore[attr-defined]
    for number in range(500):
        many.modelspace().add_line((0, number), (9, number), dxfattribs={"layer": "velocity"})
    many.saveas(tmp_path / "many.dxf")
    for path in sorted(tmp_path.iterdir()):
        with pytest.raises(SubmissionError) as error:
            read_drawing(open_drawing(path), {}, task)
        assert str(path.name) in str(error.value)


def test_a_missing_library_is_reported(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("planmethod.check.measured.files.find_spec", lambda _: None)
    (tmp_path / "work.dxf").write_text("0\nEOF\n")
    with pytest.raises(SubmissionError, match="pip install ezdxf"):
        read_drawing(open_drawing(tmp_path / "work.dxf"), {}, task_of("linkages/ex3"))


def test_a_damaged_drawing_gives_no_traceback(tmp_path: Path) -> None:
    task = task_of("linkages/ex3")
    whole = draw(task.sheet(task.first), tmp_path / "whole.dxf").read_bytes()
    for seed in range(12 if "CI" in os.environ else 4):
        lines = whole.split(b"\n")
        for number in range(40):
            at = (seed * 7919 + number * 104729) % len(lines)
            lines[at] = (b"-1", b"1e999", b"", b"nan", b"LINE", b"\xff\xfe")[number % 6]
        (tmp_path / "damaged.dxf").write_bytes(b"\n".join(lines))
        try:
            judged(tmp_path / "damaged.dxf", task)
        except SubmissionError as error:
            assert "damaged.dxf" in str(error)
