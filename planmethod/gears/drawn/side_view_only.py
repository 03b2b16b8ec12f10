"""The side view without velocity diagrams, as in an assignment (схема передачи)."""

from __future__ import annotations

from planmethod.construct.scale import series_near
from planmethod.gears.arrangement import arrange, best_order
from planmethod.gears.drawn.side import SideView
from planmethod.gears.model import GearProblem
from planmethod.gears.motion import solve_motion
from planmethod.gears.scheme import SchemeData
from planmethod.render.ink.drawing import Drawing
from planmethod.render.ink.extent import ink_bounds
from planmethod.render.pictures.lettered import lettered

HEIGHT, LETTERS, EDGE = 110.0, 5.0, 6.0
"""Target height of the scheme, height of its letters, margin around it, mm."""


def draw_scheme(problem: GearProblem) -> Drawing | None:
    """Return the side view of a train, cropped to its content; None where none can be drawn."""
    motion = solve_motion(problem)
    unit = float(motion.train.unit_m)
    whole = SchemeData(motion, unit / float(motion.train.picture.mu_l))
    if whole.undrawn:
        return None
    order = best_order(whole)
    _, low, _, high = ink_bounds(SideView(arrange(whole, order), {}).items())
    mu_l = series_near(float(motion.train.picture.mu_l) * (high - low) / HEIGHT, up=True)
    side = SideView(arrange(SchemeData(motion, unit / mu_l), order), {})
    picture = lettered(side.items(), list(side.labels(LETTERS)))
    drawing = Drawing(picture.width + 2 * EDGE, picture.height + 2 * EDGE, problem.title)
    drawing.extend(picture.place(complex(EDGE, picture.height + EDGE)))
    return drawing
