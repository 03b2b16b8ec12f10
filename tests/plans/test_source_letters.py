"""Letters of the source: sheets and documents have them, records and names of quantities do not."""

from __future__ import annotations

import json
import re
import zipfile
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner
from doors import (
    DIMENSION,
    ModelProblem as Problem,
    ProblemError,
    Slide,
    Solution,
    Stroke,
    cli,
    fingerprint_of,
    problem_load as load,
    problem_loads as loads,
)
from worked import PROBLEMS, drawn_sheets, every_file, every_task, path_of

FREE = "QUVWZ"


def on_moving(problem: Problem) -> list[Slide]:
    return [slide for slide in problem.slides.values() if slide.host != "0"]


def coincident(problem: Problem) -> list[tuple[str, str]]:
    """Return the places of points that coincide with others, each with its link.

    Those under pins. The plans of a host that only translates have the slider's point instead,
    where the guide goes through one: E4 at the point E of link 5, not D5 under the pin D.
    """
    named = {quantity.of for quantity in Solution(problem).construction.legend}
    places = []
    for slide in on_moving(problem):
        under, through = (slide.pin, slide.host), (str(slide.through), slide.slider)
        places.append(under if "".join(under) in named else through)
    return places


def slotted() -> list[str]:
    """Return some of the files where a link slides on a moving one."""
    found = []
    for path in [*every_file(), *every_task()]:
        text = path.read_text("utf-8")
        if (
            "[letters]" not in text
            and "[variants" not in text
            and on_moving(loads(text, name="file"))
        ):
            found.append(path.relative_to(PROBLEMS).as_posix())
    return found[:4]


def lettered(text: str) -> tuple[str, dict[str, str]]:
    """Return a file with a letter for every point under a pin, and their usual names."""
    points = list(dict.fromkeys(coincident(loads(text, name="file"))))
    names = {FREE[k]: f"{place}{link}" for k, (place, link) in enumerate(points)}
    lines = [f'points.{FREE[k]} = "{p} on {link}"' for k, (p, link) in enumerate(points)]
    return "\n".join([text, "[letters]", *lines, ""]), names


def printed(*args: str) -> str:
    result = CliRunner().invoke(cli, [*args])
    assert result.exit_code == 0, result.output
    return result.output


def record(path: Path) -> Any:
    return json.loads(printed("solve", str(path), "--json"))


@pytest.mark.parametrize("name", slotted())
def test_records_and_fingerprints_stay(name: str, tmp_path: Path) -> None:
    text = (PROBLEMS / name).read_text("utf-8")
    plain, own = tmp_path / "a" / "file.toml", tmp_path / "b" / "file.toml"
    for path, content in ((plain, text), (own, lettered(text)[0])):
        path.parent.mkdir()
        path.write_text(content, "utf-8")
    assert record(plain) == record(own)
    assert fingerprint_of(load(plain)) == fingerprint_of(load(own))


@pytest.mark.parametrize("name", slotted())
def test_vectors_have_the_names_of_their_points(name: str) -> None:
    text = (PROBLEMS / name).read_text("utf-8")
    usual, own = (
        [
            (vector.kind, vector.points)
            for plan in Solution(loads(one, name="file")).construction.plans
            for vector in plan.vectors
        ]
        for one in (text, lettered(text)[0])
    )
    assert usual == own
    assert any(points for _, points in usual)


@pytest.mark.parametrize("name", slotted())
def test_no_usual_name_is_left(name: str, tmp_path: Path) -> None:
    text, names = lettered((PROBLEMS / name).read_text("utf-8"))
    path = tmp_path / "file.toml"
    path.write_text(text, "utf-8")
    solution = Solution(load(path))
    shown = [q.symbol for q in solution.construction.legend if q.named is None]
    for plan in solution.construction.plans:
        shown += [vector.symbol for vector in plan.vectors]
    protocol = printed("protocol", str(path))
    for letter, usual in names.items():
        assert not [one for one in shown if usual in one]
        assert [one for one in shown if letter in one]
        assert not re.search(rf"\b[va]_\w*{usual}", protocol)
        assert re.search(rf"\bv_q?{letter}", protocol)


def test_both_names_are_accepted() -> None:
    file = str(path_of("levers/six-link"))
    asked = [
        printed("solve", file, "--csv", "--ask", quantity)
        for quantity in ("v_H2,a_H2", "v_L,a_L", "v L,a L")
    ]
    assert asked[0] == asked[1] == asked[2]
    assert printed("solve", file, "--ask", "L") == printed("solve", file, "--ask", "H2")
    slides = [
        printed("solve", file, "--ask", quantity) for quantity in ("vs H H2", "vs H L", "v_H4/2")
    ]
    assert slides[0] == slides[1] == slides[2]


def test_answers_are_the_same_questions() -> None:
    text = path_of("levers/six-link").read_text("utf-8")
    usual, own = (
        loads(f'answers = [{{ what = "{v}" }}, {{ what = "{s}" }}]\n{text}', name="file").answers
        for v, s in (("v H2", "ak H H2"), ("v L", "ak_H_L"))
    )
    assert usual == own
    assert [one.id for one in own] == ["v_H2", "ak_H_H2"]


@pytest.mark.parametrize(
    ("name", "sentences"),
    [
        (
            "levers/six-link",
            ["v_H = v_L + v_HL", "a_H = a_L + aᵏ_HL + aʳ_HL", "∥ CL", "△", "M_1д"],
        ),
        ("levers/task12", ["v_F = v_B + v_FB", "a_F = a_B + aᵏ_FB + aʳ_FB", "M₁ ="]),
        ("linkages/ex3", ["v_B3 = v_B2 + v_B3B2", "a_B3 = a_B2 + aᵏ_B3B2 + aʳ_B3B2", "v_B1 = ω₁"]),
        ("press/press", ["v_A3 = v_A2 + v_A3A2", "v_A = ω₁"]),
    ],
)
@pytest.mark.parametrize("lang", ["ru", "en"])
def test_the_protocol_has_the_letters_of_the_book(
    name: str, sentences: list[str], lang: str
) -> None:
    protocol = printed("protocol", str(path_of(name)), "--lang", lang)
    for sentence in sentences:
        if sentence == "△":
            assert re.search(r"\bBCL\b", protocol)
        else:
            assert sentence in protocol


@pytest.mark.parametrize(
    ("entry", "fault"),
    [
        (
            'points.K = "C on 4"',
            "letters.points.K: the plans have no point C of link 4. "
            "Did you mean 'H on 4'? The plans have these points of link 4: H.",
        ),
        ('points.K = "H on 2"', ""),
    ],
)
def test_a_letter_that_no_plan_has_is_a_fault(entry: str, fault: str) -> None:
    text = path_of("levers/six-link").read_text("utf-8").replace('points.L = "H on 2"', entry)
    problem = loads(text.replace("v H2", "v H"), name="file")
    if not fault:
        assert Solution(problem).construction
        return
    with pytest.raises(ProblemError) as caught:
        assert Solution(problem).construction
    assert [str(one) for one in caught.value.faults] == [fault]


def test_sizes_of_the_frame_have_the_letters_of_the_source() -> None:
    file = str(path_of("levers/six-link"))
    protocol = " ".join(printed("protocol", file, "--lang", "en").split())
    for sentence in (
        "a₁ = 0.07 m; b₁ = 0.35 m; c₁ = 0.27 m; A is the origin; x_D = −b₁ = −0.35 m; "
        "y_D = −c₁ = −0.27 m; x_y-y = −b₁ − a₁ = −0.42 m;",
        "we lay off a₁ = 17.5 mm horizontally from D to y-y; b₁ = 87.5 mm horizontally from A "
        "to D; c₁ = 67.5 mm vertically from A to D.",
    ):
        assert sentence in protocol


def test_dimensions_of_the_frame_are_drawn_to_scale() -> None:
    (sheet,) = drawn_sheets("levers/six-link")
    lines: dict[str, list[complex]] = {}
    for item in sheet.items:
        if isinstance(item, Stroke) and item.tag.startswith(DIMENSION):
            start, end = item.points[0], item.points[-1]
            lines.setdefault(item.tag.partition(" ")[2], []).append(end - start)
    for letter, metres, along in (("a_{1}", 0.07, "x"), ("b_{1}", 0.35, "x"), ("c_{1}", 0.27, "y")):
        spans = [abs(z.real if along == "x" else z.imag) for z in lines[letter]]
        assert any(span == pytest.approx(metres * 250.0) for span in spans), (letter, spans)


@pytest.mark.parametrize(
    ("entry", "fault"),
    [
        ('l_DC = "x A D"', "letters.sizes.l_DC: l_DC is the letter of another quantity"),
        ('a_H = "x A D"', "letters.sizes.a_H: a_H is the letter of another quantity"),
        ('m_5 = "x A D"', "letters.sizes.m_5: m_5 is the letter of another quantity"),
        ('"ω_2" = "x A D"', "letters.sizes.ω_2: ω_2 is the letter of another quantity"),
        ('b_1 = "x A D", b = "x D A"', "letters.sizes.b: this distance has the letter b_1 too"),
        ('"а_1" = "x A D"', "letters.sizes.а_1: 'а_1' has the Cyrillic letter"),
        ('m_7 = "x A D", v = "y A D"', ""),
    ],
)
def test_a_size_has_a_letter_of_its_own(entry: str, fault: str) -> None:
    text = path_of("levers/six-link").read_text("utf-8")
    text = re.sub(r"sizes = \{.*\}", f"sizes = {{ {entry} }}", text)
    if not fault:
        assert len(loads(text, name="file").letters.sizes) == 2
        return
    with pytest.raises(ProblemError) as caught:
        loads(text, name="file")
    (told,) = map(str, caught.value.faults)
    assert told.startswith(fault)


def test_the_balancing_moment_has_not_the_letter_of_a_load() -> None:
    text = path_of("levers/six-link").read_text("utf-8")
    with pytest.raises(ProblemError, match=r"letters.balance: F_\{5C\} is the letter of another"):
        loads(text.replace('balance = "M_{1д}"', 'balance = "F_{5C}"'), name="file")


@pytest.mark.parametrize(
    ("lang", "way"), [("en", "Horizontal distance from"), ("ru", "Расстояние по горизонтали от")]
)
def test_the_note_names_the_sizes_of_the_frame(lang: str, way: str, tmp_path: Path) -> None:
    """A letter of one is neither that of the length of the crank nor that of an offset."""
    text = path_of("levers/six-link").read_text("utf-8")
    path = tmp_path / "file.toml"
    path.write_text(text.replace("b_1 = ", "e = "), "utf-8")
    printed("note", str(path), "--lang", lang, "--format", "docx", "-o", str(tmp_path))
    (note,) = tmp_path.glob("*.docx")
    words = zipfile.ZipFile(note).read("word/document.xml").decode("utf-8")
    rows = [re.sub("<[^>]+>", "", row) for row in re.findall(r"(?s)<w:tr\b.*?</w:tr>", words)]
    named = [row for row in rows if row.startswith(way)]
    assert [re.split("0[.,]", row)[1].split()[0] for row in named] == ["07", "35"]
