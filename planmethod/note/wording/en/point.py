"""Words of the moving point in English (движение точки по-английски)."""

from planmethod.note.wording.point_model import PointWording

POINT = PointWording(
    circle="along a circle of radius {radius} m, from the point (R, 0) counter-clockwise",
    line="along the x axis",
    at="At the moment t = {time} s",
    reasons={
        "position undefined": "the formulas of the coordinates have no value",
        "velocity undefined": "there is no velocity: the coordinates have no derivative",
        "acceleration undefined": "there is no acceleration: no second derivative",
        "at rest": "the point is at rest, a_τ, a_n and ρ are not defined",
        "straight": "a_n = 0, the trajectory is not curved here, ρ is not defined (ρ → ∞)",
    },
    polar="Polar coordinates",
    printed=("Printed", "Quantity", "Source", "Exact", "Difference"),
)
