"""Two wheels with involute teeth: sizes, limits, profiles, the sheet (эвольвентное зацепление).

The functions of a kind of problem (`planmethod.kinds`) stand here.
"""

from planmethod.gears.involute.reader import load
from planmethod.gears.involute.record import record
from planmethod.gears.involute.text import protocol_text, solved_text

__all__ = ["load", "protocol_text", "record", "solved_text"]
