"""Cams on one shaft (кулачковый вал), and the cyclogram of their followers (циклограмма).

The angle of the shaft counts from the position in which its key points up the sheet. The turn of a
cam begins at its phase: the own angle of the cam is that of the shaft less the phase. A cam of
phase 40° is thus set on the shaft with its zero ray 40° behind the key, against the rotation.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from typing import NamedTuple

import numpy as np

from planmethod.cams.design import CamDesign, design_of
from planmethod.cams.laws import Reals
from planmethod.cams.model import TURN, CamMotion, CamProblem
from planmethod.problem.records import KindProblem

_SAME = 1e-9
"""Angles of the shaft that differ by less are one, rad."""


class PhaseSpan(NamedTuple):
    """A motion or a dwell by angles of the shaft (фаза на циклограмме).

    Attributes
    ----------
    start, end : float, rad
        Within one turn of the shaft. A phase that continues in the next turn has two spans.
    motion : CamMotion
    is_continued : bool
        The span goes on from the end of the turn before.
    """

    start: float
    end: float
    motion: CamMotion
    is_continued: bool


class Camshaft(KindProblem, frozen=True, kw_only=True, dict=True):
    """Cams on one shaft (кулачковый вал).

    Attributes
    ----------
    cams : tuple of CamProblem
        Each with its phase; ``name`` is the name of the cam.
    """

    cams: tuple[CamProblem, ...]

    @property
    def n(self) -> float | None:
        """Speed of the shaft, rev/min, counter-clockwise positive; None where none is given."""
        return self.cams[0].n

    @property
    def count(self) -> int:
        """Number of positions of a turn."""
        return max(cam.count for cam in self.cams)

    def angles(self) -> Reals:
        """Return the angles of the shaft in the positions, rad."""
        return TURN * np.arange(self.count) / self.count

    @cached_property
    def designs(self) -> tuple[CamDesign, ...]:
        """The cams with their sizes."""
        return tuple(map(design_of, self.cams))


def phase_of(cam: CamProblem) -> float:
    """Return the phase of a cam, rad; 0 of one that is alone."""
    return cam.phase or 0.0


def motion_on_shaft(cam: CamProblem, phi: Reals) -> Reals:
    """Return s, v_q, a_q at angles of the shaft, rad: m, shape (3, n)."""
    return cam.at((phi - phase_of(cam)) % TURN)


def spans_of(cam: CamProblem) -> tuple[PhaseSpan, ...]:
    """Return the motions and dwells of a cam over a turn of the shaft, in their order."""
    return tuple(sorted(_spans(cam)))


def _spans(cam: CamProblem) -> Iterator[PhaseSpan]:
    for motion in cam.motions:
        start = (motion.start + phase_of(cam)) % TURN
        start = 0.0 if TURN - start < _SAME else start
        end = start + motion.length
        if end <= TURN + _SAME:
            yield PhaseSpan(start, min(end, TURN), motion, is_continued=False)
            continue
        yield PhaseSpan(start, TURN, motion, is_continued=False)
        yield PhaseSpan(0.0, end - TURN, motion, is_continued=True)
