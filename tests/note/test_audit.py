"""Values printed in the sources against exact ones: selectors, verdicts, the document."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest
from click.testing import CliRunner
from doors import (
    WORDING_LANGUAGES as LANGUAGES,
    AuditDocument,
    Audited,
    AuditVerdict,
    KindProblem,
    NoValue,
    Published,
    audit,
    cli,
    count,
    get_language,
    half_digit,
    kind_of,
    source_scales,
)
from msgspec.structs import replace
from slotted import R, problem_of
from worked import OWN_TESTS, every_file, path_of

ROOT = Path(__file__).parents[2]
PROBLEMS = sorted([*every_file(), *map(path_of, OWN_TESTS)], key=str)
TABLES = sorted([*PROBLEMS, *(ROOT / "problems/gears").glob("*.toml")], key=str)


def test_a_millimetre_of_a_rate_and_of_an_angle() -> None:
    """One mm of pb3 over CB = 0.1414 m; one mm at D, 0.3 m from C."""
    items = audit(
        problem_of(
            'w = { value = 4.9, what = "omega 2" }',
            'e = { value = 11, what = "epsilon 3" }',
            'f = { value = 44, unit = "град", what = "phi 3" }',
            'given = { value = 10, what = "omega 1" }',
        )
    )
    assert [item.mm for item in items] == [
        pytest.approx(-0.1 * 0.2 * R / 0.02),
        pytest.approx(0.2 * R / 0.1),
        pytest.approx(-0.3 / 0.002 * 3.14159265 / 180),
        None,
    ]


# Verdicts --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("value", "half"),
    [(15.28, 0.005), (0.09, 0.005), (300.0, 0.5), (47.0, 0.5), (3.0, 0.05), (-435.0, 0.5)],
)
def test_half_of_the_last_printed_digit(value: float, half: float) -> None:
    assert half_digit(value) == pytest.approx(half)


@pytest.mark.parametrize(
    ("value", "exact", "per_mm", "verdict"),
    [
        (2.2, 2.24, None, AuditVerdict.AGREES),
        (2.2, 2.25, None, AuditVerdict.AGREES),  # a tie rounds either way
        (2.2, 2.26, None, AuditVerdict.DIFFERS),
        (2.2, 2.26, 0.1, AuditVerdict.DRAWN),
        (2.2, 2.24, 0.001, AuditVerdict.AGREES),  # right digits, whatever the plan
        (-2.2, -2.26, 0.1, AuditVerdict.DRAWN),
        (-2.2, 2.2, 0.05, AuditVerdict.DIFFERS),  # the sense is wrong
        (9.0, 10.01, 1.0, AuditVerdict.DIFFERS),
        (9.0, 10.0, 1.0, AuditVerdict.DRAWN),
        (9.0, None, 1.0, AuditVerdict.ABSENT),
    ],
)
def test_verdicts(
    value: float, exact: float | None, per_mm: float | None, verdict: AuditVerdict
) -> None:
    item = Audited(Published("v", value), exact=exact, per_mm=per_mm)
    assert item.verdict is verdict


def test_differences() -> None:
    item = Audited(Published("ω3", -15.0), exact=-16.0, per_mm=0.25)
    assert (item.difference, item.percent, item.mm) == (1.0, -6.25, 4.0)  # of a size too small
    assert Audited(Published("v", 0.3), exact=0.1 + 0.2).difference == 0.0
    assert Audited(Published("v", 0.3), exact=0.0).percent is None
    absent = Audited(Published("v", 0.3), per_mm=1.0)
    assert (absent.difference, absent.percent, absent.mm) == (None, None, None)


def test_a_printed_zero_agrees_with_one_that_is_not_exact() -> None:
    """A percentage of 1e-17 m/s means nothing."""
    one = Audited(Published("v", 0.0), exact=1e-17, per_mm=0.02)
    assert (one.difference, one.percent, one.verdict) == (0.0, None, AuditVerdict.AGREES)
    assert Audited(Published("v", 0.0), exact=0.1, per_mm=0.02).percent == -100.0


def test_an_angle_may_be_printed_with_whole_turns() -> None:
    (item,) = audit(problem_of('f = { value = -315, unit = "град", what = "phi 3" }'))
    assert item.verdict is AuditVerdict.AGREES
    assert item.difference == pytest.approx(0.0, abs=1e-9)


def test_positions_count_from_zero() -> None:
    first, second, nowhere = audit(
        problem_of(
            'a = { value = 0.1, what = "x B", position = 0 }',
            'b = { value = 0.0, what = "x B", position = 1 }',
            'c = { value = 0.1, what = "x B" }',
            phi="[0, 90]",
        )
    )
    assert first.exact == pytest.approx(0.1)
    assert second.exact == pytest.approx(0.0, abs=1e-12)
    assert (nowhere.reason, nowhere.verdict) == (NoValue.NO_POSITION, AuditVerdict.ABSENT)


def test_a_position_that_the_problem_does_not_have_is_reported() -> None:
    problem = problem_of('a = { value = 0.1, what = "x B" }')
    late = replace(problem, published=(replace(problem.published[0], position=7),))
    (item,) = audit(late)
    assert item.reason is NoValue.NO_POSITION
    said = get_language("en").audit["whys"][NoValue.NO_POSITION.value]
    assert said in AuditDocument("en", 0.5).markdown([(late, [item])])


def test_a_value_without_a_quantity_is_listed_with_its_note() -> None:
    problem = problem_of('a = { value = 0.1, note = "вторая передаточная функция" }')
    (item,) = audit(problem)
    assert item.reason is NoValue.NO_QUANTITY
    text = AuditDocument("en", 0.5).markdown([(problem, [item])])
    assert "not computed | вторая передаточная функция |" in text


# Scales ----------------------------------------------------------------------------------------


def test_scales_are_found_from_the_printed_values_if_the_file_has_none() -> None:
    entries = (
        'l = { value = 0.1, unit = "м", per_mm = 0.004 }',
        'v = { value = 0.7, unit = "м/с", per_mm = 0.02, what = "v B3" }',
        'b = { value = 25, unit = "мм", per_mm = 1, what = "length A B" }',
        'q = { value = 35, unit = "мм", per_mm = 1, what = "segment velocity p B3" }',
        'c = { value = 25, unit = "мм", per_mm = 1, what = "segment acceleration p B" }',
    )
    problem = problem_of(*entries, scales="")
    scales = source_scales(problem)
    assert (scales.mu_l, scales.mu_v, scales.mu_a) == (0.004, 0.02, None)
    _, v, b, q, c = audit(problem)
    assert v.read == pytest.approx(0.71)
    assert b.exact == pytest.approx(25.0)
    assert q.exact == pytest.approx(50 * R)
    assert c.reason is NoValue.NO_SCALE
    given = source_scales(problem_of(*entries, scales="[scales]\nmu_l = 0.002\n"))
    assert (given.mu_l, given.mu_v) == (0.002, 0.02)


def test_the_requested_ruler_is_used() -> None:
    entry = 'v = { value = 0.7, unit = "м/с", per_mm = 0.02, what = "v B3" }'
    assert audit(problem_of(entry), ruler=5.0)[0].read == pytest.approx(0.7)


def test_a_problem_without_printed_values() -> None:
    assert audit(problem_of()) == []


# The sources -----------------------------------------------------------------------------------


@cache
def audited(stem: str) -> dict[str, Audited]:
    path = next(path for path in PROBLEMS if path.stem == stem)
    return {item.published.name: item for item in audited_file(path)[1]}


@cache
def audits() -> tuple[tuple[KindProblem, list[Audited]], ...]:
    return tuple(map(audited_file, TABLES))


def audited_file(path: Path) -> tuple[KindProblem, list[Audited]]:
    kind = kind_of(path)
    problem = kind.load(path, None)
    return problem, kind.audited(problem, 0.5)


@pytest.mark.parametrize(
    ("stem", "name", "reason"),
    [
        ("ex3", "pb3 (план скоростей)", "должно быть 44 мм"),
        ("ex1", "bc (план ускорений)", "только касательная часть"),
        ("six-link", "v_H", "неточного чертежа"),
        ("six-link", "ε2", "неточного чертежа"),
        ("six-link", "a_C", "неточного чертежа"),
        ("six-link", "ε3", "неточного чертежа"),
        ("six-link", "a_H = a_S5", "неточного чертежа"),
        ("task12", "p'd' (план ускорений)", "82,08"),
        ("six-link", "l_CL в (2.12)", "38 мм"),
        ("six-link", "h_G2", "CS2 = 25 мм"),
        ("six-link", "F36", "с плечом 54 мм"),
        ("six-link", "M1д", "из-за плеча"),
        ("six-link", "G1", "g = 9,8"),
        ("task12", "M1", "F12 = 2116,7"),
        ("task12", "Φ5", "10,1·30 = 303"),
        ("task12", "F10", "2475"),
        ("press", "G3", "147,15"),
        ("press", "R65", "от камня"),
        ("press", "R63", "ни с шатуном, ни с камнем"),
        ("press", "R16", "направлена наоборот"),
        ("press-stone", "R63", "ни с камнем, ни с шатуном"),
    ],
)
def test_errors_of_the_sources_differ(stem: str, name: str, reason: str) -> None:
    item = audited(stem)[name]
    assert item.verdict is AuditVerdict.DIFFERS
    assert reason in item.published.note


@pytest.mark.parametrize(
    ("stem", "name", "reason"),
    [
        ("ex3", "v_B3", "0,05·40 = 2,0"),
        ("ex3", "aⁿ_ED", "в формуле стоит ω3"),
        ("task12", "ε3 (таблица)", "на листе ЭВМ -40,6825"),
        ("task12", "a_F (таблица)", "63,2/8 = 7,90"),
        ("press", "a_A3", "меньше собственной касательной части"),
    ],
)
def test_slips_smaller_than_drafting_errors_are_in_the_remark(
    stem: str, name: str, reason: str
) -> None:
    """The text is wrong, but the number is as near as a drawing gives: it cannot be blamed."""
    item = audited(stem)[name]
    assert item.verdict in (AuditVerdict.AGREES, AuditVerdict.DRAWN)
    assert item.mm is not None
    assert abs(item.mm) < 1.0
    assert reason in item.published.note


def test_size_of_the_six_links_errors() -> None:
    """The drawing of the source was off where the mechanism is sensitive."""
    expected = {"v_H": 38, "ε2": -20, "a_C": -10, "ε3": -11, "a_H = a_S5": -10}
    for name, percent in expected.items():
        found = audited("six-link")[name].percent
        assert found is not None
        assert round(found) == percent, name


def test_size_of_the_errors_of_the_wrong_arm() -> None:
    """An arm of 54 mm for 38: the pressure of the rocker doubles, the driving moment vanishes."""
    expected = {"F36": 146, "F32 = F23": 145, "M1д": -80}
    for name, percent in expected.items():
        found = audited("six-link")[name].percent
        assert found is not None
        assert round(found) == percent, name


def test_the_force_plan_of_the_press_is_that_of_the_sliding_block() -> None:
    for name in ("R54", "R65", "плечо F34"):
        assert audited("press")[name].verdict is AuditVerdict.DIFFERS
        assert audited("press-stone")[name].verdict is not AuditVerdict.DIFFERS


def test_diagrams_of_the_press_have_the_scales_of_its_lengths() -> None:
    """T/288 s/mm; then 0.002 m/mm over it and the pole of 36 mm, twice."""
    found = {item.published.what: item for item in audited("press-turn").values()}
    mu_t = 60 / 130 / 288
    mu_v = 0.002 / (mu_t * 36)
    scales = {"mu_t": mu_t, "mu_s": 0.002, "mu_v": mu_v, "mu_a": mu_v / (mu_t * 36), "length": 288}
    for name, value in scales.items():
        item = found[f"diagram {name}"]
        assert item.exact == pytest.approx(value, rel=1e-9), name
        assert item.verdict is AuditVerdict.AGREES


def test_the_angle_of_the_synthesis_is_audited() -> None:
    """180°·(K - 1)/(K + 1) of K = 1.22."""
    (theta,) = (one for one in audited("press").values() if one.published.what == "synthesis theta")
    assert theta.exact == pytest.approx(180 * 0.22 / 2.22)
    assert theta.verdict is AuditVerdict.AGREES
    (none,) = audit(problem_of('t = { value = 1, what = "synthesis theta" }'))
    assert none.reason is NoValue.NO_SYNTHESIS


def test_diagrams_have_no_scales_without_motion() -> None:
    problem = problem_of('k = { value = 1, what = "diagram mu_v" }')
    (still,) = audit(replace(problem, drive=replace(problem.drive, rate=0.0)))
    assert still.reason is NoValue.NO_RATE


@pytest.mark.parametrize("path", PROBLEMS, ids=lambda path: path.stem)
def test_every_difference_has_a_reason(path: Path) -> None:
    for item in audited(path.stem).values():
        if item.verdict in (AuditVerdict.DIFFERS, AuditVerdict.ABSENT):
            assert item.published.note, item.published.name


def test_all_values_with_a_selector_are_computed() -> None:
    for problem, items in audits():
        for item in items:
            assert (item.exact is None) == (not item.published.what), (problem.name, item)


# The document ----------------------------------------------------------------------------------


def test_the_committed_table_is_up_to_date() -> None:
    committed = (ROOT / "benchmarks/reports/published.md").read_text(encoding="utf-8")
    head, _, page = committed.partition("\n\n")
    assert head == "<!-- generated by make tables -->"
    assert AuditDocument("en", 0.5).markdown(audits()) == page, "run: make tables"


def test_the_counts_add_up() -> None:
    for problem, items in audits():
        assert sum(count(items).values()) == len(items) == len(problem.published)


def test_every_row_has_every_cell() -> None:
    for lang in LANGUAGES:
        says = get_language(lang).audit
        text = AuditDocument(lang, 0.5).markdown(audits())
        for block in text.split("\n\n"):
            rows = [line for line in block.splitlines() if line.startswith("| ")]
            assert len({row.replace("\\|", "").count("|") for row in rows}) <= 1
        assert f"| {' | '.join(says.columns)} |" in text
        assert "| −0.00 |" not in text
        assert "| −0,00 |" not in text


def test_russian_numbers_and_words() -> None:
    problem = problem_of('v = { value = 0.8, unit = "м/с", per_mm = 0.02, what = "v B3" }')
    text = AuditDocument("ru", 0.5).markdown([(problem, audit(problem))])
    assert "| v | м/с | 0,8 | 0,70711 | 0,71000 | 0,093 | 13,14 | 4,64 | **расходится** |" in text
    assert "расходится 1" in text


def test_signs_of_markdown_in_names_and_notes_are_only_signs() -> None:
    problem = problem_of('"a|b*c" = { value = 1, what = "v B", note = "<b> | x |" }')
    text = AuditDocument("en", 0.5).markdown([(problem, audit(problem))])
    assert r"| a\|b\*c |" in text
    assert r"\<b\> \| x \| |" in text


def test_the_command_writes_the_document(tmp_path: Path) -> None:
    target = tmp_path / "published.md"
    arguments = ["audit", "--lang", "en", "-o", str(target), *map(str, TABLES)]
    result = CliRunner().invoke(cli, arguments)
    assert result.exit_code == 0, result.output
    assert target.read_text(encoding="utf-8") == AuditDocument("en", 0.5).markdown(audits())


@pytest.mark.usefixtures("russian")
def test_the_command_prints_by_default_in_russian() -> None:
    path = next(path for path in PROBLEMS if path.stem == "ex1")
    result = CliRunner().invoke(cli, ["audit", str(path), "--ruler", "1"])
    assert result.exit_code == 0
    assert result.stdout.startswith(f"# {get_language('ru').audit.title}")
    assert "ценой деления 1 мм" in result.stdout


def test_no_audit_is_written_for_a_faulty_problem(tmp_path: Path) -> None:
    faulty, target = tmp_path / "faulty.toml", tmp_path / "published.md"
    faulty.write_text('title = "x"\n', encoding="utf-8")
    result = CliRunner().invoke(cli, ["audit", str(PROBLEMS[0]), str(faulty), "-o", str(target)])
    assert result.exit_code == 3
    assert not target.exists()


def test_the_command_does_not_write_over_a_problem_file() -> None:
    result = CliRunner().invoke(cli, ["audit", str(PROBLEMS[0]), "-o", str(PROBLEMS[1])])
    assert result.exit_code == 2
