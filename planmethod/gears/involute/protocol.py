"""The calculation of a pair of wheels, formula by formula (протокол расчёта)."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby

from planmethod.construct.drafting import Profile
from planmethod.gears.involute.quantities import SolvedMeshing
from planmethod.gears.involute.sizes import MeshingProblem
from planmethod.gears.involute.text import cutting, head, quality
from planmethod.note.document import Caption, Chapter, Formula, Item, Node, Paragraph
from planmethod.note.wording import Language


def protocol_document(
    problem: MeshingProblem, language: Language, profile: Profile
) -> Iterator[Node]:
    """Yield the calculation formula by formula, as the note has it; no hand draws in it."""
    solved, texts = SolvedMeshing(problem), language.meshing
    fields = solved.fields(language.notation)
    yield from head(solved, language)
    for key, formulas in groupby(solved.formulas(language), lambda one: one[0]):
        if key in texts["steps"]:
            yield Chapter(texts["steps"][key])
        if key in texts["beside"]:
            yield Paragraph(texts["beside"][key].format(**fields))
        yield from (Formula(formula) for _, formula in formulas)
    yield Chapter(texts.cutting)
    yield from map(Item, cutting(solved, language))
    yield Caption(texts.checked)
    yield from map(Item, quality(solved, language))
