"""A program compiled to one straight line of real arithmetic, for batches of positions.

`write` writes a program on a tape, and a `Runner` runs the tape for any number of positions; how
it does is known to the modules below alone.
"""

from planmethod.compiled.runner import FEW, Array, Runner
from planmethod.compiled.tape import Ref, Symbol, TapeProgram, write

__all__ = ["FEW", "Array", "Ref", "Runner", "Symbol", "TapeProgram", "write"]
