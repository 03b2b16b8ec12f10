"""Printed values of a moving point beside the exact and the measured ones (сверка)."""

from __future__ import annotations

import numpy as np
from msgspec.structs import replace

from planmethod.construct.drafting import PROFILES
from planmethod.moving.construction import construct
from planmethod.moving.interval import drawn_interval
from planmethod.moving.model import PointProblem
from planmethod.moving.motion import Undefined, move
from planmethod.moving.sheet import sheet_scales
from planmethod.note.audit.audit import Audited
from planmethod.solved.selectors.steps import NoValue


def audited(problem: PointProblem, ruler: float) -> list[Audited]:
    """Compare every printed value with the exact one, and with that read off the drawing.

    Parameters
    ----------
    ruler : float, mm
        Step to which lengths are read; the scales are those of the sheet.
    """
    if not problem.published:
        return []
    motion, profile = move(problem), replace(PROFILES["board"], ruler=ruler)
    scales = sheet_scales(problem, drawn_interval(problem), profile)
    told = []
    for item in problem.published:
        k = item.position or 0
        if not item.what:
            told.append(Audited(item, reason=NoValue.NO_QUANTITY))
            continue
        exact = float(motion.columns[item.what][k])
        if np.isnan(exact):
            divided = motion.reasons[k] in (Undefined.REST, Undefined.STRAIGHT)
            told.append(Audited(item, reason=NoValue.ZERO_DIVISOR if divided else NoValue.NO_POINT))
            continue
        built = construct(problem, motion, k, scales)
        read = built.ruled(ruler).get(item.what, np.nan) if built is not None else np.nan
        plan = item.what[0] if item.what != "rho" else ""
        per_mm = scales[plan].per_mm if plan in scales else None
        told.append(Audited(item, exact, None if np.isnan(read) else read, per_mm))
    return told
