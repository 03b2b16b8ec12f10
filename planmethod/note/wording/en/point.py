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
    rolled="Rolling wheel",
    wheel="a wheel of radius R = {radius} m {track}; "
    "CM = {r} m, at {angle}° to the x axis where φ = 0",
    tracks={
        "line": "rolls without slipping on the x axis",
        "on": "rolls without slipping outside on a circle of radius {radius} m",
        "within": "rolls without slipping within a circle of radius {radius} m",
        "arm": "is a satellite on a carrier OC = {radius} m, which has turned by θ from the x axis",
    },
    printed=("Printed", "Quantity", "Source", "Exact", "Difference"),
    trajectory="Trajectory of the point M",
    hodograph_v="Hodograph of the velocity",
    hodograph_a="Hodograph of the acceleration",
    row="t from {start} to {end} s, {count} moments",
    moments="t = {times} s",
    wanted="Find the velocity v, the acceleration a, a_{τ}, a_{n}, the radius of curvature "
    "ρ; draw the trajectory and the hodographs.",
    read_title="Read off the drawing ({profile})",
    read=("Quantity", "Exact", "Read", "±σ"),
    table="Motion of the point at the numbered instants",
    chord="a_{h}",
    chord_note="a_{h}: the chord between the neighbouring points of the velocity "
    "hodograph over the time between them, ± the drafting error σ.",
    curve="The trajectory and the hodographs are drawn from t = {start} to {end} s; their points "
    "are numbered from 0 to {last}.",
    ray="Draw through {of} a line at {angle}° to the x axis.",
    level="Draw through {of} a line parallel to the x axis.",
    lay_off="From {of} lay off {symbol} {way}: {size} mm.",
    lay_off_side="From {of} lay off along it {size} mm: the point {point}.",
    nothing="{symbol} = 0: nothing to lay off.",
    ways={
        "along": "along it",
        "along back": "along it, backwards",
        "across": "perpendicular to it (to the left)",
        "across back": "perpendicular to it (to the right)",
    },
    across_pm="From the pole p lay off v = ω·PM perpendicular to PM, in the sense of the rotation: "
    "{length} mm (P is the instantaneous centre of velocities).",
    end="the end of {symbol}",
    join="Join {tail} and {head}.",
    measured="Measure {segment} = {length} mm.",
    tangent="Draw through {of} a line parallel to the vector v: the direction of the tangent.",
    foot="Drop a perpendicular on it from the end of the vector a; its foot is {point}.",
    value="Measure {segment} = {length} mm (exactly {exact}): {formula}.",
    by_hodograph="Acceleration by the hodograph of the velocity",
    chord_told="The acceleration is the velocity of the end of v: the chord between the "
    "neighbouring points of the hodograph, read with the ruler, over the time between them. σ is "
    "the drafting error; the difference has also what the chord misses of the tangent.",
    chords=("№", "t, s", "a exact, m/s²", "a read", "σ", "difference"),
)
