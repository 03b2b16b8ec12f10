"""A program compiled to one straight line of real arithmetic, for batches of positions.

`write` writes a program on a tape, and a `Runner` runs the tape for any number of positions; how
it does is known to the modules below alone.
"""

from planmethod.compiled.runner import FEW, Array, Runner
from planmethod.compiled.source import javascript_function
from planmethod.compiled.tape import PiecewiseTape, Ref, Symbol, Tape, TapeProgram, write

__all__ = [
    "FEW",
    "Array",
    "PiecewiseTape",
    "Ref",
    "Runner",
    "Symbol",
    "Tape",
    "TapeProgram",
    "javascript_function",
    "write",
]
