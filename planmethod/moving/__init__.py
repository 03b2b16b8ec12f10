"""The moving point: its law as formulas, velocity, acceleration and curvature (движение точки).

The functions of a kind of problem (`planmethod.kinds`) stand here.
"""

from planmethod.moving.reader import load
from planmethod.moving.record import record
from planmethod.moving.text import solved_text

__all__ = ["load", "record", "solved_text"]
