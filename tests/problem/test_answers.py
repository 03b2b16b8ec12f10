"""``[[answers]]``: reading, the names of ``--ask``, and every fault."""

from __future__ import annotations

import json
import math
import re
import tomllib
from pathlib import Path

import pytest
from doors import (
    AnswerForm,
    AnswerScope,
    DirectionMode,
    ProblemError,
    ProblemProblem as Problem,
    QuantityValues,
    QuestionSpec,
    Solution,
    parse_quantity,
    problem_load as load,
    problem_loads as loads,
    quantities_for,
    quantities_of,
)
from mechanisms import CRANK, LOADED, SLIDER, messages
from worked import PROBLEMS, every_file

ALL = every_file()
SLOTTED = (PROBLEMS / "linkages" / "ex3.toml").read_text("utf-8").partition("[[answers]]")[0]


def read(
    *answers: str, base: str = CRANK, variants: str = "", variant: str | None = None
) -> Problem:
    text = "".join(f"[[answers]]\n{answer}\n" for answer in answers)
    return loads(base + text + variants, name="asked", variant=variant)


def test_every_key_is_read_and_the_order_is_that_of_the_file() -> None:
    problem = read(
        'what = "v C"\nid = "vc"\nletters = ["v_C", "V C ", "v_C"]\nunit = "м/с"\npoints = 2.5\n'
        'form = "mm"\nsense = true\nposition = 3\ndigits = 3\nsegment = "p c"\ntolerance = 5',
        'what = "omega_2"\nletters = "ω₂"',
    )
    assert problem.answers == (
        QuestionSpec(
            "vc",
            "v C",
            letters=("v_C", "V C"),
            unit="м/с",
            points=2.5,
            form=AnswerForm.MM,
            sense=DirectionMode.DIRECTION,
            position=3,
            digits=3,
            segment="p-c",
            tolerance=0.05,
        ),
        QuestionSpec("omega_2", "omega 2", letters=("ω₂",)),
    )


def test_a_file_without_answers_requires_none_of_its_own() -> None:
    assert read().answers == ()


@pytest.mark.parametrize(
    ("what", "id_", "words"),
    [
        ("v B3", "v_B3", "v B3"),
        ("v_B3", "v_B3", "v B3"),
        ("  v   B3 ", "v_B3", "v B3"),
        ("vs B3 B", "vs_B3_B", "vs B3 B"),
        ("v_B3/2", "v_B3/2", "vs B3 B"),
        ("v_B2/3", "v_B2/3", "vs B3 B"),
        ("ak_B3/2", "ak_B3/2", "ak B3 B"),
        ("ar_B3/2", "ar_B3/2", "ar B3 B"),
        ("v_E5/0", "v_E5/0", "v E"),
        ("ar_E5/0", "ar_E5/0", "a E"),
        ("an_E_D", "an_E_D", "an E D"),
        ("epsilon_4", "epsilon_4", "epsilon 4"),
        ("segment velocity p B3", "segment_velocity_p_B3", "segment velocity p B3"),
        ("vx D / omega 1", "vx_D/omega_1", "vx D / omega 1"),
        ("v_D/omega_3", "v_D/omega_3", "v D / omega 3"),
        ("B3.vx", "B3.vx", "vx B3"),
        ("3.omega", "3.omega", "omega 3"),
    ],
)
def test_a_quantity_in_words_or_by_its_name(what: str, id_: str, words: str) -> None:
    (answer,) = read(f'what = "{what}"', base=SLOTTED).answers
    assert (answer.id, answer.what) == (id_, words)


def test_forces_by_their_names() -> None:
    names = ("F_B_2/1", "F_C_2/3", "M_C_3/0", "M_dr", "M_lever", "load_P", "weight_2")
    problem = read(*(f'what = "{name}"' for name in names), variants=LOADED)
    wanted = ("F 2 1", "F 2 3", "M 3 0", "balance", "lever", "load P", "weight 2")
    assert tuple(answer.what for answer in problem.answers) == wanted
    assert tuple(answer.id for answer in problem.answers) == names


@pytest.mark.parametrize("path", ALL, ids=lambda path: path.stem)
def test_every_spelling_means_the_same(path: Path) -> None:
    """Words and labels give the magnitude of the value, columns its components or its number."""
    solution = Solution(load(path))
    pairs = AnswerScope((), (), (), solution.problem.slides, None, None).pairs
    found, at = quantities_of(solution.construction, transfers=True), QuantityValues(solution)
    for quantity in found.all:
        on_the_frame = quantity.label.startswith("ak_") and quantity.label.endswith("/0")
        if quantity.size is None or on_the_frame:
            continue
        for text in (quantity.label, quantity.key.words, *quantity.columns):
            assert found.find(text) == [quantity], text
        words = {parse_quantity(text, pairs) for text in (quantity.label, quantity.key.words)}
        numbers = [at.exact(key) for key in words]
        parts = [at.exact(parse_quantity(text, pairs)) for text in quantity.columns]
        numbers += [math.hypot(*parts)]
        if quantity in solution.legend.values():
            numbers.append(float(solution.exact(quantity)[0]))
        first, *others = map(abs, numbers)
        assert others == pytest.approx([first] * len(others), rel=1e-9, abs=1e-9), quantity.label


@pytest.mark.parametrize("path", ALL, ids=lambda path: path.stem)
def test_every_force_can_be_required_by_its_name(path: Path) -> None:
    problem = load(path)
    if problem.dynamics is None:
        pytest.skip("no masses and no loads")
    found = quantities_for(Solution(problem), ["forces"])
    forces = [quantity for quantity in found.all if quantity.kind.is_force]
    labels = [quantity.label for quantity in forces]
    assert labels[-1] == ("M_lever" if problem.drive.balancing.turns else "F_lever")
    text = re.sub(r"(?ms)^answers = \[.*?^\]$", "", path.read_text("utf-8"))
    text = re.sub(r"(?ms)^\[\[answers\]\].*?(?=^\[|\Z)", "", text).partition("[variants")[0]
    asked = read(*(f'what = "{label}"' for label in labels), base=text).answers
    assert [answer.id for answer in asked] == labels
    at = QuantityValues(Solution(problem))
    for quantity, answer in zip(forces, asked, strict=True):
        spelled = (quantity.label, quantity.key.words, quantity.columns[-1], answer.what)
        assert all(found.find(text) == [quantity] for text in spelled)
        assert len({at.exact(parse_quantity(text)) for text in spelled}) == 1
        parts = [at.exact(parse_quantity(text)) for text in quantity.columns[:-1]]
        whole = abs(at.exact(quantity.key))
        assert not parts or math.hypot(*parts) == pytest.approx(whole, rel=1e-9, abs=1e-9)


def test_the_example_of_the_documentation_is_read() -> None:
    text = (PROBLEMS.parent / "docs" / "reference" / "problem-file.md").read_text("utf-8")
    (example,) = re.findall(r"```toml[^\n]*\n(answers = .*?)```", text, re.DOTALL)
    first, second, third = loads(example + SLOTTED, name="doc").answers
    assert (first.id, first.letters, first.points) == ("v_B3", ("v_B3", "VB₃"), 2.0)
    assert (second.what, second.sense, second.digits) == ("omega 3", DirectionMode.TURN, 3)
    assert (third.segment, third.form, third.tolerance) == ("d-n_ED", AnswerForm.MM, 0.1)


def test_an_answer_of_a_position_has_it_in_its_id() -> None:
    problem = read('what = "v C"', 'what = "v C"\nposition = 2')
    assert [(a.id, a.position) for a in problem.answers] == [("v_C", None), ("v_C@2", 2)]


@pytest.mark.parametrize(
    ("what", "sense", "wanted"),
    [
        ("omega 2", "true", DirectionMode.TURN),
        ("epsilon 2", '"turn"', DirectionMode.TURN),
        ("v C B", "true", DirectionMode.DIRECTION),
        ("a C", '"angle"', DirectionMode.ANGLE),
        ("phi 2", "false", None),
        ("F 2 1", "true", DirectionMode.DIRECTION),
        ("inertia couple 2", "true", DirectionMode.TURN),
        ("balance", "true", DirectionMode.TURN),
        ("lever B", "true", DirectionMode.DIRECTION),
    ],
)
def test_a_sense_is_required_only_if_the_quantity_has_one(
    what: str, sense: str, wanted: DirectionMode | None
) -> None:
    (answer,) = read(f'what = "{what}"\nsense = {sense}', variants=LOADED).answers
    assert answer.sense is wanted


def test_the_balance_of_a_driving_slider_is_a_force_with_a_direction() -> None:
    load_ = '[[loads]]\nlink = "2"\nat = "C"\nforce = 1\nangle = 0\n'
    (answer,) = read('what = "F_dr"\nsense = true', base=SLIDER, variants=load_).answers
    assert (answer.what, answer.sense) == ("balance", DirectionMode.DIRECTION)


def test_variants_change_one_key_or_require_other_answers() -> None:
    variants = (
        '[variants.a]\nanswers.0.points = 3\n"answers.w2.digits" = 2\nlinks.1.AB = 0.09\n'
        '[variants.b]\nanswers = [{ what = "a C" }]\n'
    )
    asked = ('what = "v C"', 'what = "omega 2"\nid = "w2"')
    first = read(*asked, variants=variants, variant="a").answers
    assert [(a.id, a.points, a.digits) for a in first] == [("v_C", 3.0, None), ("w2", 1.0, 2)]
    assert [a.what for a in read(*asked, variants=variants, variant="b").answers] == ["a C"]
    assert [a.points for a in read(*asked, variants=variants).answers] == [1.0, 1.0]


def test_a_variant_cannot_change_an_answer_that_is_not_required() -> None:
    with pytest.raises(ProblemError) as caught:
        read('what = "v C"', variants="[variants.a]\nanswers.0.point = 3\nanswers.4.points = 1\n")
    assert [str(fault) for fault in caught.value.faults] == [
        "variants.a.answers.0.point: the file has no 'answers.0.point' to override. Did you mean "
        "'answers.0.points'?",
        "variants.a.answers.4: the file has no 'answers.4' to override",
    ]


V = 'what = "v C"\n'
A = "[[answers]]\n"
FAULTS = {
    "a table": (
        "[answers]\nwhat = 'v C'\n",
        [
            "answers: expected tables [[answers]], got a table",
        ],
    ),
    "no what": (
        A + "points = 1\n",
        [
            'answers[0].what: missing. Name the quantity: what = "v B".',
        ],
    ),
    "unknown key": (
        A + "wat = 'v C'\n",
        [
            "answers[0].wat: unknown key. Did you mean 'what'?",
        ],
    ),
    "unknown quantity": (
        A + "what = 'w C'\n",
        [
            "answers[0].what: unknown quantity 'w' (the nearest is 'omega'). For example: "
            '"v C", "an C B", "omega 2", "F 2 1".',
        ],
    ),
    "unknown point": (
        A + "what = 'v_D'\n",
        [
            "answers[0].what: the mechanism has no 'D'. Points: A, B, C, S2.",
        ],
    ),
    "unknown link": (
        A + "what = 'omega 7'\n",
        [
            "answers[0].what: the mechanism has no '7'. Points: A, B, C, S2.",
        ],
    ),
    "look-alike": (
        A + "what = 'v В'\n",
        [
            "answers[0].what: 'v В' has the Cyrillic letter В (U+0412), expected the Latin "
            "letter 'B'. Type 'v B' in the Latin layout.",
        ],
    ),
    "place": (
        A + "what = 'C'\n",
        [
            "answers[0].what: 'C' is a position, which has two coordinates. Request x C, y C.",
        ],
    ),
    "coriolis of a guide": (
        A + "what = 'ak_C3/0'\n",
        [
            'answers[0].what: \'ak\' takes 2 names, got 1. For example: "v C", "an C B", '
            '"omega 2", "F 2 1".',
        ],
    ),
    "force without": (
        A + "what = 'F_B_2/1'\n",
        [
            "answers[0].what: 'F 2 1' belongs to the force analysis, but the file has no masses "
            "and no loads. Give [dynamics] or [[loads]].",
        ],
    ),
    "number": (
        A + "what = 3\n",
        [
            "answers[0].what: expected a string, got the integer 3. Put it in quotes.",
        ],
    ),
    "id twice": (
        A + V + A + V,
        [
            "answers[1]: answers[0] is also named 'v_C'. Give one of them an id of its own.",
        ],
    ),
    "ids": (
        A
        + V
        + "id = '=cmd'\n"
        + A
        + V
        + "id = 'mu_v'\n"
        + A
        + V
        + "id = 'v C'\n"
        + A
        + V
        + "id = 'v_С'\n",
        [
            "answers[0].id: expected the id of an answer, got the string '=cmd'. A letter "
            "first, then letters, digits and _ . / @ ' - without spaces: v_B3.",
            "answers[1].id: 'mu_v' is a reserved row in tables of answers. Choose another id.",
            "answers[2].id: expected the id of an answer, got the string 'v C'. A letter "
            "first, then letters, digits and _ . / @ ' - without spaces: v_B3.",
            "answers[3].id: 'v_С' has the Cyrillic letter С (U+0421), expected the Latin "
            "letter 'C'. Type 'v_C' in the Latin layout.",
        ],
    ),
    "letters twice": (
        A + V + "letters = 'V'\n" + A + "what = 'a C'\nletters = ['V']\n",
        [
            "answers[1].letters: 'V' also denotes answers[0]. "
            "Give each of them letters of its own.",
        ],
    ),
    "letters": (
        A + V + "letters = [1, ' ', 'V']\n",
        [
            "answers[0].letters[0]: expected a string, got the integer 1. Put it in quotes.",
            "answers[0].letters[1]: the text is empty. Omit it.",
        ],
    ),
    "letters a table": (
        A + V + "letters = {}\n",
        [
            "answers[0].letters: expected a string or up to 10 of them, got a table",
        ],
    ),
    "points": (
        A + V + "points = -1\n",
        [
            "answers[0].points: expected a number of points from 0 to 1000, got -1. These are "
            "the points of a right answer.",
        ],
    ),
    "points text": (
        A + V + "points = '1,5'\n",
        [
            "answers[0].points: expected a number of points, got the string '1,5'. Write 1.5 "
            "without quotes.",
        ],
    ),
    "form": (
        A + V + "form = 'milimetres'\n",
        [
            "answers[0].form: expected 'value', 'mm' or 'both', got the string 'milimetres'",
        ],
    ),
    "mm of omega": (
        A + "what = 'omega 2'\nform = 'mm'\n",
        [
            "answers[0].form: 'omega 2' is not a segment of a plan. "
            'Omit it, or write form = "value".',
        ],
    ),
    "mm of a quotient": (
        A + "what = 'v C / omega 1'\nform = 'mm'\n",
        [
            "answers[0].form: 'v C / omega 1' is not a segment of a plan. Omit it, or write form = "
            '"value".',
        ],
    ),
    "sense word": (
        A + V + "sense = 'turns'\n",
        [
            "answers[0].sense: expected 'turn', 'direction' or 'angle', got the string "
            "'turns'. Did you mean 'turn'?",
        ],
    ),
    "sense number": (
        A + V + "sense = 1\n",
        [
            "answers[0].sense: expected true, false or one of 'turn', 'direction', "
            "'angle', got the integer 1",
        ],
    ),
    "sense of v as turn": (
        A + V + "sense = 'turn'\n",
        [
            "answers[0].sense: 'v' is a vector. Write sense = \"direction\".",
        ],
    ),
    "sense of omega as angle": (
        A + "what = 'omega 2'\nsense = 'angle'\n",
        [
            "answers[0].sense: 'omega' turns. Write sense = \"turn\".",
        ],
    ),
    "sense of x": (
        A + "what = 'x C'\nsense = true\n",
        [
            "answers[0].sense: 'x' has no sense that could be requested. Omit sense: the sign of "
            "the number, or the size of a load, is sufficient.",
        ],
    ),
    "position": (
        A + V + "position = 4\n",
        [
            "answers[0].position: position 4 of 4. The first position is 0.",
        ],
    ),
    "digits": (
        A + V + "digits = 0\n",
        [
            "answers[0].digits: expected a whole number from 1 to 8, got the integer 0",
        ],
    ),
    "segment": (
        A + V + "segment = 'p'\n",
        [
            "answers[0].segment: expected the two ends of a segment, got the string 'p'. "
            'For example: "p b3".',
        ],
    ),
    "tolerance": (
        A + V + "tolerance = 0.05\n",
        [
            "answers[0].tolerance: expected a tolerance in percent from 0.1 to 100, got "
            "0.05. Write 5 for 5 % of the value.",
        ],
    ),
    "unit": (
        A + V + "unit = 5\n",
        [
            "answers[0].unit: expected a string, got the integer 5. Put it in quotes.",
        ],
    ),
    "several": (
        A + V + "points = true\ndigits = 2.5\nunit = 'метров в секунду за секунду'\n",
        [
            "answers[0].unit: the text has 27 characters, the limit is 20. Shorten it.",
            "answers[0].points: expected a number of points, got the boolean true",
            "answers[0].digits: expected a whole number from 1 to 8, got the number 2.5",
        ],
    ),
}


@pytest.mark.parametrize("name", FAULTS)
def test_every_fault_is_reported_with_its_place_and_remedy(name: str) -> None:
    text, wanted = FAULTS[name]
    assert messages(text, CRANK) == wanted


def test_a_reaction_in_a_joint_that_its_links_do_not_have() -> None:
    text = "[[answers]]\nwhat = 'F_C_2/1'\n[[answers]]\nwhat = 'F_B_2/1'\n"
    assert messages(text + LOADED, CRANK) == [
        "answers[0].what: links 2 and 1 have no joint C. Write 'F 2 1' instead."
    ]


def test_too_many_answers() -> None:
    assert messages((A + V) * 201, CRANK) == ["answers: 201 answers, the limit is 200"]


def test_names_are_not_checked_where_the_mechanism_is_faulty() -> None:
    found = messages(A + "what = 'v Z'\n", CRANK.replace("AB = 0.1", "AB = -1"))
    assert not [message for message in found if "answers" in message]


def schema_faults(text: str) -> int:
    jsonschema = pytest.importorskip("jsonschema")
    path = Path(__file__).parents[2] / "planmethod" / "problem" / "schema.json"
    schema = jsonschema.Draft202012Validator(json.loads(path.read_text(encoding="utf-8")))
    return sum(1 for _ in schema.iter_errors(tomllib.loads(CRANK + text)))


def test_the_schema_accepts_what_the_reader_accepts_and_rejects_what_it_can() -> None:
    good = "id = 'скорость_C'\nletters = ['v']\nsense = true\nform = 'mm'\ntolerance = 5\n"
    assert loads(CRANK + A + V + good, name="asked").answers
    assert not schema_faults(A + V + good)
    seen = {name for name, (text, _) in FAULTS.items() if schema_faults(text)}
    # only the reader checks names, uniqueness, and which key suits which quantity
    assert len(seen) >= 14
    assert {"form", "points", "digits", "tolerance", "no what", "unit", "letters", "ids"} <= seen
