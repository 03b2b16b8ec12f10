"""A reaction shared between two bearings, and what statics leaves open (подшипники)."""

from __future__ import annotations

from planmethod.mechanism.groups import AssurGroup
from planmethod.note.formula import Rich, fraction
from planmethod.note.narrate.statement import point_name
from planmethod.note.plaintext import computed_text, input_text
from planmethod.note.wording import MessageTable
from planmethod.plans.forces.polygons import reaction_symbol
from planmethod.problem.load_records import BearingSection
from planmethod.solved.forces.contact import JointForce
from planmethod.solved.solution import Solution


def bearing_text(
    solution: Solution, joint: JointForce, shared: BearingSection, force: float, texts: MessageTable
) -> Rich:
    """Return the load of each bearing from a reaction, N, with numbers."""
    called, z = solution.problem.mechanism.called, shared.plane
    (first, second), parts = shared.at, []
    symbol = reaction_symbol(called(joint.on), called(joint.by))
    length = input_text(abs(second - first), texts)
    for primes, share, arm in zip(
        ("'", "''"), shared.load_fractions, (abs(second - z), abs(z - first)), strict=True
    ):
        name = reaction_symbol(called(joint.on), called(joint.by), letter=f"F^{{{primes}}}")
        numbers = fraction(f"{computed_text(force, texts)}·{input_text(arm, texts)}", length)
        size = f"{computed_text(abs(share) * force, texts)} {texts['units']['N']}"
        back = texts.bearing_back.format(symbol=symbol) if share < 0 else ""
        parts.append(f"{name} = {numbers} = {size}{back}")
    return texts.bearings.format(
        joint=point_name(joint.joint), symbol=symbol, first=parts[0], second=parts[1]
    )


def redundant(links: int) -> int:
    """Return q of a group of n links whose pairs have one freedom each; 0 for a driver.

    Across the plane a link has three equations, and a pair three unknowns: the force along the axis
    of its hinge and two moments. A group of n links has 3n/2 pairs.
    """
    return 3 * links // 2 if links > 1 else 0


def undetermined(groups: list[AssurGroup], texts: MessageTable) -> Rich:
    """Describe the reaction components in the groups that statics leaves undetermined."""
    named = ", ".join("–".join(group.links) for group in groups)
    n = len(groups[0].links)  # dyads: what else is there has no force plans
    template = texts.undetermined if len(groups) > 1 else texts.undetermined_one
    return template.format(groups=named, equations=3 * n, unknowns=3 * (3 * n // 2), q=redundant(n))
