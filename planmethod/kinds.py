"""Kinds of problem beside linkages: the table that tells them, the package that solves them."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

from msgspec import Struct

from planmethod.errors import Fault, ProblemError
from planmethod.languages import say
from planmethod.pattern import pattern
from planmethod.problem.source import parse, read_source

if TYPE_CHECKING:
    from planmethod.construct.drafting import Profile
    from planmethod.note.audit.audit import Audited
    from planmethod.problem.fields import Faults
    from planmethod.problem.figures import Figures
    from planmethod.problem.head import KindProblem
    from planmethod.problem.model import Geared, Problem
    from planmethod.render.ink.drawing import Drawing
    from planmethod.solved.part import Part
    from planmethod.solved.scaling import Views


def load(path: str | Path, *, variant: str | None = None) -> Problem:
    """Read the file of a linkage; a crank may be driven by the train of the same file.

    Raises
    ------
    ProblemError
    """
    (problem,) = load_each(path, (variant,))
    return problem


def load_each(path: str | Path, variants: Iterable[str | None]) -> Iterator[Problem]:
    """Read some variants of the file of a linkage, None for its main part: the file itself once."""
    return map(_posed, _of("planmethod.problem", "load_each")(path, variants, train=_driven))


def loads(text: str, *, name: str, variant: str | None = None) -> Problem:
    """Read the same from a text; ``name`` stands for the stem of the file."""
    read = _of("planmethod.problem", "loads")
    return _posed(read(text, name=name, variant=variant, train=_driven))


def _posed(problem: Problem) -> Problem:
    """Return a problem with the positions that its output tells."""
    if problem.drive.posed is not None:
        problem = _of("planmethod.solved.turn.posed", "pose")(problem)
    return problem


def part_of(path: Path, *, variant: str | None, views: Views) -> tuple[str, Part]:
    """Return the title of the file of a linkage, and as much of it as can be drawn.

    Raises
    ------
    ProblemError
        The file cannot be read at all.
    """
    text = read_source(path)
    try:
        table = parse(text, name=str(path))
    except ProblemError as error:
        part: Part = _of("planmethod.solved.part", "Part")(None, faults=error.faults, trouble=error)
        return "", part
    faults = _of("planmethod.problem.fields", "Faults")()
    part = _of("planmethod.solved.part", "largest_part")(
        _of("planmethod.problem.table", "with_table")(faults, table, path.parent),
        source=str(path),
        name=path.stem,
        variant=variant,
        train=_driven,
        views=views,
        posed=_posed,
    )
    title = table.get("title")
    return title if isinstance(title, str) else "", part


def _driven(faults: Faults, table: Mapping[str, Any], label: object) -> Geared | None:
    geared: Geared | None = _of("planmethod.gears.driving", "driven")(faults, table, label)
    return geared


def _of(package: str, name: str) -> Any:
    """Return a function of a package that is imported only now."""
    return getattr(import_module(package), name)


ROOMS: Mapping[str, str] = {
    "load": "reader",
    "record": "record",
    "structure_record": "record",
    "solved_document": "text",
    "structure_document": "text",
    "protocol_document": "protocol",
    "drawings": "sheet",
    "audited": "audit",
    "asked_of": "figures",
}
"""Modules of a kind's package that its functions are in."""

CALLED: Mapping[str, str] = {
    "drawings": "sheets",
    "protocol_document": "protocol",
    "audited": "audit",
    "asked_of": "checking of answers",
}
"""What a kind may go without, in words."""


class Kind(Struct, frozen=True):
    """A kind of problem (вид задачи).

    Attributes
    ----------
    table : str
        The table of the problem file that tells it.
    package : str
        Where its functions are, in the modules of `ROOMS`: each is imported when it is called.
    scales : str
        Where its file has the scales.
    """

    table: str
    package: str
    scales: str = "[scales]"

    def load(self, path: Path, variant: str | None) -> KindProblem:
        """Read a problem file."""
        problem: KindProblem = self._call("load", path, variant=variant)
        return problem

    def record(self, problem: KindProblem, lang: str) -> dict[str, Any]:
        """Return what ``solve --json`` prints."""
        told: dict[str, Any] = self._call("record", problem, lang)
        return told

    def solved_text(self, problem: KindProblem, lang: str) -> str:
        """Return what ``solve`` prints."""
        return self._written("solved_document", problem, lang)

    def structure_record(self, problem: KindProblem) -> dict[str, Any] | None:
        """Return what ``structure --json`` prints; None for what has no structure."""
        record = self._function("structure_record")
        return None if record is None else dict(record(problem))

    def structure_text(self, problem: KindProblem, lang: str) -> str | None:
        """Return what ``structure`` prints; None for what has no structure."""
        known = self._function("structure_document") is not None
        return self._written("structure_document", problem, lang) if known else None

    def drawings(
        self,
        problem: KindProblem,
        *,
        fields: Mapping[str, str],
        profile: Profile,
        before: int = 0,
        total: int | None = None,
    ) -> list[Drawing]:
        """Return the sheets; ``before`` of the set of ``total`` go before them.

        Raises
        ------
        ProblemError
            Such problems have no sheets, or these cannot be drawn.
        """
        drawn: list[Drawing] = self._call(
            "drawings", problem, fields=fields, profile=profile, before=before, total=total
        )
        return drawn

    def protocol_text(self, problem: KindProblem, lang: str, profile: Profile) -> str:
        """Return what ``protocol`` prints.

        Raises
        ------
        ProblemError
            Such problems have no protocol.
        """
        return self._written("protocol_document", problem, lang, profile)

    def audited(self, problem: KindProblem, ruler: float) -> list[Audited]:
        """Return printed values beside the exact ones and those read with a ruler.

        Raises
        ------
        ProblemError
            Such problems have no audit.
        """
        told: list[Audited] = self._call("audited", problem, ruler)
        return told

    def figures(self, problem: KindProblem) -> Figures:
        """Return what students can be asked for.

        Raises
        ------
        ProblemError
            Answers to such problems are not checked.
        """
        asked: Figures = self._call("asked_of", problem)
        return asked

    def _written(self, name: str, problem: KindProblem, lang: str, *args: Any) -> str:
        """Return a document of a problem as plain text."""
        words = _of("planmethod.note.wording", "language")(lang)
        nodes = self._call(name, problem, words, *args)
        whole = _of("planmethod.note.document", "Document").of(nodes)
        return str(_of("planmethod.note.writers.plain", "plain_document")(whole, words))

    def _call(self, name: str, problem: Any, *args: Any, **options: Any) -> Any:
        """Call a function of the package; not every kind has every one."""
        function = self._function(name)
        if function is None:
            told = say("such a problem has no {}; its numbers: planmethod solve", CALLED[name])
            raise ProblemError(problem.name, [Fault(self.table, told)])
        return function(problem, *args, **options)

    def _function(self, name: str) -> Callable[..., Any] | None:
        module = f"{self.package}.{ROOMS[name]}"
        return None if find_spec(module) is None else getattr(import_module(module), name, None)


KINDS = (
    Kind("gears", "planmethod.gears", "gears.picture.mu_l"),
    Kind("point", "planmethod.moving"),
    Kind("meshing", "planmethod.gears.involute"),
)
"""All of them; a file that has links is a linkage whatever else it has."""

_HEAD = pattern(r"^[ \t]*\[?[ \t]*[\"']?(" + "|".join(k.table for k in KINDS) + r")\b", re.M)


def kind_of(path: Path) -> Kind | None:
    """Return the kind of a problem file; None for a linkage.

    Raises
    ------
    ProblemError
        The file cannot be read, or is not TOML.
    """
    text = read_source(path)
    if _HEAD.search(text) is None:  # a linkage is not parsed twice
        return None
    table = parse(text, name=str(path))
    if "links" in table:
        return None
    return next((kind for kind in KINDS if kind.table in table), None)
