"""Force plans in the protocol: its sentences, and numbers that are consistent and right."""

from __future__ import annotations

import re
from functools import cache
from itertools import product

import pytest
from cases import each, sampled, some
from doors import (
    AssemblyError,
    ForceReading,
    Solution,
    get_language,
    plain_text,
    problem_loads as loads,
    reaction_symbol,
    statics_of,
)
from lettered import closing_lines, lever_lines, moment_lines
from loaded import loaded_problem
from msgspec.structs import replace
from protocols import LANGUAGES, assert_readable, flat, told, worked
from texts import protocol
from worked import path_of

from benchmarks.hard_problems import rocker

LOADED = ("levers/six-link", "levers/task12", "press/press", "press/press-stone")
TRIADS = 1000
"""Seeds from there on are of mechanisms with a triad."""

SEEDS = [*range(some(30, few=12)), *range(TRIADS, TRIADS + some(30, few=8))]
"""Random loaded mechanisms: enough for every dyad and for a driving slider."""

SENTENCES = {
    ("levers/six-link", "ru"): (
        "Принимаем масштаб этого плана μ_F = 0,025 мм/Н.",
        "Φ₁ = 0: ускорение точки A равно нулю;",
        "Φ₂ = m₂·a_S2 = 40·68,5 = 2740 Н (точно 2744), приложена в точке S2, направлена "
        "противоположно a_S2;",
        "M_Φ2 = J_S2·ε₂ = 2·124,17 = 248,3 Н·м (точно 250,3), направлен по часовой стрелке, "
        "противоположно ε₂.",
        "Звено 4 считаем невесомым",
        "F_5C = 6000 Н, приложена в точке H, направлена вертикально вниз.",
        "в порядке, обратном кинематическому: группа 4–5, группа 2–3, начальное звено 1.",
        "реакции: F₄₂ со стороны звена 2 в точке H, F₅₆ со стороны стойки в точке H.",
        "Из конца вектора G₅ откладываем вектор Φ₅ параллельно отрезку p′h′ в сторону, "
        "противоположную ускорению a_H; длина отрезка 2488·0,025 = 62,19 мм.",
        "Из начала плана проводим прямую, перпендикулярную CL, по которой направлен вектор F₄₂.",
        "F₄₂ = 175,5/0,025 = 7020 Н (точно 6996);",
        "Из уравнения равновесия звена 4 следует, что F₄₅ = −F₄₂.",
        "поэтому момент реакции M₅₆ = 0 и сила F₅₆ проходит через точку H.",
        "Реакцию F₂₁ представляем двумя составляющими: касательной F^τ₂₁ ⊥ BC и нормальной Fⁿ₂₁ ∥ "
        "BC.",
        "Из расчёта предыдущих групп известно: F₂₄ = −F₄₂.",
        "ΣM_C = Φ₂·h_Φ2 + F₂₄·h_F24 − G₂·h_G2 − M_Φ2 − F^τ₂₁·l_BC = 0, плечи: h_G2 = 20,5; h_Φ2 = "
        "23,5; h_F24 = 38,0 мм; F^τ₂₁ = ((2740·23,5 + 7020·38,0 − 392,4·20,5)/250 − 248,3)/0,3 = "
        "3480 Н (точно 3475). F^τ₂₁ поворачивает звено 2 вокруг точки C по часовой стрелке.",
        "Из конца вектора Φ₂ откладываем вектор F₂₄ противоположно вектору F₄₂; длина отрезка "
        "7020·0,02 = 140,4 мм.",
        "Полная реакция F₂₁ = Fⁿ₂₁ + F^τ₂₁ изображается вектором от точки пересечения до конца "
        "вектора F^τ₂₁.",
        "Реакция F₂₃ замыкает план сил звена 2 и изображается вектором от конца вектора F₂₄ до "
        "точки пересечения.",
        "M_1д = 9875·17,5/250 − 400 = 291,3 Н·м (точно 287,2), направлен по часовой стрелке.",
        "G₂, Φ₂ — в точку s₂; G₅, Φ₅, F_5C — в точку h.",
        "не дают: G₁, G₃.",
        "Момент M_Φ2 заменяем парой сил M_Φ2/l_BC в точках b, c рычага: (bc) = 73,0 мм; l_BC = 0,3 "
        "м; пара поворачивает рычаг против часовой стрелки.",
        "По планам сил M_1д = 291,3 Н·м, по рычагу 286,0 Н·м: расхождение 5,2 Н·м (1,8 %).",
    ),
    ("levers/six-link", "en"): (
        "Φ₂ = m₂·a_S2 = 40·68.5 = 2740 N (exactly 2744), acts in point S2 opposite to a_S2;",
        "From the head of Φ₂ we lay off the vector F₂₄ opposite to the vector F₄₂; the length of "
        "the segment is 7020·0.02 = 140.4 mm.",
        "M_1д = 9875·17.5/250 − 400 = 291.3 N·m (exactly 287.2), clockwise.",
        "By the force plans M_1д = 291.3 N·m, by the lever 286.0 N·m",
    ),
    ("levers/task12", "ru"): (
        "Из уравнения равновесия звена 4 следует, что F₄₃ = F₅₄.",
        "F₅₀ = 0: направляющая передаёт только пару с моментом M₅₀.",
        "M₅₀ = 1990·15,0/300 = 99,50 Н·м (точно 98,97), направлен по часовой стрелке.",
        "Прямые пересекаются и замыкают план сил звена 2: вектор F₂₃ направлен от конца вектора "
        "F^τ₂₁ до точки пересечения. ",
        "Замыкающий вектор, проведённый от конца вектора F₃₄ до точки пересечения, изображает "
        "реакцию F₃₀.",
        "l_BC = 57,5/300 = 0,19167 м;",
        "Полная реакция F₂₁ = F^τ₂₁.",
    ),
    ("press/press", "ru"): (
        "μ_F = 4 Н/мм",
        "M_Φ1 = 0: ε₁ = 0.",
        "P = 350,4 Н, приложена в точке B, направлена вертикально вверх.",
        "ΣM_B = 0: F^τ₄₃ = 0. Известные силы момента относительно точки B не дают.",
        "l_AO3 = 191,0·0,005 = 0,955 м;",
        "F₅₀ ≈ 0",
    ),
    ("press/press-stone", "ru"): ("по которой направлен вектор F₄₃", "⊥ O3B"),
}


@cache
def random_loaded(seed: int, ruler: float | None = None) -> Solution:
    problem = loaded_problem(seed, triad=seed >= TRIADS)[0]
    return Solution(problem) if ruler is None else Solution(problem, ruler=ruler)


def every(ruler: float | None = None) -> list[Solution]:
    """Return the random mechanisms; of them in make test a half, with a ruler of their own less."""
    seeds = sampled(SEEDS, 2 if ruler is None else 4)
    return [random_loaded(seed, ruler) for seed in seeds]


@cache
def text_of(solution: Solution) -> str:
    return protocol(solution)


def forces_of(text: str) -> str:
    """Return the chapters on forces in one line."""
    start = re.search(r"^\d+\. (Силы, действующие|Forces on)", text, re.MULTILINE)
    end = re.search(r"^\d+\. (Результаты|Results)", text, re.MULTILINE)
    assert start and end
    return flat(text[start.start() : end.start()])


def number(text: str) -> float:
    """Return the value of a printed number: ``−3,5``, ``1,2·10⁻⁵``."""
    powers = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")
    plain = text.replace(",", ".").replace("−", "-")
    return float(re.sub(r"·10([⁰¹²³⁴⁵⁶⁷⁸⁹⁻]+)", lambda m: f"e{m[1].translate(powers)}", plain))


@pytest.mark.parametrize(("name", "lang"), SENTENCES)
def test_the_protocol_has_the_sentences_of_a_student(name: str, lang: str) -> None:
    text = told(name, lang)
    for sentence in SENTENCES[name, lang]:
        assert sentence in text


@pytest.mark.parametrize("lang", LANGUAGES)
@pytest.mark.parametrize("name", LOADED)
def test_worked_mechanisms_are_readable(name: str, lang: str) -> None:
    assert_readable(protocol(worked(name), lang=lang))


@each("seed, lang", sampled([*product(SEEDS, LANGUAGES)], 7))
def test_any_loaded_mechanism_is_readable(seed: int, lang: str) -> None:
    text = protocol(random_loaded(seed), lang=lang)
    assert_readable(text)
    if lang == "en":
        assert not re.search("[а-яё]", forces_of(text), re.IGNORECASE)


def test_the_random_mechanisms_have_every_dyad_and_driver() -> None:
    signatures = {g.signature for s in every() for g in s.structure.groups}
    assert signatures > {"RRR", "RRP", "RPR", "PRP", "RPP"}
    assert {s.problem.drive.is_crank for s in every()} == {True, False}


# Numbers ------------------------------------------------------------------------------------------

NUMBER = r"−?\d[\d,]*(?:·10[⁰¹²³⁴⁵⁶⁷⁸⁹⁻]+)?"
WORKED = re.compile(
    rf"(?:^|[;,.:] )(?P<symbol>\S+) = (?:[^=;:]*[^\d=;:][^=;:]* = )?(?P<sum>[\d(][\d,()/·+− ]*)"
    rf" = (?P<value>{NUMBER}) (?:Н·м|Н|мм|м)\b"
)


def computed(text: str) -> tuple[float, float]:
    """Return the value of a sum of products, and the sum of the sizes of its terms."""
    plain = text.replace(",", ".").replace("·", "*").replace("−", "-")
    return float(eval(plain)), float(eval(plain.replace("-", "+")))


def test_every_formula_gives_its_printed_result() -> None:
    """Four digits of the numbers put in: of a difference as much as of its terms."""
    count = 0
    fine = [Solution(worked(name).problem, ruler=0.01) for name in LOADED]
    for solution in (*map(worked, LOADED), *fine, *every()):
        text = forces_of(text_of(solution))
        for found in WORKED.finditer(text):
            value, size = computed(found["sum"])
            assert number(found["value"]) == pytest.approx(value, abs=1.2e-3 * abs(size)), found[0]
            count += 1
    assert count > some(900, few=450) * len(every()) // len(SEEDS)


EXACTLY = re.compile(
    rf"(?P<symbol>[^\s;]+) (?:=|≈) [^;:]*?(?P<value>{NUMBER})(?: (?:Н·м|Н))? "
    rf"\(точно (?P<exact>{NUMBER})\)"
)


def test_with_a_fine_ruler_all_forces_are_exact() -> None:
    """Every reading gives the exact value, by any route."""
    count = 0
    for solution in (Solution(worked(name).problem, ruler=1e-9) for name in LOADED):
        for found in EXACTLY.finditer(forces_of(text_of(solution))):
            assert number(found["value"]) == pytest.approx(number(found["exact"]), rel=2e-3)
            count += 1
    for solution in every(1e-9):
        peak = statics_of(solution).largest(0)
        for found in EXACTLY.finditer(forces_of(text_of(solution))):
            value, exact = number(found["value"]), number(found["exact"])
            # A force in whole ruler steps of 0.1 mm is written only to this accuracy.
            step = 0.06 * statics_of(solution).scale.per_mm
            assert abs(value - exact) <= 2e-3 * abs(exact) + (step if exact < peak else 0.0)
            count += 1
    assert count > some(400, few=10 * len(every(1e-9)))


@pytest.mark.parametrize("name", LOADED)
def test_the_exact_values_are_those_of_the_table(name: str) -> None:
    solution = worked(name)
    text = forces_of(text_of(solution))
    exact = {m["symbol"]: m["exact"] for m in EXACTLY.finditer(text)}
    for joint in statics_of(solution).reactions:
        size = abs(complex(joint.force[0]))
        on, by = map(solution.problem.mechanism.called, (joint.on, joint.by))
        symbols = [reaction_symbol(on, by), reaction_symbol(by, on)]
        named = [exact[plain_text(s)] for s in symbols if plain_text(s) in exact]
        if size > 1e-9:
            assert named, symbols
            assert number(named[0]) == pytest.approx(size, rel=1e-3)
    balance = float(statics_of(solution).balance[0])
    moment = plain_text(get_language("ru").notation.symbol(solution.problem.balancer.symbol))
    assert number(exact[moment]) == pytest.approx(abs(balance), rel=1e-3)
    sense = "против часовой стрелки" if balance > 0 else "по часовой стрелке"
    for found in re.finditer(moment + r" = [^.;]*\(точно \S+\), направлен ([^.]*)\.", text):
        assert found[1] == sense


# Steps --------------------------------------------------------------------------------------------

LAID = re.compile(
    r"(?:откладываем вектор |Вектор (?=\S+ откладываем ))(?P<symbol>\S+) [^;]*; "
    r"длина отрезка (?P<product>\S+) = (?P<length>[\d,]+) мм"
)


def test_every_known_force_is_laid_off_in_the_order_of_the_polygon() -> None:
    """A link's forces once each: those of the second link of two guides backwards."""
    count = 0
    for solution in every():
        reading = ForceReading(solution, 0)
        parts = re.split(r"\n\d+\.\d+\. ", text_of(solution).partition("Силовой расчёт")[2])[1:]
        for k, (plan, part) in enumerate(zip(reading.plans, parts, strict=True)):
            laid = list(LAID.finditer(flat(part)))
            unknown = {edge.symbol for edge in plan.reactions}
            asked = [
                edge
                for edge in plan.polygon
                if edge.symbol not in unknown and reading.length(edge, k) > 0.0
            ]
            # The force of a block on the base link of a triad is found by moments.
            weighed = {one.force.symbol for one in plan.moments if one.force is not None}
            passed = [e for e in plan.inner if e.symbol in weighed and reading.length(e, k) > 0.0]
            asked += passed
            order = [m["symbol"] for m in laid]
            assert sorted(order) == sorted(plain_text(e.symbol) for e in asked)
            lengths = {plain_text(edge.symbol): reading.length(edge, k) for edge in asked}
            for match in laid:
                length = lengths[match["symbol"]]
                assert number(match["length"]) == pytest.approx(length, rel=6e-4)
                assert computed(match["product"])[0] == pytest.approx(length, rel=1.2e-3)
            if "чтобы его конец совпал" not in flat(part) and not passed:
                assert order == [plain_text(edge.symbol) for edge in asked]
            count += len(laid)
    assert count > some(300, few=150) * len(every()) // len(SEEDS)


def test_every_reaction_is_described_from_end_to_end() -> None:
    """The protocol names its vector, or one that equals it, and then its size."""
    for solution in every():
        reading, text = ForceReading(solution, 0), forces_of(text_of(solution))
        for plan in reading.plans:
            for edge in plan.reactions:
                symbol = re.escape(plain_text(get_language("ru").notation.symbol(edge.symbol)))
                assert re.search(rf"[ :]{symbol} (=|≈) [^;.]*[;.]", text), symbol
                if not reading.is_negligible(edge):
                    said = rf"{symbol} (направлен от|=|замыкает)|изображает реакцию {symbol}\."
                    assert re.search(said, text), symbol


WHIRLS = re.compile(
    r"(?P<symbol>F\S+) поворачивает звено (?P<link>\S+) вокруг точки (?P<p>\S+) (?P<s>[^.]*)\."
)


def test_a_tangential_reaction_turns_its_link_in_the_stated_sense() -> None:
    count = 0
    for solution in (*map(worked, LOADED), *every()):
        reading = ForceReading(solution, 0)
        senses = {(m["symbol"], m["p"]): m["s"] for m in WHIRLS.finditer(flat(text_of(solution)))}
        for plan in reading.plans:
            for equation in plan.moments:
                edge = equation.force
                if edge is None or reading.is_negligible(edge):
                    continue
                arm = reading.place(edge.at) - reading.place(equation.about)
                turn = (arm.conjugate() * reading.force(edge)).imag
                sense = "против часовой стрелки" if turn > 0 else "по часовой стрелке"
                assert senses[plain_text(edge.symbol), str(equation.about)] == sense
                count += 1
    assert count > some(30, few=12) * len(every()) // len(SEEDS)


ACTS = re.compile(
    r"Точка приложения (?P<force>F\S+) отстоит от точки (?P<point>\S+) на l\S+ = \S+ = \S+ = "
    r"(?P<distance>\S+) м (?P<side>\w+)\."
)
AHEAD = {"вправо": 1, "влево": -1, "вверх": 1j, "вниз": -1j}


def test_the_force_of_a_guide_acts_at_the_stated_point() -> None:
    """There its moment about the pin is that of the guide."""
    count = 0
    for solution in every(1e-9):
        text = flat(text_of(solution))
        found = {(m["force"], m["point"]): m for m in ACTS.finditer(text)}
        for joint in statics_of(solution).reactions:
            force, moment = complex(joint.force[0]), float(joint.moment[0])
            symbol = plain_text(reaction_symbol(joint.on, joint.by))
            told_of = [m for (name, _), m in found.items() if name == symbol]
            if not told_of or abs(force) < 10 * statics_of(solution).scale.per_mm:
                continue
            away = -1j * force / abs(force) * moment / abs(force)
            assert number(told_of[0]["distance"]) == pytest.approx(abs(away), rel=1e-2)
            assert (away * AHEAD[told_of[0]["side"]].conjugate()).real >= 0.7 * abs(away)
            count += 1
    assert count > some(10, few=5) * len(every()) // len(SEEDS)


# The sheet ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", LOADED)
def test_the_protocol_has_the_formulas_of_the_sheet(name: str) -> None:
    """Each line but the sum in letters: the protocol names its links in a sentence."""
    reading, text = ForceReading(worked(name), 0), told(name, "ru")
    for number, plan in enumerate(reading.plans):
        lines = [line for line in moment_lines(reading, plan) if not line.startswith("Σ")]
        for line in (*closing_lines(reading, number), *lines):
            assert plain_text(line) in text
    assert plain_text(lever_lines(reading)[0]) in text


# Odd problems -------------------------------------------------------------------------------------


def six_link(*changes: tuple[str, str]) -> Solution:
    text = path_of("levers/six-link").read_text(encoding="utf-8")
    text = text[: text.index("[published]")]
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    return Solution(loads(text, name="six-link"))


def unloaded(*lines: str) -> Solution:
    text = path_of("levers/six-link").read_text(encoding="utf-8")
    start, end = text.index("[dynamics] #"), text.index("[scales]")
    rest = text[end : text.index("[published]")]
    return Solution(loads(text[:start] + "\n".join(lines) + "\n" + rest, name="six-link"))


@pytest.mark.parametrize("lang", LANGUAGES)
def test_a_driver_at_rest_has_no_lever(lang: str) -> None:
    text = protocol(six_link(("omega = -20", "omega = 0"), ("epsilon = 80", "")), lang=lang)
    said = {"ru": "рычаг не строится", "en": "the Zhukovsky lever cannot be drawn"}
    assert said[lang] in flat(text)
    assert "ΣM_p" not in text


def test_without_any_load_there_is_no_plan() -> None:
    text = flat(protocol(unloaded("[dynamics]", "gravity = false")))
    assert text.count("Все силы равны нулю, план сил не строим") == 3
    assert "Нагрузок, совершающих работу, нет: M_1д = 0." in text
    assert "откладываем" not in text.partition("Силовой расчёт")[2]


def test_a_couple_alone_is_carried_by_reactions_along_one_line() -> None:
    text = flat(protocol(unloaded("[dynamics]", "[[loads]]", 'link = "2"', "couple = 50.0")))
    assert "M₂ = 50,00 Н·м, направлен против часовой стрелки." in text
    assert "F^τ₂₁ = 50/0,3 = 166,7 Н" in text
    assert "Из уравнения равновесия звена 2 следует, что F₂₃ = −F₂₁." in text


@pytest.mark.parametrize(("force", "said"), [(6000, "навстречу"), (-6000, "по")])
def test_a_resistance_is_described_as_against_the_velocity(force: int, said: str) -> None:
    text = flat(
        protocol(
            six_link(("force = 6000 # Н\nangle = -90", f'force = {force}\nagainst = "velocity"'))
        )
    )
    assert f", {said} скорости v_H." in text


def test_a_load_at_rest_is_described_as_such() -> None:
    text = flat(protocol(six_link(("force = 6000", 'force = 6000\nphases = { moving = "down" }'))))
    assert "F_5C в этом положении не действует" in text


def test_a_reaction_below_the_ruler_is_not_laid_off() -> None:
    problem = worked("press/press").problem
    coarse = replace(problem, scales=replace(problem.scales, mu_F=5.0))
    for ruler in (10.0, 50.0, 100.0):
        text = flat(protocol(Solution(coarse, ruler=ruler)))
        assert ("отрезок короче половины деления линейки" in text) == (ruler > 50.0)
    assert "M_ур ≈ 0" in text


def by_rocker(phi: float) -> Solution:
    """Return a mechanism whose crank and rod are in one line at 90 degrees."""
    text = rocker(phi=phi, by_rocker=True)
    load = '[[loads]]\nlink = "1"\ncouple = 7\n'
    return Solution(loads(f'title = "Мёртвое положение"\n{text}{load}', name="rocker"))


def test_a_dead_position_is_rejected_as_by_solve() -> None:
    """No moment on the rocker holds a crank that is in one line with the rod."""
    assert "Рычаг Жуковского" in protocol(by_rocker(110.0))
    with pytest.raises(AssemblyError, match="dead position"):
        protocol(by_rocker(90.0))


def test_without_dynamics_there_are_no_forces() -> None:
    text = told("linkages/ex1", "ru")
    assert "Силовой расчёт" not in text
    assert "Реакции" not in text


def test_each_of_many_positions_has_its_own_forces() -> None:
    problem = worked("levers/task12").problem
    many = Solution(problem, positions=[245.0, 260.0])
    for index, phi in enumerate((245.0, 260.0)):
        exact = abs(complex(statics_of(many).reactions[0].force[index]))
        text = forces_of(protocol(many, position=index))
        symbol = statics_of(many).reactions[0]
        found = re.search(
            rf"{plain_text(reaction_symbol(symbol.on, symbol.by))} = [^;]*точно (\S+)\)", text
        )
        assert found is not None, phi
        assert number(found[1]) == pytest.approx(exact, rel=1e-3)


# One force of inertia -----------------------------------------------------------------------------


@pytest.mark.parametrize("lang", ["ru", "en"])
def test_a_shifted_force_of_inertia_is_described_at_its_point_of_action(lang: str) -> None:
    """The couple, the shift laid off on the drawing, the point of the lever; no pair on that."""
    solution = six_link(("[dynamics]", "[dynamics]\nresultant = true"))
    text = flat(protocol(solution, lang=lang))
    (shift,) = statics_of(solution).board.shifts.values()
    drawn = abs(float(statics_of(solution).ruler_reading.number(shift.length)[0]))
    laid = "откладываем {} мм от точки S2" if lang == "ru" else "{} mm are laid off from point S2"
    length = f"{drawn:.2f}"
    assert laid.format(length.replace(".", ",") if lang == "ru" else length) in text
    assert "h₂ = M_Φ2/Φ₂ = " in text and "T₂" in text and "(s₂t₂) = h₂·(bc)/l_BC = " in text
    assert "M_Φ2/l_BC" not in text  # no pair of forces on the lever


def test_masses_and_loads_are_given_as_the_file_has_them() -> None:
    text = path_of("levers/six-link").read_text("utf-8")
    text = text.replace("mass = 40\n", 'mass = "80/2"\n')
    text = text.replace("mass = 70\n", 'mass = "200/3"\n')
    text = text.replace("force = 6000", 'force = "3*2000"')
    said = flat(protocol(Solution(loads(text, name="x")), lang="ru")).replace("\u00a0", " ")
    # Arithmetic stays where no few digits are its value.
    assert "m₂ = 40 кг; m₃ = 200/3 кг; m₅ = 50 кг; J_S1 = 5 кг·м²;" in said
    assert "g = 9,81 м/с²; F_5C = 6000 Н (в точке" in said
