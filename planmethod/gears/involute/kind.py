"""Two wheels in mesh (эвольвентное зацепление), as a kind of problem."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from planmethod.kind import ProblemKind
from planmethod.note.document import Document, GivenFact
from planmethod.options import PlanRequest

if TYPE_CHECKING:
    from planmethod.gears.involute.geometry import MeshingProblem
    from planmethod.note.wording import Language
    from planmethod.render.ink.drawing import Drawing


class Meshings(ProblemKind["MeshingProblem"]):
    """Two wheels in mesh (эвольвентное зацепление), as a kind of problem."""

    table = "meshing"

    def load(self, path: Path, variant: str | None) -> MeshingProblem:
        """Read a problem file."""
        from planmethod.gears.involute.reader import load

        return load(path, variant=variant)

    def record(self, problem: MeshingProblem, lang: str) -> dict[str, Any]:
        """Return what ``solve --json`` prints."""
        from planmethod.gears.involute.results import record

        return record(problem, lang)

    def result_rows(self, problem: MeshingProblem) -> list[dict[str, Any]]:
        """Return the values of both wheels, one row each."""
        found = self.record(problem, "en")["meshing"]
        lists = {key: own for key, own in found.items() if isinstance(own, list) and len(own) == 2}
        pairs = {key: own for key, own in lists.items() if not isinstance(own[0], dict)}
        return [{"wheel": k + 1, **{key: own[k] for key, own in pairs.items()}} for k in (0, 1)]

    def solved_document(self, problem: MeshingProblem, language: Language) -> Document:
        """Return what ``solve`` prints."""
        from planmethod.gears.involute.results import solved_document

        return Document.of(solved_document(problem, language))

    def protocol_document(
        self, problem: MeshingProblem, language: Language, request: PlanRequest
    ) -> Document:
        """Return what ``protocol`` prints."""
        from planmethod.gears.involute.results import protocol_document

        return Document.of(protocol_document(problem, language, request.profile))

    def drawings(self, problem: MeshingProblem, request: PlanRequest) -> list[Drawing]:
        """Return the sheets."""
        from planmethod.gears.involute.sheet import drawings

        return drawings(problem, request)

    def live_page(self, problem: MeshingProblem, lang: str) -> str:
        """Return the page that ``live`` writes."""
        from planmethod.gears.involute.live import live_page

        return live_page(problem, lang)

    def given_facts(self, problem: MeshingProblem, language: Language) -> list[GivenFact]:
        """Return the given facts; the file can be rebuilt from their data."""
        from planmethod.gears.involute.results import SolvedMeshing, given_facts

        return given_facts(SolvedMeshing(problem), language)
