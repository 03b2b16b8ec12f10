"""Outputs of a camshaft: students' quantities, and the construction by steps."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial
from math import pi

from msgspec.structs import replace

from planmethod.cams.construction import construct
from planmethod.cams.model import CamProblem
from planmethod.cams.reader import PLACED
from planmethod.cams.results import CamQuantities, construction_nodes, value_of
from planmethod.cams.shaft import Camshaft, phase_of
from planmethod.cams.shaft_reader import named_quantity
from planmethod.cams.shaft_text import (
    head,
    lifts_table,
    phases_table,
    timing_scale,
)
from planmethod.cams.sheet import sheet_scales
from planmethod.cams.text import MM
from planmethod.construct.drafting import Profile
from planmethod.note.document import Caption, Chapter, Node, Paragraph, Part, steps_of
from planmethod.note.formula import escape
from planmethod.note.wording import Language
from planmethod.problem.records import AnswerValue, Mistaken, Relations

CODES = {"Q6": 0.0, "Q7": -1.0}
"""Mistakes in phases: all cams begin at the key; phases are laid off against the rotation."""


class CamshaftQuantities:
    """Quantities of a camshaft for questions (`QuestionQuantities`): ``s_A``, ``r_min_A``."""

    def __init__(self, problem: Camshaft) -> None:
        self.problem, self.count = problem, problem.count
        self.cams = {cam.name: CamQuantities(self._cam(cam.name)) for cam in problem.cams}
        self.names = tuple(
            f"{quantity}_{cam}" for cam, own in self.cams.items() for quantity in own.names
        )

    def _cam(self, name: str, factor: float = 1.0) -> CamProblem:
        """Return a cam whose positions are those of the shaft, turned by its phase."""
        (cam,) = (cam for cam in self.problem.cams if cam.name == name)
        return replace(cam, count=self.count, phase=(factor * phase_of(cam)) % (2 * pi))

    def quantity(self, name: str, position: int) -> AnswerValue | None:
        """Return a quantity by its name in ``[[answers]]``."""
        found = named_quantity(name, [*self.cams])
        if found is None:
            return None
        own = self.cams[found[1]].quantity(found[0], position)
        return None if own is None else replace(own, symbol=f"{own.symbol}({found[1]})")

    def read_off(self, name: str, position: int, profile: Profile) -> tuple[float, float] | None:
        """Return its segment on the drawing, mm, and one sigma of the reading."""
        found = named_quantity(name, [*self.cams])
        return None if found is None else self.cams[found[1]].read_off(found[0], position, profile)

    def mistaken(self) -> Iterator[Mistaken]:
        """Yield the usual mistakes in the phases of the cams."""
        for code, factor in CODES.items():
            cams = {cam.name: CamQuantities(self._cam(cam.name, factor)) for cam in
                    self.problem.cams if phase_of(cam)}  # fmt: skip
            if cams:
                yield Mistaken(code, "", partial(self._by, cams))

    def _by(self, cams: dict[str, CamQuantities], name: str, position: int) -> float | None:
        found = named_quantity(name, [*self.cams])
        if found is None or found[1] not in cams or found[0] not in PLACED:
            value = self.quantity(name, position)
            return None if value is None else value.value
        return value_of(cams[found[1]].design, found[0], position)

    def relations(self, names: Sequence[str], position: int) -> Relations:
        """Return none: no number of a cam follows from another one alone."""
        return Relations()


def protocol_document(shaft: Camshaft, language: Language, profile: Profile) -> Iterator[Node]:
    """Yield the cyclogram, then the construction of each cam; the scales are those of the sheets.

    Raises
    ------
    ProblemError
        A cam cannot satisfy its requirements.
    LayoutError
        A sheet cannot be drawn.
    """
    texts, notation = language.cam, language.notation
    yield from head(shaft, language)
    if shaft.source:
        yield Paragraph(language.note.source.format(source=escape(shaft.source)))
    yield Paragraph(language.note.ruler.format(ruler=notation.as_input(profile.ruler)))
    yield Chapter(texts.cyclogram, numbered=False)
    scale = notation.as_input(MM * timing_scale(shaft))
    yield from steps_of([texts.cyclogram_laid.format(scale=scale)])
    for cam in shaft.cams:
        told = texts.cyclogram_cam if phase_of(cam) else texts.cyclogram_first
        phase = notation.as_input(round(phase_of(cam) * 180 / pi, 6))
        yield from steps_of([told.format(name=escape(cam.name), phase=phase)])
    yield from steps_of([texts.key_told.format()])
    yield Caption(texts.phases_title)
    yield phases_table(shaft, language)
    yield Caption(texts.lifts_read)
    yield lifts_table(shaft, language, profile)
    for cam, design in zip(shaft.cams, shaft.designs, strict=True):
        yield Part(texts.one_cam.format(name=escape(cam.name)))
        yield from construction_nodes(construct(design, sheet_scales(cam)), language, profile)
