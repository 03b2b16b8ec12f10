"""The structural analysis in full as plain data: pairs, schemes without redundant constraints."""

# no messages: reasons in JSON

from __future__ import annotations

from typing import Any

from planmethod.mechanism.describe import stated_pairs
from planmethod.mechanism.model import Mechanism
from planmethod.mechanism.structure import Structure
from planmethod.note.narrate.structure import MOBILITY
from planmethod.note.records.solution import structure_record
from planmethod.solved.aligned.schemes import AlignedGroup, SelfAligning


def structure_in_full(
    structure: Structure, mechanism: Mechanism, aligned: SelfAligning
) -> dict[str, Any]:
    """Return `structure_record` with the pairs, W in space and the schemes with q = 0."""
    rows = [
        {
            "pair": f"{pair.point} {'-'.join(pair.links)}",
            "kind": pair.kind.value,
            "plane": int(MOBILITY[pair.kind][1]),
            "space": int(MOBILITY[pair.kind][2]),
        }
        for pair in stated_pairs(mechanism)
    ]
    return {
        **structure_record(structure, mechanism),
        "spatial_mobility": structure.spatial_mobility,
        "local_mobility": structure.local_mobility,
        "pairs": rows,
        "self_aligning": aligned_record(aligned),
    }


def aligned_record(aligned: SelfAligning) -> dict[str, Any]:
    """Return the schemes without redundant constraints, best first; else the reason for none.

    Keys are a joint or pin and the links of the pair, the frame 0; values the classes of
    `planmethod.solved.aligned.schemes`. Where schemes leave local mobilities, ``local_mobility``
    has how many, in the order of the schemes, and the reason; ``sizes`` is there where they are
    random, as the file's close nowhere.
    """
    record: dict[str, Any] = {
        "valid": bool(aligned.schemes),
        "schemes": [dict(scheme) for scheme in aligned.schemes],
        "rank": aligned.rank,
        "groups": [_group(group) for group in aligned.groups],
    }
    if not aligned.schemes:
        links = "; ".join("-".join(group.links) for group in aligned.without)
        record["reason"] = f"no choice of pairs of the links {links} has full rank"
    elif any(aligned.local):
        links = "; ".join("-".join(one.links) for one in aligned.groups if one.schemes[0].local)
        record["local_mobility"] = list(aligned.local)
        record["reason"] = f"every scheme of the links {links} with q = 0 leaves a local mobility"
    if aligned.random:
        record["sizes"] = "random"
    return record


def _group(group: AlignedGroup) -> dict[str, Any]:
    def named(classes: tuple[str, ...]) -> dict[str, str]:
        return dict(zip((pair.key for pair in group.pairs), classes, strict=True))

    return {
        "links": list(group.links),
        "schemes": [named(scheme.classes) for scheme in group.schemes],
        "right_by_count_only": [named(scheme.classes) for scheme in group.counted],
    }
