from __future__ import annotations

import re

import pytest
from cases import each, sampled, some
from doors import (
    Mechanism,
    ProblemError,
    Revolute,
    Solution,
    Text,
    aligned_lines,
    analyse,
    get_language,
    kinds_loads as loads,
    kinematics_sheets,
    plain_document,
    self_aligning,
    structure_document,
    structure_record,
)
from protocols import LANGUAGES, assert_readable, drawn, worked
from texts import protocol, result_tables, structure_text
from worked import ROOT, SIX, problem_of


def text_of(name: str, lang: str = "ru") -> str:
    solution = worked(name)
    return structure_text(solution.problem.mechanism, solution.structure, lang)


@pytest.mark.parametrize("lang", LANGUAGES)
@pytest.mark.parametrize("name", SIX)
def test_is_readable(name: str, lang: str) -> None:
    assert_readable(text_of(name, lang))


@each("seed", sampled(range(some(40, few=15)), 3))
def test_any_mechanism_is_readable(seed: int) -> None:
    solution = drawn(seed)
    text = structure_text(solution.problem.mechanism, solution.structure)
    assert_readable(text)
    assert text.count("W = 3·2 − 2·3 = 0") == len(solution.structure.groups)
    assert text.count("(6·2 − 5·3) = 3") == len(solution.structure.groups)


def test_numbers_and_letters_of_the_six_link() -> None:
    text = text_of("levers/six-link")
    for line in (
        "W = 3n − 2p_н − p_в = 3·5 − 2·7 − 0 = 1",
        "W_пр = 6n − 5p₁ − 4p₂ − 3p₃ − 2p₄ − p₅ = 6·5 − 5·7 = −5",
        "q = W₀ + W_м − W_пр = 1 + 0 − (−5) = 6",
        "  1) Первичный механизм I класса (вращательная пара): звенья 6, 1\n",
        "  2) Группа II класса, 2-го порядка, 1-го вида (ВВВ): звенья 2, 3\n",
        "  3) Группа II класса, 2-го порядка, 4-го вида (ПВП): звенья 4, 5\n",
        "Порядок кинематического анализа: I(6,1) → II(2,3) → II(4,5)",
        "Порядок силового расчёта: II(4,5) → II(2,3) → I(6,1)",
        "Класс механизма: II",
    ):
        assert line in text


@pytest.mark.parametrize(
    ("notation", "lower", "higher"),
    [("p5 p4", "p₅", "p₄"), ("p1 p2", "p₁", "p₂"), ("pn pv", "p_н", "p_в"), (None, "p_н", "p_в")],
)
def test_the_numbers_of_pairs_have_one_notation(
    notation: str | None, lower: str, higher: str
) -> None:
    solution, words = worked("levers/six-link"), get_language("ru")
    document = structure_document(solution.problem.mechanism, solution.structure, words, notation)
    text = plain_document(document, words)
    assert f"W = 3n − 2{lower} − {higher} = 3·5" in text
    spatial = "5p₅ − 4p₄ − 3p₃ − 2p₂ − p₁" if lower == "p₅" else "5p₁ − 4p₂ − 3p₃ − 2p₄ − p₅"
    assert f"6n − {spatial} = 6·5 − 5·7" in text and f"{lower} = 7" in text.replace("\u00a0", " ")


@pytest.mark.parametrize(
    ("notation", "pairs"),
    [("p5 p4", "p₅ = 3, p₄ = 2, p₃ = 2"), ("p1 p2", "p₁ = 3, p₂ = 2, p₃ = 2")],
)
def test_pairs_of_the_scheme_are_counted_by_class_or_by_mobility(notation: str, pairs: str) -> None:
    """Six links have 5·3 + 4·2 + 3·2 = 29 constraints of 30."""
    problem, words = problem_of("levers/six-link"), get_language("ru")
    structure = analyse(problem.mechanism)
    aligned = self_aligning(problem, structure)
    text = plain_document(
        structure_document(problem.mechanism, structure, words, notation, aligned), words
    )
    assert f"Без избыточных связей: {pairs}" in " ".join(text.split())


@pytest.mark.parametrize("lang", LANGUAGES)
@pytest.mark.parametrize("name", [*SIX, "levers/task-13", "levers/task-33", "levers/task-49"])
def test_schemes_without_redundant_constraints_are_described(name: str, lang: str) -> None:
    problem, words = problem_of(name), get_language(lang)
    structure = analyse(problem.mechanism)
    aligned = self_aligning(problem, structure)
    text = plain_document(
        structure_document(problem.mechanism, structure, words, None, aligned), words
    )
    assert_readable(text)
    flat = " ".join(text.split())
    n = structure.moving_links
    assert "29 − 29 = 0, W = 30 − 29 = 1." in flat or (n == 3 and "17 − 17 = 0, W = 18" in flat)
    counts = (
        "6·5 − 5·3 − 4·2 − 3·2 = 1; q = 1 + 0 − 1 = 0" if n == 5 else "6·3 − 5·2 − 4·1 − 3·1 = 1"
    )
    assert counts in flat
    assert flat.count("q = 0.") == len(structure.groups)


def test_a_scheme_that_is_right_by_count_only_is_named() -> None:
    problem, words = problem_of("levers/six-link"), get_language("ru")
    structure = analyse(problem.mechanism)
    aligned = self_aligning(problem, structure)
    lines = [
        line.replace("\u00a0", " ")
        for line in aligned_lines(problem.mechanism, structure, aligned, words)
    ]
    assert lines[3].startswith("Группа 4–5: H (2–4) – 2ц, H (6–5) – 3пл; W_{пр} = 6·2 − 5·1 − 4·1")
    assert lines[5].startswith("Схема H (4–5) – 3с, H (2–4) – 2ц не годится")
    assert "меньше на 1" in lines[5] and "меньше на 2" in lines[2]


def test_the_frame_has_its_number_wherever_it_is_printed() -> None:
    text = (ROOT / "problems/press/press.toml").read_text("utf-8")
    numbered = text.replace("[frame]", "[frame]\nnumber = 6", 1)
    problem, plain = loads(numbered, name="press"), loads(text, name="press")
    solution = Solution(problem)
    told = [
        structure_text(problem.mechanism, solution.structure),
        result_tables(solution),
        protocol(solution),
    ]
    assert "I(6,1) → II(2,3) → II(4,5)" in told[0] and "O₃      6 – 3" in told[0]
    assert "B     5←6" in told[1] and "5 по 6" in told[1]
    assert "F₅₆" in told[2] and "v_B = v_B6 + v_BB6" in told[2]
    assert not re.search(r"F.?₅₀|F.?₁₀|I\(0,|B\(0,|←0|v_B0", "\n".join(told))
    for layout in ("forces", "forces-cycle"):
        texts = {i.text for sheet in kinematics_sheets(problem, layout=layout)
                 for i in sheet.items if isinstance(i, Text)}  # fmt: skip
        assert texts & {"16", "16 max"} and not texts & {"30", "10 max"}
    record = structure_record(solution.structure, problem.mechanism)
    assert record["frame"] == "6"
    groups = structure_record(Solution(plain).structure, plain.mechanism)["groups"]
    assert record["groups"] == groups
    with pytest.raises(ProblemError, match=r"frame\.number: link 5 has the same number"):
        loads(text.replace("[frame]", "[frame]\nnumber = 5", 1), name="press")


def test_pairs_and_links_are_listed() -> None:
    text = text_of("linkages/ex3", "en")
    rows = [line.split() for line in text.splitlines()]
    assert ["A", "0", "–", "1", "revolute", "(R)", "V", "1", "1"] in rows
    assert ["B(2,3)", "2", "–", "3", "prismatic", "(P)", "V", "1", "1"] in rows
    assert ["1", "crank", "rotation", "A,", "B"] in rows
    assert ["5", "slider", "translation", "E,", "E(0,5)"] in rows


def test_a_group_of_class_three_is_described() -> None:
    base = Revolute("A", ("0", "1"))
    pins = [("B", "1", "3"), ("C", "0", "4"), ("D", "0", "5")]
    outer = [Revolute(p, tuple(sorted((a, b)))) for p, a, b in pins]
    inner = [Revolute(p, ("2", link)) for p, link in (("E", "3"), ("F", "4"), ("G", "5"))]
    mechanism = Mechanism(("1", "2", "3", "4", "5"), (base, *outer, *inner), (), "1")
    text = structure_text(mechanism, analyse(mechanism))
    assert "Группа III класса, 3-го порядка (трёхповодковая): звенья 2, 3, 4, 5" in text
    assert "W = 3·4 − 2·6 = 0; q = 0 − (6·4 − 5·6) = 6" in text
    assert "Класс механизма: III" in text


@pytest.mark.parametrize("name", SIX)
def test_the_force_analysis_has_as_many_unknowns_as_equations(name: str) -> None:
    solution = worked(name)
    text = " ".join(structure_text(solution.problem.mechanism, solution.structure, "en").split())
    count = 3 * solution.structure.moving_links
    assert f"= {count} equations" in text
    assert f"= {count} unknowns" in text
    assert "statically determinate." in text
