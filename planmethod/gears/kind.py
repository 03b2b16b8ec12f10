"""Gear trains (зубчатые механизмы), as a kind of problem."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from planmethod.kind import ProblemKind
from planmethod.note.document import Document, GivenFact
from planmethod.options import PlanRequest

if TYPE_CHECKING:
    from planmethod.gears.model import GearProblem
    from planmethod.note.audit import Audited
    from planmethod.note.wording import Language
    from planmethod.problem.records import QuestionQuantities
    from planmethod.render.ink.drawing import Drawing
    from planmethod.render.play.playback import Playback


class GearTrains(ProblemKind["GearProblem"]):
    """Gear trains (зубчатые механизмы), as a kind of problem."""

    table = "gears"
    scales = "gears.picture.mu_l"

    def load(self, path: Path, variant: str | None) -> GearProblem:
        """Read a problem file."""
        from planmethod.gears.reader import load

        return load(path, variant=variant)

    def record(self, problem: GearProblem, lang: str) -> dict[str, Any]:
        """Return what ``solve --json`` prints."""
        from planmethod.gears.record import record

        return record(problem, lang)

    def result_rows(self, problem: GearProblem) -> list[dict[str, Any]]:
        """Return the speeds of the bodies, one row each."""
        bodies = self.record(problem, "en")["gears"]["bodies"].items()
        return [{"name": name, "n": one["n"], "omega": one["omega"]} for name, one in bodies]

    def solved_document(self, problem: GearProblem, language: Language) -> Document:
        """Return what ``solve`` prints."""
        from planmethod.gears.text import solved_document

        return Document.of(solved_document(problem, language))

    def structure_record(self, problem: GearProblem) -> dict[str, Any]:
        """Return what ``structure --json`` prints."""
        from planmethod.gears.record import structure_record

        return structure_record(problem)

    def structure_document(self, problem: GearProblem, language: Language) -> Document:
        """Return what ``structure`` prints."""
        from planmethod.gears.text import structure_document

        return Document.of(structure_document(problem, language))

    def protocol_document(
        self, problem: GearProblem, language: Language, request: PlanRequest
    ) -> Document:
        """Return what ``protocol`` prints."""
        from planmethod.gears.protocol import protocol_document

        return Document.of(protocol_document(problem, language, request.profile))

    def playback(self, problem: GearProblem, language: Language, request: PlanRequest) -> Playback:
        """Return the construction as it is played."""
        from planmethod.gears.playback import playback

        return playback(problem, language, request.profile)

    def drawings(self, problem: GearProblem, request: PlanRequest) -> list[Drawing]:
        """Return the sheets."""
        from planmethod.gears.sheet import drawings

        return drawings(problem, request)

    def live_page(self, problem: GearProblem, lang: str) -> str:
        """Return the page that ``live`` writes."""
        from planmethod.gears.live import live_page

        return live_page(problem, lang)

    def audited(self, problem: GearProblem, ruler: float) -> list[Audited]:
        """Return printed values beside the exact ones and those read with a ruler."""
        from planmethod.gears.results import audited

        return audited(problem, ruler)

    def given_facts(self, problem: GearProblem, language: Language) -> list[GivenFact]:
        """Return the given facts; the file can be rebuilt from their data."""
        from planmethod.gears.motion import solve_motion
        from planmethod.gears.sheet_texts import train_facts

        return train_facts(solve_motion(problem), language)

    def scheme(self, problem: GearProblem) -> Drawing | None:
        """Return the side view; None where it cannot be drawn."""
        from planmethod.gears.side_view import draw_scheme

        return draw_scheme(problem)

    def answer_source(self, problem: GearProblem) -> QuestionQuantities:
        """Return the computed quantities with which answers are compared."""
        from planmethod.gears.results import TrainQuantities

        return TrainQuantities(problem)

    def failing_conditions(self, problem: GearProblem) -> Iterator[tuple[str, str]]:
        """Yield the conditions of teeth that a train does not meet, with the wheel of each."""
        from planmethod.gears.motion import solve_motion
        from planmethod.gears.solution import conditions

        for one in conditions(solve_motion(problem)):
            if not one.is_satisfied:
                yield one.name, one.facts.get("wheel") or one.facts.get("carrier", "")
