"""Sheets in English: Russian only in texts of the file, no faults; in Russian no English."""

from __future__ import annotations

import re
import tomllib
from collections import Counter
from collections.abc import Iterator

import pytest
from cases import thinned
from doors import (
    SHIPPED,
    SPECIMENS,
    WORDING_LANGUAGES as LANGUAGES,
    Drawing,
    ModelProblem as Problem,
    Severity,
    Text,
    analyse,
    get_language,
    inspect,
    kinematics_sheets,
    pose,
    problem_loads as parsed,
    problem_template as template,
    structure_sheet,
)
from msgspec.structs import replace
from worked import PROBLEMS, problem_of

CYRILLIC = re.compile("[\u0400-\u04ff]")

TURN = tuple(range(0, 360, 60))
CASES = [
    *((name, "linkages/ex3", (20.0,)) for name in ("one-position", "homework")),
    ("many-positions", "press/press-stone", TURN),
    ("coursework", "linkages/ex1", TURN),
    ("coursework-12", "linkages/ex1", TURN),
    *(("forces", name, None) for name in ("levers/six-link", "levers/task12", "press/press")),
    ("few-positions", "linkages/ex3", TURN[:2]),
    ("compact", "linkages/ex1", (60.0,)),
    ("forces-cycle", "levers/task12", TURN),
    ("forces-cycle", "press/press", TURN),
    ("graphs", "press/press", None),
    ("analytic", "linkages/ex1", None),
    ("centres", "linkages/ex1", None),
    ("superposition", "linkages/five-bar", None),
    ("friction", "machines/rubbing-crank", None),
    ("project-kinematics", "press/press", TURN),
    ("project-forces", "press/press", None),
    ("flywheel", "press/flywheel", None),
    ("run-up", "machines/compressor", None),
    ("balancing", "machines/balanced-fourbar", None),
    ("synthesis", "press/press", None),
    ("four-sheets", "levers/task12", None),
]


def bare(problem: Problem, lang: str) -> Problem:
    """Return a problem without texts of its own, in a language."""
    sheet = replace(problem.sheet, lang=lang, side_columns=True)
    return replace(problem, title="", stamp={}, stamp_in={}, sheet=sheet)


def test_a_title_block_has_the_texts_given_for_its_language() -> None:
    """For a Russian file with ``stamp.en``; texts given in one language are not translated."""
    russian = problem_of("linkages/ex3")
    english = replace(russian, sheet=replace(russian.sheet, lang="en"))
    (drawing,) = kinematics_sheets(english, positions=(20.0,), layout="one-position")
    (other,) = kinematics_sheets(russian, positions=(20.0,), layout="one-position")
    assert is_english(drawing), sorted(filter(CYRILLIC.search, texts(drawing)))
    assert drawing.title == "Kinematic analysis of a linkage"
    assert {"TMM.01.03.00.000", "Department of TMM", "T"} <= {*texts(drawing)}
    assert "ТММ.01.03.00.000" in texts(other)
    assert not {*texts(other)} & set(russian.stamp_in["en"].values())
    silent = replace(english, stamp_in={})
    (drawing,) = kinematics_sheets(silent, positions=(20.0,), layout="one-position")
    assert {"ТММ.01.03.00.000", "Кафедра ТММ"} <= {*texts(drawing)}


def test_every_shipped_problem_has_an_english_title_block() -> None:
    """Names of variants, which are the file's own letters, are not translated."""
    files = sorted(PROBLEMS.rglob("*.toml"))
    assert len(files) > 200
    for path in files:
        stamp = tomllib.loads(path.read_text("utf-8"))["stamp"]
        english = stamp.pop("en")
        block = stamp | english
        assert block["title"], path
        told = {key: text.partition(", variant")[0] for key, text in block.items()}
        assert not {key: text for key, text in told.items() if CYRILLIC.search(text)}, path


def texts(drawing: Drawing) -> Iterator[str]:
    return (item.text for item in drawing.items if isinstance(item, Text))


def is_english(drawing: Drawing) -> bool:
    return not any(map(CYRILLIC.search, texts(drawing)))


@pytest.mark.parametrize(("layout", "name", "positions"), thinned(CASES, 2))
def test_a_sheet_in_english_has_no_russian_and_no_fault(
    layout: str, name: str, positions: tuple[float, ...] | None
) -> None:
    problem = pose(bare(problem_of(name), "en"))
    for sigma in (False, True):
        made = kinematics_sheets(
            problem, positions=positions, layout=layout, errors=sigma, sigma=sigma
        )
        for drawing in made:
            assert is_english(drawing), sorted(filter(CYRILLIC.search, texts(drawing)))
            # But for two links, as the 2,3 of a sum, or the group II(2,3).
            plain = [re.sub(r"\(\d,\d\)", "", text) for text in texts(drawing)]
            assert not [text for text in plain if re.search(r"\d,\d.|.\d,\d", text)]
            faults = [one for one in inspect(drawing) if one.severity is Severity.ERROR]
            assert faults == []


def test_every_shipped_layout_is_among_the_cases() -> None:
    assert {layout for layout, *_ in CASES} == set(SHIPPED)


@pytest.mark.parametrize("loads", ["gravity = false", "[dynamics.links.2]\nmass = 2"])
def test_no_russian_text_is_on_sheets_without_motion_or_forces(loads: str) -> None:
    text = template("six-link").replace("omega = 20", "omega = 0")
    problem = bare(parsed(f"{text}[dynamics]\n{loads}\n", name="six-link"), "en")
    (sheet,) = kinematics_sheets(problem, layout="forces")
    assert is_english(sheet)
    assert "there is no Zhukovsky lever" in " ".join(texts(sheet))


@pytest.mark.parametrize("name", ["linkages/ex3", "press/press", "levers/task12"])
def test_the_structural_sheet_in_english(name: str) -> None:
    problem = bare(problem_of(name), "en")
    drawing = structure_sheet(problem, analyse(problem.mechanism))
    assert is_english(drawing)
    assert inspect(drawing) == []


@pytest.mark.parametrize("name", SPECIMENS)
def test_a_specimen_in_english(name: str) -> None:
    told = [
        text for text in texts(SPECIMENS[name]({}, get_language("en"))) if CYRILLIC.search(text)
    ]
    assert all(len(text) == 1 for text in told)  # the letters that are shown themselves
    assert (told != []) is (name == "lettering")


@pytest.mark.parametrize(("layout", "name", "positions"), thinned(CASES[1:], 2))
def test_a_sheet_in_russian_has_no_english_word(
    layout: str, name: str, positions: tuple[float, ...] | None
) -> None:
    problem = pose(bare(problem_of(name), "ru"))
    for drawing in kinematics_sheets(
        problem, positions=positions, layout=layout, errors=True, sigma=True
    ):
        english = re.compile(r"\b(?!const|arctg|atan2)[A-Za-z]{4,}")
        assert not [text for text in texts(drawing) if english.search(text)]


def test_the_numbers_are_the_same_in_every_language() -> None:
    """Only the decimal sign differs."""
    problem = problem_of("linkages/ex3")
    found = []
    for lang in LANGUAGES:
        (drawing,) = kinematics_sheets(bare(problem, lang), layout="homework", sigma=True)
        told = " ".join(texts(drawing)).replace(get_language(lang).notation.decimal, ".")
        found.append(Counter(re.findall(r"\d+\.\d+", told)))
    assert all(one == found[0] != Counter() for one in found)
