"""Words of the turn of a crank in English (цикл движения по-английски)."""

from planmethod.note.wording.cycle_model import CycleWording

CYCLE = CycleWording(
    title="The turn of the crank",
    why={
        "PARTIAL": "the crank does not turn fully",
        "STILL": "the output does not move",
        "ROUND": "the output turns all round",
        "NO_EXTREME": "the output does not turn back",
        "SEVERAL": "the output reaches an end of its stroke more than once in a turn",
        "NO_DYAD": "the output link does not close a dyad on the frame",
        "NO_RATE": "the crank stands still",
    },
    none="{what}: none, {why}",
    output={"m": "Output: point {name} of slider {link}", "deg": "Output: angle of link {name}"},
    zero="position 0: φ = {phi}; numbered as the crank turns",
    path_zero="the path is counted from φ = {phi}",
    extremes="extreme positions: {extremes}",
    stroke={"m": "stroke H = {stroke}", "deg": "swing ψ = {stroke}"},
    ratio="φ_{{w}} = {working}, φ_{{i}} = {idle}, K_{{v}} = {ratio}",
    full_turn="the crank turns fully",
    tightest="nearest to not closing are links {links} at φ = {phi}",
    range="the crank does not turn fully: the mechanism assembles for φ from {low} to {high}, "
    "beyond them links {links} do not close",
    pressure="pressure angle: greatest {most} at φ = {most_at}, least {least} at φ = {least_at}",
    no_pressure="the pressure angle is zero in all positions",
    construction={
        "guide": "Extreme positions: arcs about {pivot} of the radii {far} = {far_mm} mm and "
        "{near} = "
        "{near_mm} mm cut the guide in {ends}; the points {pins} lie on the lines {rays}, {crank} "
        "= "
        "{crank_mm} mm from {pivot}.",
        "circle": "Extreme positions: arcs about {pivot} of the radii {far} = {far_mm} mm and "
        "{near} = "
        "{near_mm} mm cut the arc of point {end} about {centre} in {ends}; the points {pins} lie "
        "on "
        "the lines {rays}, {crank} = {crank_mm} mm from {pivot}.",
        "tangents": "Extreme positions: from {centre} tangents to the circle of the radius "
        "{crank} = "
        "{crank_mm} mm about {pivot}; they touch it in {pins}.",
    },
    constructed={
        "m": "Read: {angles}; stroke of link {link} H = {read} (exactly {exact}, σ = {sigma}).",
        "deg": "Read: {angles}; swing of link {link} ψ = {read} (exactly {exact}, σ = {sigma}).",
        "phi": "{name} = {read} (exactly {exact}, σ = {sigma})",
    },
    no_construction="The extreme positions of this mechanism are not found with arcs or tangents: "
    "they are the roots of the output's velocity.",
    of={"m": "point {name}", "deg": "link {name}"},
    diagrams="Kinematic diagrams of {of}",
    hodograph={
        "velocity": "Hodograph of the velocity of point {of}",
        "acceleration": "Hodograph of the acceleration of point {of}",
    },
    drawn="Thick lines: the construction ({way}); thin lines: the exact curves",
    chords={"chords": "chords", "tangents": "tangents", "curve": "chords of the curve"},
    scheme_steps="The axis of φ, {length} mm long, is divided into {count} parts; the ordinates "
    "s_{{k}} are the distances of the point (arcs of the link) from position 0, taken off the "
    "scheme.",
    ray_steps={
        "chords": "From the pole P_{{v}} (K_{{1}} = {pole} mm) rays parallel to the chords k–(k+1) "
        "of the diagram of s; what they cut off on the axis of v is carried to the middles of the "
        "intervals; the ends are joined by a smooth curve.",
        "tangents": "From the pole P_{{v}} (K_{{1}} = {pole} mm) rays parallel to the tangents of "
        "the diagram of s (that in k is parallel to the chord (k−1)–(k+1)); what they cut off on "
        "the axis of v is carried to the positions k; the ends are joined by a smooth curve.",
        "curve": "From the pole P_{{v}} (K_{{1}} = {pole} mm) rays parallel to the chords of the "
        "diagram of s; what they cut off on the axis of v is carried to the middles of the "
        "intervals; a smooth curve goes through the ends and is read in the positions k.",
    },
    again="The diagram of a is made of that of v in the same way, K_{{2}} = {pole} mm.",
    scales="Scales: {scales}; μ_{{v}} = μ_{{s}}/(μ_{{t}}·K_{{1}}), μ_{{a}} = "
    "μ_{{v}}/(μ_{{t}}·K_{{2}}).",
    table="The turn by positions",
    analogues="Transfer functions of the output",
    deviations="Deviations of the diagrams, mm; r: with a ruler of {ruler} mm",
    way="way",
    ways={"chords": "chords", "tangents": "tangents", "curve": "curve"},
    from_plans="off the plans",
    greatest=("Δ_{{max}}", "Δ^{{r}}_{{max}}"),
    mean=("Δ_{{rms}}", "Δ^{{r}}_{{rms}}"),
    sigma="σ",
    wanted="To find: the extreme positions, the stroke, K_{v}, the pressure angle; to draw the "
    "plans of positions, velocities and accelerations, the hodograph and the diagrams.",
)
