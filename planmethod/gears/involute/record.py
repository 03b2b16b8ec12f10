"""JSON record of a pair of wheels (запись для JSON)."""

from __future__ import annotations

from typing import Any

from planmethod.gears.involute.quantities import SolvedMeshing
from planmethod.gears.involute.sizes import MeshingProblem
from planmethod.gears.record import head
from planmethod.note.numbers import finite_or_none
from planmethod.note.plaintext import plain_text
from planmethod.note.records.legend import legend_record
from planmethod.note.wording import get_language


def record(problem: MeshingProblem, lang: str) -> dict[str, Any]:
    """Return one object for a problem: the standard's names, mm and degrees, full precision."""
    solved, language = SolvedMeshing(problem), get_language(lang)
    told: dict[str, Any] = {"length": "mm", "angle": "deg", "shifts_chosen": problem.chosen}
    told["criterion"] = None if problem.aim is None else problem.aim.value
    for group in solved.sized_quantities():
        for one in group:
            values = [finite_or_none(value) for value in one.values]
            told[one.quantity.key] = values[0] if len(values) == 1 else values
    told["k"] = [int(k) for k in told["k"]]
    told["z"] = list(problem.z)
    told["undercut"] = [tooth.is_cut for tooth in solved.teeth]
    told["cutting"] = [
        one
        and {
            "displacement": one.displacement,
            "clearance": one.clearance,
            "boundary_rho": one.boundary,
            "undercut_displacement": one.min_displacement,
            "undercut_diameter": one.cut_diameter,
        }
        for one in solved.cuttings
    ]
    told["conditions"] = [
        {
            "name": limit.kind.value,
            "wheel": None if limit.wheel is None else limit.wheel + 1,
            "value": solved.standard_values(limit, value, bound)[0],
            "limit": solved.standard_values(limit, value, bound)[1],
            "holds": holds,
            "text": plain_text(text),
        }
        for (limit, holds, text), (_, value, bound) in zip(
            solved.sentences(language), solved.evaluated_limits(), strict=True
        )
    ]
    told["internal"] = bool(problem.cutter)
    if problem.cutter:
        pair = solved.pair
        told |= {"z_0": problem.cutter, "a_w0": float(pair.a_w0), "d_a0": pair.d_a0}
    missing = [k for k, value in enumerate(told["theta_p"]) if value is None]
    if missing:
        told["theta_reason"] = language.meshing.missing.format(wheel=missing[0] + 1)
    sizes = [one.quantity for group in solved.sized_quantities() for one in group]
    legend = ((one.key, one.symbols, one.unit.in_record) for one in sizes)
    return {**head(problem), "meshing": told, "legend": legend_record(legend)}
