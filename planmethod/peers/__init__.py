"""Mechanisms of other programs: PMKS+, Linkage, pylinkage, Pyslvs (файлы других программ).

Each format has a module: a reader makes a `ForeignMechanism`, and `planmethod.peers.table` makes
the table of its problem file. No file is executed; data that is not understood is named.
"""

# no messages: the interface

from planmethod.peers.formats import Imported, load, loads
from planmethod.peers.pylinkage_writer import to_pylinkage
from planmethod.peers.script import to_script

__all__ = ["Imported", "load", "loads", "to_pylinkage", "to_script"]
