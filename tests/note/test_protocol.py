from __future__ import annotations

import re
from typing import get_args

import pytest
from cases import each, sampled, some
from doors import (
    Carry,
    MeasureAngle,
    MeasureArm,
    Names,
    PlanKind,
    PointName,
    Solution,
    StepsStep as Step,
    Total,
    problem_loads as loads,
    result_kind,
    wording,
)
from protocols import LANGUAGES, assert_readable, drawn, flat, told, worked
from texts import protocol
from worked import SIX, path_of

SEEDS = range(some(60, few=12))
"""Random mechanisms: enough for every dyad, driver and kind of step."""

SENTENCES = {
    ("linkages/ex1", "ru"): (
        "Из точки A под углом φ₁ = 60° к оси x откладываем отрезок AB = l_AB/μ_l = 0,03/0,001 = "
        "30 мм и получаем точку B.",
        "Из точки B радиусом BC = l_BC/μ_l = 0,1/0,001 = 100 мм делаем засечку на "
        "направляющей x-x; из двух точек пересечения берём правую – это точка C.",
        "v_B = ω₁·l_AB = 100·0,03 = 3 м/с; (pb) = v_B/μ_v = 3/0,05 = 60 мм.",
        "Из полюса p перпендикулярно AB откладываем отрезок pb = 60 мм в сторону ω₁ (по часовой "
        "стрелке) и получаем точку b.",
        "Из точки b проводим прямую, перпендикулярную BC, по которой направлен вектор v_CB.",
        "Из полюса p проводим прямую, параллельную x-x, по которой направлен вектор v_CC0.",
        "Измеряем отрезок bc = 31 мм",
        "v_CB = μ_v·(bc) = 0,05·31 = 1,55 м/с (точно 1,553). ω₂ = v_CB/l_BC = 1,55/0,1 = 15,5 с⁻¹",
        "против часовой стрелки. Вектор (bc), перенесённый в точку C, поворачивает звено 2",
        "точка d лежит на продолжении отрезка cb за точку b",
        "(bd) = (bc)·BD/BC = 31·30/100 = 9,3 мм.",
        "ω₁ постоянна",
        "aⁿ_CB = ω₂²·l_BC = 15,5²·0,1 = 24,03 м/с²",
        "от C к B, откладываем отрезок b–n_CB",
        "Направляющая x-x неподвижна, поэтому кориолисово ускорение aᵏ_CC0 равно нулю.",
        "Звено 3 движется поступательно: ω₃ = 0",
    ),
    ("linkages/ex1", "en"): (
        "From point b we draw a line perpendicular to BC, along which the vector v_CB lies.",
        "v_CB = μ_v·(bc) = 0.05·31 = 1.55 m/s (exactly 1.553). "
        "ω₂ = v_CB/l_BC = 1.55/0.1 = 15.5 s⁻¹",
        "counter-clockwise. The vector (bc), carried over to point C, turns link 2 about point B",
        "The guide x-x is at rest, so the Coriolis acceleration aᵏ_CC0 is zero.",
        "point d lies on the extension of the segment cb beyond b",
    ),
    ("linkages/ex2", "ru"): (
        "берём ту, что слева от прямой AC, если смотреть от A к C: это точка B.",
        "строим засечками треугольник pbd, подобный треугольнику CBD",
    ),
    ("linkages/ex3", "ru"): (
        "Группа 2–3 (ВПВ): II класс, 2-й порядок, 3-й вид",
        "Измеряем на плане положений отрезок BC = 72,5 мм (точно 72,48 мм).",
        "v_B3 = μ_v·(pb₃) = 0,05·45 = 2,25 м/с (точно 2,243). "
        "ω₃ = v_B3/(BC·μ_l) = 2,25/(72,5·0,002) = 15,52 с⁻¹",
        "(pd) = (pb₃)·CD/BC = 45·110/72,5 = 68,28 мм.",
        "v_D = μ_v·(pd) = 0,05·68,276 = 3,414 м/с (точно 3,405).",
        "Звено 2 поворачивается вместе со звеном 3: ω₂ = ω₃.",
        "aᵏ_B3B2 = 2·ω₃·v_B3B2 = 2·15,517·2,275 = 70,6 м/с²",
        "по направлению вектора v_B3B2, повёрнутого на 90° в сторону ω₃, против часовой стрелки",
        "v_E = v_EE0 = μ_v·(pe) = 0,05·78,5 = 3,925 м/с",
    ),
    ("levers/six-link", "ru"): (
        "Группа 4–5 (ПВП): II класс, 2-й порядок, 4-й вид",
        "Звено 4 поворачивается вместе со звеном 2: ω₄ = ω₂.",
        "μ_v = 30 мм/(м/с)",
        "(pb) = v_B·μ_v = 2·30 = 60 мм.",
        "Выбираем полюс p′; в нём лежат неподвижные точки: a′, d′.",
        "в сторону ε₁ (против часовой стрелки)",
        "треугольник bcl, подобный треугольнику BCL",
    ),
    ("levers/task12", "ru"): (
        "Группа 4–5 (ВПП): II класс, 2-й порядок, 5-й вид",
        "v_FB = (bf)/μ_v = 111/100 = 1,11 м/с",
        "получаем точку e (она же s₅).",
        "Из точки C по прямой DC, на её продолжении за точку C, откладываем отрезок CS3",
    ),
}


@pytest.mark.parametrize(("name", "lang"), SENTENCES)
def test_the_protocol_has_the_sentences_of_a_student(name: str, lang: str) -> None:
    text = told(name, lang)
    for sentence in SENTENCES[name, lang]:
        assert sentence in text


@pytest.mark.parametrize("lang", LANGUAGES)
@pytest.mark.parametrize("name", SIX)
def test_worked_mechanisms_are_readable(name: str, lang: str) -> None:
    assert_readable(protocol(worked(name), lang=lang))


@each("lang", LANGUAGES)
@each("seed", sampled(SEEDS, 3))
def test_any_mechanism_is_readable(seed: int, lang: str) -> None:
    assert_readable(protocol(drawn(seed), lang=lang))


def test_the_random_mechanisms_have_every_dyad_and_step() -> None:
    triads = [worked("linkages/triad")]
    programs = [drawn(seed) for seed in SEEDS] + [worked(name) for name in SIX] + triads
    signatures = {group.signature for s in programs for group in s.structure.groups}
    assert signatures == {"RRR", "RRP", "RPR", "PRP", "RPP", "RRR-RRR"}
    kinds = {type(step) for s in programs for step in s.construction.program.steps}
    # Steps of force plans, which mechanisms without loads lack, and steps on request.
    assert kinds == set(get_args(Step)) - {Carry, MeasureArm, Total, MeasureAngle}
    assert any(not s.problem.drive.is_crank for s in programs)


@pytest.mark.parametrize("name", SIX)
def test_every_point_of_the_plans_is_described(name: str) -> None:
    text = told(name, "ru")
    solution = worked(name)
    for plan in solution.construction.plans:
        heads = {equation.left.symbol.partition("_")[2] for equation in plan.equations}
        assert heads
    for group in solution.structure.groups:
        for link in group.links:
            assert f"ω{chr(0x2080 + int(link))}" in text


OFFSET = re.compile(
    r"Из точки (?P<tail>\S+) (?:перпендикулярно|под углом \S+ к) (?P<base>\S+) откладываем [^.;]*"
    r"\((?P<side>влево|вправо), если смотреть по ходу (?P=base)\) и получаем точку (?P<head>\S+)\."
)


def test_offsets_are_on_the_stated_side() -> None:
    checked = 0
    for seed in SEEDS:
        solution = drawn(seed)
        names = Names(solution, wording("ru"))
        steps = solution.construction.program.steps
        place = {
            names.point(PointName(step.out)): complex(solution.paper.point(step.out)[0])
            for step in steps
            if result_kind(step) is PointName and step.out not in names.letters
        }
        bases = {a + b: place[b] - place[a] for a in place for b in place if a != b}
        for found in OFFSET.finditer(flat(protocol(solution))):
            if found["base"] in bases:
                offset = place[found["head"]] - place[found["tail"]]
                left = (bases[found["base"]].conjugate() * offset).imag > 0
                assert left == (found["side"] == "влево"), (seed, found[0])
                checked += 1
    assert checked > 30


def test_the_equation_is_printed_over_its_underlines() -> None:
    lines = protocol(worked("linkages/ex3")).splitlines()
    at = next(i for i, line in enumerate(lines) if line.strip().startswith("a_B3 = a_B2 +"))
    assert lines[at + 1].split() == ["════", "═══════", "───────"]
    for symbol, rule in (("a_B2 ", "════"), ("aᵏ_B3B2", "═══════"), ("aʳ_B3B2", "───────")):
        assert lines[at].index(symbol) in [m.start() for m in re.finditer(rule, lines[at + 1])]


def test_steps_are_numbered_without_a_gap() -> None:
    numbers = re.findall(r"^ {0,3}(\d+)\) ", protocol(worked("levers/six-link")), re.MULTILINE)
    assert [int(n) for n in numbers] == list(range(1, len(numbers) + 1))


def test_sections_are_the_whole_program_in_order() -> None:
    solution = worked("levers/task12")
    found = solution.construction.sections
    steps = tuple(step for section in found for step in section.steps)
    program = solution.construction.program
    assert steps == program.steps[: len(steps)]
    # Later steps serve the tables of results and add no point to a plan.
    assert not [step for step in program.steps[len(steps) :] if result_kind(step) is PointName]
    assert [s.kind for s in found] == [
        *[PlanKind.POSITION] * 4,
        *[PlanKind.VELOCITY] * 3,
        *[PlanKind.ACCELERATION] * 3,
    ]


def test_each_of_many_positions_has_its_own_numbers() -> None:
    from doors import Solution

    solution = Solution(worked("linkages/ex1").problem, positions=[10.0, 60.0, 200.0])
    alone = Solution(worked("linkages/ex1").problem, positions=[60.0])
    text = flat(protocol(solution, position=1))
    assert "Положение 1 (всего 3): φ₁ = 60°" in text
    assert text.partition("Формула")[2] == flat(protocol(alone)).partition("Формула")[2]
    with pytest.raises(IndexError, match="position 3 of 3"):
        protocol(solution, position=3)


def test_a_point_at_a_joint_coincides_with_it() -> None:
    """S2 of task 59 at B, which is found on the plans from b and the corner e, a zero away."""
    text = path_of("levers/task-59").read_text(encoding="utf-8").partition("[variants")[0]
    text = text.replace('S2 = { on = "AB", at = 0.5 }', 'S2 = { on = "AB", at = 1 }')
    problem = loads(text, name="at-b")
    assert protocol(Solution(problem)).count("точка s₂ совпадает с точкой b.") == 2


@pytest.mark.parametrize("lang", LANGUAGES)
def test_a_file_with_symbols_of_pairs_has_its_mobility_in_the_protocol(lang: str) -> None:
    counted = {
        "linkages/ex1": "W = 3n − 2p₅ − p₄ = 3·3 − 2·4 − 0 = 1",
        "linkages/ex2": "W = 3n − 2p₅ − p₄ = 3·3 − 2·4 − 0 = 1",
        "linkages/ex3": "W = 3n − 2p₅ − p₄ = 3·5 − 2·7 − 0 = 1",
    }
    for name, formula in counted.items():
        assert formula in protocol(worked(name), lang=lang)
    assert "W = 3n" not in protocol(worked("levers/six-link"), lang=lang)
