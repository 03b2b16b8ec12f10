"""Sheet of the structural analysis: its texts, and no overlaps."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterator
from functools import cache
from itertools import combinations
from pathlib import Path

import pytest
from cases import thinned
from doors import (
    SIZES,
    STAMP,
    Arc,
    Bar,
    Drawing,
    Drive,
    FrameFormat as Format,
    JointEnd,
    LayoutError,
    Mechanism,
    Mobile,
    ModelProblem as Problem,
    Pen,
    Picture,
    Prismatic,
    Revolute,
    SchemeArea,
    SchemeGraph,
    Stroke,
    Structure,
    Text,
    analyse,
    driver_chain,
    driver_picture,
    embed,
    frame_paper_format as paper_format,
    get_language,
    group_caption,
    group_chain,
    group_picture,
    lint,
    mechanism_chain,
    mechanism_picture,
    mobility_formulas,
    pair_letters,
    problem_load as load,
    self_aligning,
    structure_sheet,
    textbook_places,
)

RU = get_language("ru")

PROBLEMS = Path(__file__).parents[2] / "problems"

R, P = Revolute, Prismatic

WORKED = {
    path.stem: path
    for path in sorted(PROBLEMS.rglob("*.toml"))
    if path.stem in ("ex1", "ex2", "ex3", "six-link", "task12", "press")
}

MADE = {
    "triad of class III": Mechanism(
        ("1", "2", "3", "4", "5"),
        (
            R("A", ("0", "1")),
            R("B", ("1", "2")),
            R("C", ("2", "3")),
            R("D", ("3", "4")),
            R("E", ("0", "4")),
            R("F", ("3", "5")),
            R("G", ("0", "5")),
        ),
        (),
        "1",
    ),
    "triad with a slider": Mechanism(
        ("1", "2", "3", "4", "5"),
        (
            R("A", ("0", "1")),
            R("B", ("1", "2")),
            R("C", ("2", "3")),
            R("D", ("3", "4")),
            R("E", ("0", "4")),
            R("F", ("3", "5")),
        ),
        (P("5", "0", "F"),),
        "1",
    ),
    "group of class IV": Mechanism(
        ("1", "2", "3", "4", "5"),
        (
            R("A", ("0", "1")),
            R("B", ("1", "2")),
            R("C", ("2", "3")),
            R("D", ("2", "4")),
            R("E", ("3", "5")),
            R("F", ("4", "5")),
            R("G", ("0", "5")),
        ),
        (),
        "1",
    ),
    "hinge of three links": Mechanism(
        ("1", "2", "3", "4", "5"),
        (
            R("A", ("0", "1")),
            R("D", ("0", "3")),
            R("B", ("1", "2")),
            R("C", ("2", "3", "4")),
            R("E", ("4", "5")),
        ),
        (P("5", "0", "E"),),
        "1",
    ),
    "four groups": Mechanism(
        ("1", "2", "3", "4", "5", "6", "7", "8", "9"),
        (
            R("O1", ("0", "1")),
            R("O3", ("0", "3")),
            R("O5", ("0", "5")),
            R("O7", ("0", "7")),
            R("A", ("1", "2")),
            R("B", ("2", "3")),
            R("C", ("3", "4")),
            R("D", ("4", "5")),
            R("E", ("5", "6")),
            R("F", ("6", "7")),
            R("G", ("7", "8")),
            R("K", ("8", "9")),
        ),
        (P("9", "0", "K"),),
        "1",
    ),
    "driving slider": Mechanism(
        ("1", "2", "3"),
        (R("A", ("1", "2")), R("B", ("2", "3")), R("C", ("0", "3"))),
        (P("1", "0", "A"),),
        "1",
    ),
    "rod through a swinging block": Mechanism(
        ("1", "2", "3"),
        (R("A", ("0", "1")), R("B", ("1", "2")), R("C", ("0", "3"))),
        (P("2", "3", "B"),),
        "1",
    ),
    "link of two sliding pairs": Mechanism(
        ("1", "2", "3"),
        (R("A", ("0", "1")), R("B", ("0", "3"))),
        (P("2", "1", "M"), P("2", "3", "M")),
        "1",
    ),
    "stone between stones": Mechanism(
        # The place of D follows from that of B: both sliding blocks are on bars.
        ("1", "2", "3", "4", "5"),
        (
            R("A", ("0", "1")),
            R("C", ("0", "3")),
            R("B", ("1", "2")),
            R("D", ("3", "4")),
            R("E", ("0", "5")),
        ),
        (P("2", "3", "B"), P("4", "5", "D")),
        "1",
    ),
}


def _problem(mechanism: Mechanism, rate: float = 10.0) -> Problem:
    drive = Drive(mechanism.driver, "A", (0.0,), rate, 0.0)
    return Problem(
        name="made", title="Механизм", mechanism=mechanism, bodies={}, slides={}, drive=drive
    )


def _case(name: str) -> tuple[Problem, Structure]:
    problem = load(WORKED[name]) if name in WORKED else _problem(MADE[name])
    return problem, analyse(problem.mechanism)


def _format(drawing: Drawing) -> Format:
    return next(
        fmt
        for fmt in map(paper_format, ("A3", "A2", "A1"))
        if (fmt.width, fmt.height) == (drawing.width, drawing.height)
    )


def _writings(items: list[Text]) -> list[str]:
    runs: dict[str, str] = defaultdict(str)
    for item in items:
        runs[item.label] += item.text
    return list(runs.values())


def _texts(drawing: Drawing, *, stamp: bool = False) -> list[str]:
    texts = [item for item in drawing.items if isinstance(item, Text)]
    return _writings([text for text in texts if (STAMP in text.tag) == stamp])


CASES = [*WORKED, *MADE]


@cache
def drawn(name: str) -> Drawing:
    return structure_sheet(*_case(name))


@pytest.mark.parametrize("name", CASES)
def test_no_items_overlap(name: str) -> None:
    drawing = drawn(name)
    assert lint(drawing.items, _format(drawing).inner) == []


def test_all_worked_examples_are_there() -> None:
    assert len(WORKED) == 6


@pytest.mark.parametrize("name", CASES)
def test_lines_stay_inside_the_frame_and_off_the_title_block(name: str) -> None:
    drawing = drawn(name)
    fmt = _format(drawing)
    x0, y0, x1, y1 = fmt.inner
    for item in drawing.items:
        if isinstance(item, Stroke) and item.tag not in (STAMP, "edge", "frame"):
            for z in item.points:
                assert x0 < z.real < x1
                assert y0 < z.imag < y1
                assert not (z.real > fmt.stamp[0] and z.imag < fmt.stamp[3])


@pytest.mark.parametrize("name", [*WORKED, "group of class IV", "hinge of three links"])
def test_six_links_fit_an_a3(name: str) -> None:
    assert _format(drawn(name)).name == "A3"


def test_larger_mechanisms_take_a_larger_sheet() -> None:
    """A triad has three arms, in its own row of groups and in the self-aligning one."""
    assert _format(drawn("triad of class III")).name == "A2"
    assert _format(drawn("four groups")).name == "A1"


def test_requested_format() -> None:
    problem, structure = _case("ex1")
    assert structure_sheet(problem, structure, paper="А2").width == 594
    with pytest.raises(LayoutError, match=r"4 groups does not fit A3. Use --paper A2"):
        structure_sheet(*_case("four groups"), paper="A3")


def test_title_block() -> None:
    problem, structure = _case("ex3")
    drawing = structure_sheet(problem, structure, fields={"author": "Сидоров"})
    told = " ".join(_texts(drawing, stamp=True))
    assert RU.structure.title in " ".join(told.split())
    assert "Сидоров" in told
    assert problem.stamp["designation"] in told
    assert drawing.title == RU.structure.title
    other = structure_sheet(problem, structure, fields={"title": "Лист 1"})
    assert other.title == "Лист 1"


@pytest.mark.parametrize("name", thinned(CASES, 3))
def test_the_same_every_time(name: str) -> None:
    assert drawn(name).items == structure_sheet(*_case(name)).items


def test_texts_of_ex3() -> None:
    problem, structure = _case("ex3")
    told = _texts(structure_sheet(problem, structure))
    whole = " ".join(told).replace("\u00a0", " ")
    for part in (
        "2-го порядка, 3-го вида (ВПВ): звенья 2, 3",
        "2-го порядка, 2-го вида (ВВП): звенья 4, 5",
        "Структурная формула: I(0,1) → II(2,3) → II(4,5)",
        "Порядок силового расчёта: II(4,5) → II(2,3) → I(0,1)",
        "Класс механизма: II",
        "кулиса",
    ):
        assert part in whole
    assert told.count("поступательная") == 2
    assert told.count("вращательная") == 5
    assert told.count("W = 3·2 − 2·3 = 0") == 2
    assert told.count("q = 0 − (6·2 − 5·3) = 3") == 2


def test_formulas_of_ex3() -> None:
    problem, structure = _case("ex3")
    lines = list(mobility_formulas(problem.mechanism, structure, RU))
    assert lines[1] == "По Чебышеву: W = 3n − 2p_{н} − p_{в} = 3·5 − 2·7 − 0 = 1"
    spatial = "6n − 5p_{1} − 4p_{2} − 3p_{3} − 2p_{4} − p_{5} = 6·5 − 5·7 = −5"
    assert lines[2] == f"Пространственная схема: W_{{пр}} = {spatial}"
    assert lines[3] == "Избыточные связи: q = W_{0} + W_{м} − W_{пр} = 1 + 0 − (−5) = 6"


def test_caption_of_a_class_three_group() -> None:
    _, structure = _case("triad of class III")
    named, w, q = (line.replace("\u00a0", " ") for line in group_caption(structure.groups[0], RU))
    assert named == "Группа III класса, 3-го порядка (трёхповодковая): звенья 2, 3, 4, 5"
    assert w == "W = 3·4 − 2·6 = 0"
    assert q == "q = 0 − (6·4 − 5·6) = 6"


PRINTED = {"1v": "1в", "2c": "2ц", "3s": "3с", "1p": "1п", "3pl": "3пл"}


@pytest.mark.parametrize("name", CASES)
def test_the_second_scheme_marks_every_pair_that_is_changed_and_no_other(name: str) -> None:
    problem, structure = _case(name)
    aligned = self_aligning(problem, structure)
    mobile = Mobile.of(aligned, PRINTED)
    plain, picture = (
        mechanism_picture(problem.mechanism, structure, SchemeArea(240.0, 130.0), mobile=one)
        for one in (None, mobile)
    )
    marks = re.findall(r"\d(?:с|ц|пл|п|в)", " ".join(_writings(list(_letters(picture)))))
    changed = [PRINTED[one] for one in aligned.schemes[0].values() if one[0] != "1"]
    assert sorted(marks) == sorted(changed)
    assert not re.search(r"\dц", " ".join(_writings(list(_letters(plain)))))
    spheres = sum(one == "3s" for one in aligned.schemes[0].values())
    cups = [i for i in picture.items if isinstance(i, Arc) and i.radius == 1.75 * SIZES.joint / 2]
    assert len(cups) == spheres


@pytest.mark.parametrize("name", CASES)
def test_every_group_has_its_marks_and_its_own_sum_without_redundant_constraints(name: str) -> None:
    problem, structure = _case(name)
    aligned = self_aligning(problem, structure)
    mobile, told = Mobile.of(aligned, PRINTED), " ".join(_texts(drawn(name))).replace("\u00a0", " ")
    for one in aligned.groups:
        picture = group_picture(
            problem.mechanism, one.group, SchemeArea(110.0, 80.0), mobile=mobile.of_group(one)
        )
        marks = re.findall(r"\d(?:с|ц|пл|п|в)", " ".join(_writings(list(_letters(picture)))))
        classes = [aligned.schemes[0][pair.key] for pair in one.pairs]
        assert sorted(marks) == sorted(PRINTED[c] for c in classes if c[0] != "1")
        n, held = len(one.links), [6 - int(c[0]) for c in classes]
        assert sum(held) == 6 * n
        terms = "".join(f" − {k}·{held.count(k)}" for k in (5, 4, 3) if k in held)
        assert f"6·{n}{terms} = 0" in told
    assert told.count("q = 0 + 0 − 0 = 0") == len(aligned.groups)


def _letters(picture: Picture) -> Iterator[Text]:
    return (item for item in picture.items if isinstance(item, Text))


def test_the_sheet_has_both_schemes_and_the_replacement_of_the_pairs() -> None:
    told = _texts(drawn("six-link"))
    assert "Схема без избыточных связей" in told
    assert [text for text in told if text in PRINTED.values()] == [
        "1в", "1в", "2ц", "3с", "1в", "2ц", "3пл",
    ]  # fmt: skip
    assert "При q = 0" in " ".join(told).replace("\u00a0", " ")


@pytest.mark.parametrize("name", CASES)
def test_scheme_names_every_joint_and_link(name: str) -> None:
    problem, structure = _case(name)
    picture = mechanism_picture(problem.mechanism, structure, SchemeArea(200, 120))
    told = _writings([item for item in picture.items if isinstance(item, Text)])
    for joint in problem.mechanism.revolutes:
        assert pair_letters(joint.point).replace("_{", "").replace("}", "") in told
    for link in problem.mechanism.links:
        assert told.count(link) == 1
    frame_joints = [j for j in problem.mechanism.revolutes if "0" in j.links]
    slides = [s for s in problem.mechanism.prismatics if "0" in (s.slider, s.host)]
    assert told.count(problem.mechanism.frame) == len(frame_joints) + len(slides)


@pytest.mark.parametrize("name", CASES)
def test_bars_of_the_scheme_do_not_cross(name: str) -> None:
    problem, structure = _case(name)
    net = mechanism_chain(problem.mechanism, structure).graph
    at = embed(net)
    for one, two in combinations(net.bars, 2):
        if not {one.start, one.end} & {two.start, two.end}:
            assert not _cross(at[one.start], at[one.end], at[two.start], at[two.end])
    for name_ in net.low:
        assert at[name_].imag == 0


def _cross(a: complex, b: complex, c: complex, d: complex) -> bool:
    def turn(p: complex, q: complex, r: complex) -> float:
        return ((q - p).conjugate() * (r - p)).imag

    return turn(a, b, c) * turn(a, b, d) < 0 and turn(c, d, a) * turn(c, d, b) < 0


def test_open_joints_of_a_group_name_the_neighbours() -> None:
    problem, structure = _case("ex3")
    picture = group_picture(problem.mechanism, structure.groups[0], SchemeArea(70, 60))
    told = _writings([item for item in picture.items if isinstance(item, Text)])
    assert sorted(told) == ["(0)", "(1)", "2", "3", "B", "C"]
    dashed = [i for i in picture.items if isinstance(i, Stroke) and i.pen is Pen.HIDDEN]
    assert len(dashed) == 2


def test_the_driver_is_on_the_frame() -> None:
    mechanism = MADE["driving slider"]
    chain = driver_chain(mechanism, mechanism.driver)
    assert [slide.joint_end for slide in chain.slides] == [JointEnd.FRAME]
    picture = driver_picture(mechanism, mechanism.driver, SchemeArea(60, 60))
    assert "v1" in _writings([i for i in picture.items if isinstance(i, Text)])
    crank = driver_chain(MADE["triad of class III"], "1")
    assert [(pin.node, pin.joint_end) for pin in crank.pins] == [("A", JointEnd.FRAME)]


def test_hinge_of_three_links_is_a_double_joint() -> None:
    problem, structure = _case("hinge of three links")
    chain = mechanism_chain(problem.mechanism, structure)
    assert {pin.node: pin.count for pin in chain.pins}["C"] == 2
    picture = mechanism_picture(problem.mechanism, structure, SchemeArea(200, 120))
    rings = [i for i in picture.items if isinstance(i, Arc) and i.pen is Pen.THIN]
    assert sum(abs(ring.radius - 2.8) < 1e-9 for ring in rings) == 1
    first, second = structure.groups
    assert {p.node: p.count for p in group_chain(problem.mechanism, first).pins}["C"] == 1
    assert {p.node: p.joint_end for p in group_chain(problem.mechanism, second).pins}[
        "C"
    ] is JointEnd.OPEN


@pytest.mark.parametrize("name", WORKED)
def test_dyads_are_placed_as_in_the_textbook(name: str) -> None:
    problem, structure = _case(name)
    for group in structure.groups:
        chain = group_chain(problem.mechanism, group)
        at = textbook_places(chain)
        assert at is not None
        assert set(at) == {*chain.graph.nodes, *chain.graph.between}


def test_class_three_triad_is_a_base_with_three_leads() -> None:
    problem, structure = _case("triad of class III")
    chain = group_chain(problem.mechanism, structure.groups[0])
    at = textbook_places(chain)
    assert at is not None
    base = next(shape for shape in chain.shapes if len(shape.outline) == 3)
    opened = [pin.node for pin in chain.pins if pin.joint_end is JointEnd.OPEN]
    assert max(abs(at[node]) for node in base.outline) < min(abs(at[node]) for node in opened)


def test_sense_of_the_driver() -> None:
    mechanism = MADE["triad of class III"]
    structure = analyse(mechanism)
    one = structure_sheet(_problem(mechanism, 5.0), structure)
    other = structure_sheet(_problem(mechanism, -5.0), structure)
    assert one.items != other.items


def test_letters_of_points_with_numbers() -> None:
    assert pair_letters("O1") == "O_{1}"
    assert pair_letters("B") == "B"
    assert pair_letters("O1(0,3)") == "O_{1}(0,3)"


def test_embedding_of_one_node() -> None:
    net = SchemeGraph(("A",), frozenset("A"), {"B": ("A", "A", 0.5)}, (Bar("1", "A", "B"),))
    assert embed(net) == {"A": 0j, "B": 0j}


@pytest.mark.parametrize("name", WORKED)
def test_the_scheme_wishes_the_driver_first_and_each_group_behind_the_one_before(name: str) -> None:
    problem, structure = _case(name)
    chain = mechanism_chain(problem.mechanism, structure)
    found = []
    for links in ((problem.mechanism.driver,), *(group.links for group in structure.groups)):
        own = [pin.node for pin in chain.pins if pin.links and {*pin.links} <= {*links}]
        found.append({chain.graph.wish[node] for node in own})
    places = [place for (place,) in filter(None, found)]
    assert len(places) > 1 and places == sorted({*places})
