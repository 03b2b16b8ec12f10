"""The graphical plan method of the theory of mechanisms (метод планов).

Public names: `Mechanism` builds a linkage, `load` and `loads` read a problem file, `solve` computes
it, `Sweep` computes many positions of it, `draw` makes its sheets, `document` describes its
construction; `gears`, `meshing`, `cams`, `moving` load other kinds of problem, `peers` files of
other programs. They are imported on first use (PEP 562): Python imports this package before any of
its modules, and a command that needs none of these, or only one, would wait a quarter of a second
for NumPy, the sheets and their dependencies.
"""

# no messages: for programs in Python

from __future__ import annotations

TYPE_CHECKING = False  # not of typing: its import is a tenth of the way to the command line
if TYPE_CHECKING:
    from planmethod import cams as cams, gears as gears, moving as moving, peers as peers
    from planmethod.gears import involute as meshing
    from planmethod.linkages.reading import load as load, loads as loads
    from planmethod.note.protocol import document_of as document
    from planmethod.problem import Problem as Problem
    from planmethod.render.sheets.kinematics import kinematics_sheets as draw
    from planmethod.scripting.mechanism import Mechanism as Mechanism
    from planmethod.scripting.solution import Solution as Solution, solve as solve
    from planmethod.solved.errors.motion import drafting_of as drafting
    from planmethod.solved.many.sweep import Sweep as Sweep
    from planmethod.solved.selfcheck import judged_statics as statics

if TYPE_CHECKING:
    from typing import Any

__all__ = [
    "Mechanism",
    "Problem",
    "Solution",
    "Sweep",
    "cams",
    "document",
    "drafting",
    "draw",
    "gears",
    "load",
    "loads",
    "meshing",
    "moving",
    "peers",
    "solve",
    "statics",
]

_HOMES = {
    "Mechanism": "planmethod.scripting.mechanism:Mechanism",
    "Problem": "planmethod.problem:Problem",
    "Solution": "planmethod.scripting.solution:Solution",
    "Sweep": "planmethod.solved.many.sweep:Sweep",
    "document": "planmethod.note.protocol:document_of",
    "cams": "planmethod.cams",
    "drafting": "planmethod.solved.errors.motion:drafting_of",
    "draw": "planmethod.render.sheets.kinematics:kinematics_sheets",
    "gears": "planmethod.gears",
    "load": "planmethod.linkages.reading:load",
    "loads": "planmethod.linkages.reading:loads",
    "meshing": "planmethod.gears.involute",
    "moving": "planmethod.moving",
    "peers": "planmethod.peers",
    "solve": "planmethod.scripting.solution:solve",
    "statics": "planmethod.solved.selfcheck:judged_statics",
}
"""Locations of the public names; a test compares them with those under `TYPE_CHECKING`."""


if not TYPE_CHECKING:  # type checkers see the imports above

    def __getattr__(name: str) -> Any:
        """Import a public name on first use."""
        if name not in _HOMES:
            raise AttributeError(f"module 'planmethod' has no attribute {name!r}")
        from pkgutil import resolve_name

        return resolve_name(_HOMES[name])
