"""Read a file with ``[meshing]``: every fault at once (чтение файла задачи)."""

from __future__ import annotations

from collections.abc import Mapping
from math import cos, radians
from pathlib import Path
from typing import Any

import numpy as np

from planmethod.errors import ProblemError
from planmethod.gears.angles import involute
from planmethod.gears.involute.blocking import (
    HIGH,
    LOW,
    LimitKind,
    candidate_shifts,
    choose,
    limits,
    meets_limits,
)
from planmethod.gears.involute.profile import Tooth
from planmethod.gears.involute.sizes import MeshingProblem, Pair, Rack, ShiftAim
from planmethod.languages import translate
from planmethod.problem import fields
from planmethod.problem.fields import Faults
from planmethod.problem.flat_tables import CustomReader, read_flat
from planmethod.problem.reader import varied
from planmethod.problem.sheet import read_head
from planmethod.problem.tables import MESHING_EXAMPLE, MESHING_HINT, MeshingSection

TOP = ("title", "source", "units", "stamp", "sheet", "variants", "meshing")
"""Tables of the file that a meshing may have."""

AIMS = tuple(aim.value for aim in ShiftAim)
"""Words in place of the shifts: criteria of their choice within the blocking limits."""

CUTTER = 20
"""Teeth of the pinion cutter where the file does not say."""

_SHIFT_EXAMPLES = (
    'Give x = [0.5, 0.3], x = "blocking", or a_w = 110 (mm), with x1 or x2 beside it or alone.'
)


def load(path: str | Path, *, variant: str | None = None) -> MeshingProblem:
    """Read a file with ``[meshing]``; of one with a linkage, too, that table and the title block.

    Raises
    ------
    ProblemError
        With every fault of the file; wheels that cannot be cut or do not mesh are faults, too.
    """
    path = Path(path)
    table, variants, faults = varied(path, variant)
    if "links" in table:
        table = {key: value for key, value in table.items() if key in TOP}
    given = fields.read_keys(faults, "", table, TOP)
    head = read_head(faults, given)
    body = fields.read_table(faults, "meshing", given.get("meshing", {}), MESHING_EXAMPLE)
    told = None if body is None else _read(faults, body)
    if faults or told is None:
        raise ProblemError(str(path), faults.listed)
    problem = MeshingProblem(
        name=path.stem, source_file=str(path), variants=variants, variant=variant, **head, **told
    )
    _check_teeth(faults, Pair.of(problem))
    if faults:
        raise ProblemError(str(path), faults.listed)
    return problem


def _read(faults: Faults, body: Mapping[str, Any]) -> dict[str, Any] | None:
    """Return the fields of a problem from its table."""
    own: dict[str, CustomReader] = {"z": _read_teeth, "a_w": _read_size, "b": _read_size}
    found = read_flat(faults, "meshing", body, MeshingSection, own, example=MESHING_EXAMPLE)
    x = _read_shifts(faults, body)
    if faults:
        return None
    given = MeshingSection(**found | {"x": x})
    rack = Rack(radians(given.alpha), given.ha, given.c)
    if rack.half_tip <= 0.0:
        most = (np.pi / 4) / np.tan(rack.alpha)
        faults.add(
            "meshing",
            translate(
                "the rack's tooth ends before its tip: ha + c = {:g}, at {:g}° at most {:.3f}",
                given.ha + given.c,
                given.alpha,
                most,
            ),
            "The standard rack has alpha = 20, ha = 1, c = 0.25.",
        )
        return None
    cutter = _cutter(faults, given)
    if cutter is None:
        return None
    z = given.z
    if cutter and given.beta:
        what = "only spur internal pairs are supported"
        faults.add("meshing.beta", what, "Leave beta out.")
        return None
    beta = radians(given.beta)
    pair = Pair((z[0], -z[1] if cutter else z[1]), given.m, rack, np.zeros(2), cutter, beta)
    aim = None
    if x is None and given.x1 is given.x2 is None:
        aim = ShiftAim(body.get("x", ShiftAim.BLOCKING.value))
    settled = _resolve_shifts(faults, pair, given, aim or ShiftAim.BLOCKING)
    return settled and {
        "z": z,
        "m": given.m,
        "rack": rack,
        "x": settled,
        "aim": aim,
        "a_w": given.a_w,
        "cutter": cutter,
        "beta": beta,
        "width": given.b,
        "tip": given.s_a_min,
        "overlap": given.epsilon_min,
        "shift_wheel": 0 if given.x1 is not None else None if given.x2 is None else 1,
    }


_SIZES = {"a_w": (0.1, 1e5), "b": (0.05, 1e4)}
"""Bounds of the sizes that are lengths of the machine, mm."""


def _read_size(faults: Faults, path: str, value: object) -> float | None:
    """Read a length, mm: as the standard has it, or in the unit that the file says."""
    low, high = _SIZES[path.rpartition(".")[2]]
    if faults.unit not in ("m", "mm"):
        metres = fields.read_metres(
            faults, path, value, "distance", low=low / 1000.0, high=high / 1000.0
        )
        return None if metres is None else metres * 1000.0
    what = "a distance in mm" if path.endswith("a_w") else "a width in mm"
    return fields.read_number(faults, path, value, what, low=low, high=high, hint=MESHING_HINT)


def _read_teeth(faults: Faults, path: str, value: object) -> tuple[int, int] | None:
    if not isinstance(value, list) or len(value) != 2:
        faults.expected("meshing.z", "two numbers of teeth", value, "z = [12, 30]")
        return None
    if any(isinstance(one, int) and one < 0 for one in value):
        hint = "Write z = [20, 60] and internal = true."
        faults.add("meshing.z", "teeth of an internal pair are positive here", hint)
        return None
    found = [
        fields.read_integer(faults, f"meshing.z[{i}]", one, 5, 1000) for i, one in enumerate(value)
    ]
    one, two = found
    return None if one is None or two is None else (one, two)


def _cutter(faults: Faults, table: MeshingSection) -> int | None:
    """Return the teeth of the cutter of an internal wheel, 0 of an external one; None: a fault."""
    if not table.internal:
        if table.cutter is not None:
            faults.add("meshing.cutter", "goes with internal = true", "Leave it out.")
            return None
        return 0
    teeth = CUTTER if table.cutter is None else table.cutter
    if table.z[1] - max(table.z[0], teeth) < 1:
        what = translate(
            "a ring of {} teeth, a wheel of {}, a cutter of {}", table.z[1], table.z[0], teeth
        )
        faults.add("meshing.z", what, "The second wheel is the ring, with the most teeth.")
        return None
    return teeth


def _read_shifts(faults: Faults, table: Mapping[str, Any]) -> tuple[float, float] | None:
    """Read ``x``; None where the limits or the centre distance determine the shifts."""
    alone = [key for key in ("x1", "x2") if key in table]
    value = table.get("x")
    if isinstance(value, list):
        if len(value) != 2:
            faults.expected("meshing.x", "two shifts", value, "x = [0.5, 0.3]")
            return None
        for key in (*alone, *(["a_w"] if "a_w" in table else [])):
            faults.add(f"meshing.{key}", "both shifts are given in x", "Keep one of them.")
        found = [
            fields.read_number(
                faults, f"meshing.x[{i}]", one, "a shift in modules", low=-2.0, high=3.0
            )
            for i, one in enumerate(value)
        ]
        one, two = found
        return None if one is None or two is None else (one, two)
    if "x" in table and not (isinstance(value, str) and value in AIMS):
        wanted = "two shifts, 'blocking', 'equal-sliding' or 'contact-ratio'"
        faults.expected("meshing.x", wanted, value, _SHIFT_EXAMPLES)
    elif "x" in table:
        for key in alone:
            what = translate('both shifts are chosen by x = "{}"', value)
            faults.add(f"meshing.{key}", what, _SHIFT_EXAMPLES)
    elif "a_w" not in table:
        faults.add("meshing.x", "missing", _SHIFT_EXAMPLES)
    elif len(alone) == 2:
        faults.add("meshing.x2", "a_w and x1 already determine it", "Leave one of the three out.")
    return None


def _resolve_shifts(
    faults: Faults, pair: Pair, table: MeshingSection, aim: ShiftAim
) -> tuple[float, float] | None:
    """Return the shifts: as given, from the centre distance, or chosen."""
    if table.x is not None:
        return table.x
    tip, overlap, a_w = table.s_a_min, table.epsilon_min, table.a_w
    total = None
    if a_w is not None:
        least = abs(pair.a) * cos(pair.alpha_t)
        if a_w <= least:
            what = translate("{:g} mm, the base circles meet at a·cos α = {:.3f} mm", a_w, least)
            faults.add(
                "meshing.a_w", what, translate("Without shifts it is a = {:g} mm.", abs(pair.a))
            )
            return None
        alpha_w = float(np.arccos(least / a_w))
        grown = float(involute(alpha_w) - involute(pair.alpha_t))
        total = grown * abs(sum(pair.z)) / (2 * float(np.tan(pair.rack.alpha)))
        if table.x1 is not None:
            return table.x1, total - pair.side * table.x1
        if table.x2 is not None:
            return pair.side * (total - table.x2), table.x2
    asked = limits(tip, overlap, internal=bool(pair.cutter))
    found = choose(pair, asked, total, aim)
    if found is None and aim is not ShiftAim.BLOCKING and choose(pair, asked, total) is not None:
        what = "no shifts that meet all limits have equal specific sliding"
        faults.add("meshing.x", what, 'Take x = "blocking", or another a_w.')
    elif found is None:
        faults.add("meshing.x", *_explain_no_shifts(pair, total, tip, overlap))
    return found


def _explain_no_shifts(
    pair: Pair, total: float | None, tip: float, overlap: float
) -> tuple[str, str]:
    """Return which limit contradicts the others, and a hint."""
    with np.errstate(all="ignore"):
        every = pair.shifted(candidate_shifts(total, pair.side))
        asked = limits(tip, overlap, internal=bool(pair.cutter))
        others = tuple(one for one in asked if one.kind is not LimitKind.OVERLAP)
        most = np.max(np.where(meets_limits(every, others), every.epsilon, 0.0))
    sum_of = "x2 - x1" if pair.cutter else "x1 + x2"
    fixed = "" if total is None else translate(", {} being {:.4f} by a_w", sum_of, total)
    what = translate("no shifts from {:g} to {:g} meet all limits{}", LOW, HIGH, fixed)
    if most >= 1:
        hint = (
            "If the others are met, ε_α is at most {:.3f}: give a smaller epsilon_min than "
            "{:g}, or x."
        )
        return what, translate(hint, most, overlap)
    return what, translate("Give a smaller s_a_min than {:g}, other teeth, or x = [.., ..].", tip)


def _check_teeth(faults: Faults, pair: Pair) -> None:
    """Report faults that keep the wheels from being cut or from meshing."""
    total = float(pair.x_sum)
    if not float(pair.inv_alpha_w) >= 0:
        least = abs(sum(pair.z)) * float(involute(pair.alpha_t)) / (2 * np.tan(pair.rack.alpha))
        sum_of = "x2 - x1" if pair.cutter else "x1 + x2"
        what = translate(
            "{} = {:g}: such wheels cannot come that close to each other", sum_of, pair.side * total
        )
        faults.add("meshing.x", what, translate("It must be at least {:.4f}.", -least))
        return
    for k in (0, 1):
        tooth = Tooth(pair, k)
        sizes = {name: abs(tooth.size(name)) for name in ("d_a", "d_b", "d_f")}
        phrase = ", ".join(f"{name} = {value:.3f} mm" for name, value in sizes.items())
        if not np.isfinite(tooth.size("rho_a")) or sizes["d_f"] <= 0:
            what = translate("wheel {} has no involute teeth: {}", k + 1, phrase)
            hint = "Take a larger x{}."
            if tooth.side < 0:
                hint = "Take a larger x{}, or more teeth of the ring."
            faults.add("meshing.x", what, translate(hint, k + 1))
        elif not tooth.exists and tooth.side < 0:
            what = translate("the cutter leaves no tooth of wheel {}: {}", k + 1, phrase)
            faults.add("meshing.cutter", what, "Take another number of its teeth.")
        elif not tooth.exists and not tooth.is_cut:
            what = "the tooth of wheel {0} is pointed below its involute: x{0} = {1:g}"
            what = translate(what, k + 1, pair.x[k])
            faults.add("meshing.x", what, translate("Take a smaller x{}.", k + 1))
        elif not tooth.exists:
            what = translate(
                "the rack cuts the tooth of wheel {0} off: x{0} = {1:g}", k + 1, pair.x[k]
            )
            hint = translate("Without undercut x{} is at least {:.3f}.", k + 1, tooth.size("x_min"))
            faults.add("meshing.x", what, hint)
