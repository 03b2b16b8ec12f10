"""The groups of the mechanism of a problem, without its numbers (структурный анализ)."""

from __future__ import annotations

from collections.abc import Mapping

from planmethod.errors import StructureError
from planmethod.languages import translate
from planmethod.mechanism.structure import Structure, analyse
from planmethod.problem.model import Problem


def structure_of(problem: Problem) -> Structure:
    """Return the groups of the mechanism of a problem.

    Raises
    ------
    StructureError
        As of `analyse`; also for wheels on links, whose meshes are not pairs here.
    """
    try:
        return analyse(problem.mechanism)
    except StructureError as error:
        wheels = problem.tables.get("gears", {}).get("wheels")
        named = [name for name in problem.mechanism.links if name in (wheels or {})]
        if not isinstance(wheels, Mapping) or len(named) < 2:
            raise
        text = translate(
            "Wheels {} of [gears] have the names of links: a mesh of two wheels on links of "
            "a linkage is not supported as a pair yet and is not counted. Give the linkage "
            "one crank, and give other names to a train that turns it.",
            ", ".join(named),
        )
        raise StructureError(f"{error} {text}") from error
