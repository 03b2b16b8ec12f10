"""Gear trains: read, solved in fractions, told (зубчатые механизмы).

The four functions of a kind of problem (`planmethod.kinds`) stand here.
"""

from planmethod.gears.answers import published_values
from planmethod.gears.driving import driven
from planmethod.gears.reader import load
from planmethod.gears.record import record, structure_record
from planmethod.gears.text import solved_text, structure_text

__all__ = [
    "driven",
    "load",
    "published_values",
    "record",
    "solved_text",
    "structure_record",
    "structure_text",
]
