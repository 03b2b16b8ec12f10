"""Read a file with ``[meshing]``: every fault at once (чтение файла задачи)."""

from __future__ import annotations

from math import cos, radians
from pathlib import Path
from typing import Any

import numpy as np

from planmethod.errors import ProblemError
from planmethod.gears.angles import involute
from planmethod.gears.involute.geometry import MeshingProblem, Pair, Rack, ShiftAim, Tooth
from planmethod.gears.involute.results import (
    HIGHEST_SHIFT,
    LOWEST_SHIFT,
    LimitKind,
    candidate_shifts,
    choose,
    limits,
    meets_limits,
)
from planmethod.languages import translate
from planmethod.problem.file_node import FileNode
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
    file, variants = varied(path, variant)
    if "links" in file:
        file = file.with_value({key: file.value[key] for key in file.value if key in TOP})
    file.allow(TOP)
    head = read_head(file)
    node = file.get("meshing", {})
    meshing = node.attempt(_read)
    if file.faults or meshing is None:
        raise ProblemError(str(path), file.faults.listed)
    problem = MeshingProblem(
        name=path.stem, source_file=str(path), variants=variants, variant=variant, **head, **meshing
    )
    _check_teeth(node, Pair.of(problem))
    if file.faults:
        raise ProblemError(str(path), file.faults.listed)
    return problem


def _read(node: FileNode) -> dict[str, Any]:
    """Return the fields of a problem from its table."""
    node.table(MESHING_EXAMPLE)
    found = node.record(
        MeshingSection, example=MESHING_EXAMPLE, z=_read_teeth, a_w=_read_size, b=_read_size
    )
    x = node.attempt(_read_shifts)
    node.require_sound()
    given = MeshingSection(**found | {"x": x})
    rack = Rack(radians(given.alpha), given.ha, given.c)
    if rack.half_tip <= 0.0:
        most = (np.pi / 4) / np.tan(rack.alpha)
        message = "the rack's tooth ends before its tip: ha + c = {:g}, at {:g}° at most {:.3f}"
        hint = "The standard rack has alpha = 20, ha = 1, c = 0.25."
        node.reject(message, given.ha + given.c, given.alpha, most, hint=hint)
    cutter, z = _cutter(node, given), given.z
    if cutter and given.beta:
        node["beta"].reject("only spur internal pairs are supported", hint="Omit beta.")
    beta = radians(given.beta)
    pair = Pair((z[0], -z[1] if cutter else z[1]), given.m, rack, np.zeros(2), cutter, beta)
    aim = None
    if x is None and given.x1 is given.x2 is None:
        aim = ShiftAim(node.get("x", ShiftAim.BLOCKING.value).value)
    return {
        "z": z,
        "m": given.m,
        "rack": rack,
        "x": _resolve_shifts(node, pair, given, aim or ShiftAim.BLOCKING),
        "aim": aim,
        "a_w": given.a_w,
        "cutter": cutter,
        "beta": beta,
        "width": given.b,
        "tip": given.s_a_min,
        "overlap": given.epsilon_min,
        "shift_wheel": 0 if given.x1 is not None else None if given.x2 is None else 1,
    }


_SIZES = {"a_w": ("a distance in mm", 0.1, 1e5), "b": ("a width in mm", 0.05, 1e4)}
"""Sizes that are lengths of the machine, and their bounds, mm."""


def _read_size(node: FileNode) -> float:
    """Read a length, mm: as the standard has it, or in the unit that the file says."""
    what, low, high = _SIZES[str(node.key)]
    if node.faults.unit not in ("m", "mm"):
        return node.metres("distance", low=low / 1000.0, high=high / 1000.0) * 1000.0
    return node.number(what, low, high, hint=MESHING_HINT)


def _read_teeth(node: FileNode) -> tuple[int, int]:
    node.array("two numbers of teeth", "z = [12, 30]", low=2, high=2)
    if any(isinstance(one, int) and one < 0 for one in node.value):
        hint = "Write z = [20, 60] and internal = true."
        node.reject("teeth of an internal pair are positive here", hint=hint)
    one, two = node.read_all(lambda teeth: teeth.integer(5, 1000))
    return one, two


def _cutter(node: FileNode, table: MeshingSection) -> int:
    """Return the teeth of the cutter of an internal wheel, 0 of an external one."""
    if not table.internal:
        if table.cutter is not None:
            node["cutter"].reject("valid only with internal = true", hint="Omit it.")
        return 0
    teeth = CUTTER if table.cutter is None else table.cutter
    if table.z[1] - max(table.z[0], teeth) < 1:
        message = "a ring of {} teeth, a wheel of {}, a cutter of {}"
        hint = "The second wheel is the ring, with the most teeth."
        node["z"].reject(message, table.z[1], table.z[0], teeth, hint=hint)
    return teeth


def _read_shifts(node: FileNode) -> tuple[float, float] | None:
    """Read ``x``; None where the limits or the centre distance determine the shifts."""
    alone = [key for key in ("x1", "x2") if key in node]
    x = node["x"]
    if isinstance(x.value, list):
        x.array("two shifts", "x = [0.5, 0.3]", low=2, high=2)
        for key in (*alone, *(["a_w"] if "a_w" in node else [])):
            node[key].note("both shifts are given in x", hint="Keep one of them.")
        one, two = x.read_all(lambda shift: shift.number("a shift in modules", -2.0, 3.0))
        return one, two
    if "x" in node and not (isinstance(x.value, str) and x.value in AIMS):
        wanted = "two shifts, 'blocking', 'equal-sliding' or 'contact-ratio'"
        x.reject_value(wanted, _SHIFT_EXAMPLES)
    if "x" in node:
        for key in alone:
            message = 'both shifts are chosen by x = "{}"'
            node[key].note(message, x.value, hint=_SHIFT_EXAMPLES)
    elif "a_w" not in node:
        x.reject("missing", hint=_SHIFT_EXAMPLES)
    elif len(alone) == 2:
        hint = "Omit one of the three."
        node["x2"].reject("a_w and x1 already determine it", hint=hint)
    return None


def _resolve_shifts(
    node: FileNode, pair: Pair, table: MeshingSection, aim: ShiftAim
) -> tuple[float, float]:
    """Return the shifts: as given, from the centre distance, or chosen."""
    if table.x is not None:
        return table.x
    tip, overlap, a_w = table.s_a_min, table.epsilon_min, table.a_w
    total = None
    if a_w is not None:
        least = abs(pair.a) * cos(pair.alpha_t)
        if a_w <= least:
            message = "{:g} mm, the base circles meet at a·cos α = {:.3f} mm"
            hint = translate("Without shifts it is a = {:g} mm.", abs(pair.a))
            node["a_w"].reject(message, a_w, least, hint=hint)
        alpha_w = float(np.arccos(least / a_w))
        grown = float(involute(alpha_w) - involute(pair.alpha_t))
        total = grown * abs(sum(pair.z)) / (2 * float(np.tan(pair.rack.alpha)))
        if table.x1 is not None:
            return table.x1, total - pair.side * table.x1
        if table.x2 is not None:
            return pair.side * (total - table.x2), table.x2
    bounds = limits(tip, overlap, internal=bool(pair.cutter))
    found = choose(pair, bounds, total, aim)
    if found is None:
        if aim is not ShiftAim.BLOCKING and choose(pair, bounds, total) is not None:
            message = "no shifts that meet all limits have equal specific sliding"
            node["x"].reject(message, hint='Use x = "blocking", or another a_w.')
        message, hint = _explain_no_shifts(pair, total, tip, overlap)
        node["x"].reject(message, hint=hint)
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
    what = translate(
        "no shifts from {:g} to {:g} meet all limits{}", LOWEST_SHIFT, HIGHEST_SHIFT, fixed
    )
    if most >= 1:
        hint = (
            "If the others are met, ε_α is at most {:.3f}: give a smaller epsilon_min than "
            "{:g}, or x."
        )
        return what, translate(hint, most, overlap)
    return what, translate("Give a smaller s_a_min than {:g}, other teeth, or x = [.., ..].", tip)


def _check_teeth(node: FileNode, pair: Pair) -> None:
    """Note faults that keep the wheels from being cut or from meshing."""
    total, x = float(pair.x_sum), node["x"]
    if not float(pair.inv_alpha_w) >= 0:
        least = abs(sum(pair.z)) * float(involute(pair.alpha_t)) / (2 * np.tan(pair.rack.alpha))
        sum_of = "x2 - x1" if pair.cutter else "x1 + x2"
        hint = translate("It must be at least {:.4f}.", -least)
        message = "{} = {:g}: such wheels cannot come that close to each other"
        x.note(message, sum_of, pair.side * total, hint=hint)
        return
    for k in (0, 1):
        tooth = Tooth(pair, k)
        sizes = {name: abs(tooth.size(name)) for name in ("d_a", "d_b", "d_f")}
        phrase = ", ".join(f"{name} = {value:.3f} mm" for name, value in sizes.items())
        if not np.isfinite(tooth.size("rho_a")) or sizes["d_f"] <= 0:
            hint = "Increase x{}."
            if tooth.side < 0:
                hint = "Increase x{}, or the number of teeth of the ring."
            message = "wheel {} has no involute teeth: {}"
            x.note(message, k + 1, phrase, hint=translate(hint, k + 1))
        elif not tooth.exists and tooth.side < 0:
            message = "the cutter leaves no tooth of wheel {}: {}"
            hint = "Choose another number of teeth for it."
            node["cutter"].note(message, k + 1, phrase, hint=hint)
        elif not tooth.exists and not tooth.is_cut:
            message = "the tooth of wheel {0} is pointed below its involute: x{0} = {1:g}"
            x.note(message, k + 1, pair.x[k], hint=translate("Decrease x{}.", k + 1))
        elif not tooth.exists:
            hint = translate("Without undercut x{} is at least {:.3f}.", k + 1, tooth.size("x_min"))
            message = "the rack cuts the tooth of wheel {0} off: x{0} = {1:g}"
            x.note(message, k + 1, pair.x[k], hint=hint)
