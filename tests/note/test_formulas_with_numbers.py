"""Every numeric formula of a protocol gives its printed result, for all kinds of problem."""

from __future__ import annotations

from cases import each
from doors import (
    LINKAGES,
    Document,
    Language,
    PlanRequest,
    Solution,
    get_language,
    kind_of,
    problem_loads as loads,
    protocol_document,
)
from evaluated import count_equations_that_hold, texts_of
from mechanisms import REVERSED
from worked import path_of

FILES = (  # of each section of a protocol one, with how many of its formulas have numbers
    ("press/flywheel", 75, "ru"),
    ("machines/rubbing-crank", 70, "en"),
    ("machines/balanced-crank", 45, "ru"),
    ("linkages/triad", 80, "en"),
    ("gears/planetary-k10", 25, "ru"),
    ("gears/gears-ex1", 9, "en"),
    ("meshing/z12-30", 40, "ru"),
    ("point/polar-slider", 12, "en"),
)


def documents_of(name: str, words: Language) -> list[Document]:
    """Return the protocol of a file and, of other kinds than linkages, its solution."""
    path = path_of(name)
    kind = kind_of(path)
    problem = kind.load(path, None)
    request = PlanRequest()
    protocol = kind.protocol_document(problem, words, request)
    return [protocol] if kind is LINKAGES else [kind.solved_document(problem, words), protocol]


@each("name, least, lang", FILES)
def test_the_numbers_of_every_formula_come_to_its_result(name: str, least: int, lang: str) -> None:
    documents = documents_of(name, get_language(lang))
    texts = (text for document in documents for text in texts_of(document))
    assert count_equations_that_hold(texts) >= least


@each("lang", ["en", "ru"])
def test_a_difference_of_signed_numbers_has_its_sign(lang: str) -> None:
    document = protocol_document(Solution(loads(REVERSED, name="own")), get_language(lang), 0)
    assert count_equations_that_hold(texts_of(document)) >= 30
