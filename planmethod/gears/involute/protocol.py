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


def protocol_document(problem: MeshingProblem, words: Language, profile: Profile) -> Iterator[Node]:
    """Yield the calculation formula by formula, as the note has it; no hand draws in it."""
    solved, say = SolvedMeshing(problem), words.meshing
    fields = solved.fields(words.say)
    yield from head(solved, words)
    for key, formulas in groupby(solved.formulas(words), lambda one: one[0]):
        if key in say["steps"]:
            yield Chapter(say["steps"][key])
        if key in say["beside"]:
            yield Paragraph(say["beside"][key].format(**fields))
        yield from (Formula(formula) for _, formula in formulas)
    yield Chapter(say.cutting)
    yield from map(Item, cutting(solved, words))
    yield Caption(say.checked)
    yield from map(Item, quality(solved, words))
