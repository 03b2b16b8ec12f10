"""Position and motion of the driving link in each position (движение начального звена)."""

from __future__ import annotations

import numpy as np

from planmethod.problem.model import CamDrive, Drive, LawPiece
from planmethod.solved.reading import Reals

_JUMP_TOLERANCE = 1e-12 * 2 * np.pi  # rad before a jump that are after it: rounding of its angle
_NEAR_DEG = 1e-3
_ZERO_RATE = 1e-14  # of the stroke: rounding error of the angle in a rate that is zero


def driven(drive: Drive, positions: Reals) -> tuple[Reals, float | Reals, float | Reals]:
    """Return place, rate and acceleration of the driving link.

    Parameters
    ----------
    positions : ndarray of shape (n,)
        Of the driver: what its link has itself, or angles of the cam, degrees.

    Returns
    -------
    place : ndarray of shape (n,)
        Degrees, or m.
    rate, acceleration : float or ndarray of shape (n,)
        1/s and 1/s², or m/s and m/s²: of each position where a cam's follower drives.
    """
    if drive.cam_drive is None:
        return positions, drive.rate, drive.acceleration
    way, first, second = follower_motion(drive.cam_drive, positions)
    place = drive.cam_drive.lowest + (np.degrees(way) if drive.cam_drive.turns else way)
    return place, first * drive.rate, second * drive.rate**2 + first * drive.acceleration


def follower_motion(cam: CamDrive, positions: Reals) -> Reals:
    """Return way, v_q and a_q of a follower, m or rad, shape (3, n); after a jump."""
    turned = np.radians(positions) % (2 * np.pi)
    starts = np.array([piece.start for piece in cam.pieces])
    which = np.searchsorted(starts, turned + _JUMP_TOLERANCE, side="right") - 1
    found = np.empty((3, *turned.shape))
    for k in np.unique(which):
        here = which == k
        found[:, here] = _on(cam.pieces[k], turned[here] - starts[k])
    size = max(abs(piece.powers[0]) + abs(piece.size) for piece in cam.pieces)
    found[1, np.abs(found[1]) < _ZERO_RATE * size] = 0.0
    return found


def _on(piece: LawPiece, x: Reals) -> Reals:
    """Return the way on a piece and both its derivatives, shape (3, n)."""
    power = np.polynomial.Polynomial(piece.powers)
    turn = piece.rate * x + piece.phase
    wave = piece.size * np.array(
        [np.sin(turn), piece.rate * np.cos(turn), -(piece.rate**2) * np.sin(turn)]
    )
    return np.asarray(wave + np.array([power(x), power.deriv()(x), power.deriv(2)(x)]))


def near_piece(drive: Drive, position: float) -> float:
    """Return the start of a piece of the cam's law that a position is at but for rounding, degrees.

    A follower that has rested leaves its place so slowly that the root of its rate is rough.
    """
    for piece in drive.cam_drive.pieces if drive.cam_drive is not None else ():
        start = float(np.degrees(piece.start))
        away = (position - start + 180.0) % 360.0 - 180.0
        if abs(away) < _NEAR_DEG:
            return position - away if start else round((position - away) / 360.0) * 360.0
    return position
