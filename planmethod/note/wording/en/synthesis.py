"""Words of syntheses in English (синтез по-английски)."""

from planmethod.note.wording.synthesis_model import SynthesisWording

SYNTHESIS = SynthesisWording(
    titles={
        "slotted": "Synthesis of a slotted link",
        "slider-crank": "Synthesis of a slider-crank",
        "crank-rocker": "Synthesis of a crank-rocker",
        "three-positions": "Synthesis by three positions of the coupler",
        "three-angles": "Synthesis by three pairs of angles",
    },
    mechanisms={
        "slotted": "Slotted link",
        "slider-crank": "Slider-crank",
        "crank-rocker": "Crank-rocker",
        "three-positions": "Four-bar",
        "three-angles": "Four-bar",
    },
    comments={
        "frame": "frame, m",
        "crank": "crank",
        "input": "driving link",
        "stone": "stone",
        "slotted": "slotted link; the stone stays within D",
        "rod": "rod",
        "coupler": "coupler",
        "rocker": "rocker",
        "output": "driven link",
        "slider": "slider",
        "driver": "driver",
        "zero": "deg, from an extreme position",
        "omega": "1/s: put in your own",
        "assembly": "way of assembly",
    },
    construction="Construction",
    steps_title="Steps",
    to_bisector="the perpendicular bisector of {base}",
    steps={
        "bisector": "We draw the perpendicular bisector of {tail}{head}.",
        "inscribed": "We draw the circle about {centre} from which the chord {tail}{head} is seen "
        "at {angle}°: from {tail} a line at {rest}° to the chord as far as the perpendicular "
        "bisector.",
        "again": "The line from {tail} at {angle}° to {tail}{head} meets the circle again in point "
        "{point}.",
        "apollonius": "Point {centre} is the middle of {tail}{head}: the circle over {tail}{head} "
        "has the points with one ratio (l − r)/(l + r), λ\u00a0=\u00a0r/l\u00a0=\u00a0{ratio}.",
        "freudenstein": "Freudenstein's equation for the three pairs of angles gives "
        "K_{{1}} = {k1}, K_{{2}} = {k2}, "
        "K_{{3}} = {k3}; l_{{{tail}{head}}} = l_{{OC}} / |K_{{1}}|.",
        "centre": "The perpendiculars meet in {centre}, the centre of the circle through {points}.",
    },
    point="We mark point {point} ({x}; {y}) mm.",
    given={
        "K_v": ("K_{v}", ""),
        "swing": ("ψ", "deg"),
        "centres": ("l_{0}", "m"),
        "stroke": ("H", "m"),
        "rod": ("l_{BC}", "m"),
        "lambda": ("λ\u00a0=\u00a0r/l", ""),
        "offset": ("e", "m"),
        "pressure": ("α_{max}", "deg"),
        "rocker": ("l_{CB}", "m"),
        "line": ("line of O", ""),
        "beta": ("β", "deg"),
        "coupler": ("l_{BC}", "m"),
        "positions": ("positions of the coupler", ""),
        "angles": ("pairs of angles", ""),
    },
    lengths="Sizes of the mechanism",
    columns=("size", "exact, m", "read, m", "σ, m"),
    measured="Measured on the mechanism",
    checks={
        "K_v": "ratio K_v",
        "stroke": "stroke",
        "swing": "swing",
        "slow_deg": "slow stroke",
        "quick_deg": "quick stroke",
        "pressure": "largest pressure angle",
        "transmission": "least transmission angle",
        "grashof": "Grashof's condition",
        "missed": "positions missed by",
        "branch": "goes through all three assembled",
        "order": "in the order 1, 2, 3",
    },
    verdicts={
        "swinging slotted link": "the slotted link swings",
        "slider-crank": "the crank turns fully",
        "crank-rocker": "crank-rocker",
        "rocker-crank": "the driven link turns fully",
        "double-crank": "double crank",
        "double-rocker": "double rocker",
        "triple-rocker": "double rocker, no link turns fully",
        "change point": "change point",
    },
    holds={True: "yes", False: "no"},
    interrupted="{name}: the mechanism does not go through the three positions in turn without "
    "being taken apart: take other points of the coupler, or other angles.",
    ruler="ruler {ruler} mm, μ_l = {scale} m/mm",
)
"""Words of syntheses."""
