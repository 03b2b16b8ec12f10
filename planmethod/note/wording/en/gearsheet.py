"""Words of the sheet and the protocol of gear trains in English (лист зубчатого механизма)."""

from planmethod.note.wording.gear_sheet_model import GearSheetWording

GEAR_SHEET = GearSheetWording(
    scheme="Kinematic scheme",
    front="View along the axes",
    linear="Picture of linear velocities",
    angular="Picture of angular velocities",
    results="Quantities read off the pictures",
    segments="Segments of the pictures, mm",
    calculation="Calculation",
    inscriptions={
        "mu_l": "μ_{{l}} = {value} m/mm",
        "mu_v": "μ_{{v}} = {value} (m/s)/mm",
        "mu_omega": "μ_{{ω}} = {value} s^{{−1}}/mm, H = {pole} mm",
        "mu_n": "μ_{{n}} = {value} min^{{−1}}/mm",
    },
    fixed="fixed: {labels}",
    by_coaxiality="{symbol} = {value} (by coaxiality)",
    module="m = {value} mm",
    columns_results=("Quantity", "Fraction", "Exact", "Read", "σ", "δ, %"),
    columns_segments=("Segment", "y, mm", "Exact", "Read"),
    no_scheme="The scheme is not drawn: the train has {kinds} meshes, whose axes do not stand in "
    "one plane with the others.",
    kinds={
        "external": "external",
        "internal": "internal",
        "bevel": "bevel",
        "rack": "rack",
        "belt": "belt",
        "crossed belt": "crossed belt",
        "chain": "chain",
        "worm": "worm",
    },
    protocol="Protocol of the pictures of velocities. {title}",
    given="Given",
    source="Source: {source}",
    pictures="The picture of linear velocities",
    steps={
        "axis": "Draw the line yy across the axes of the wheels; its point o' lies on the main "
        "axis.",
        "foot": "Mark the point {point} on yy: {what}, at the height {height} mm.",
        "pitch": "the pitch point {name}",
        "own": "the axis of {name}",
        "of pitch": "the pitch point {name}",
        "of own": "the axis of {name}",
        "laid": "Lay off ({foot}{point}) = {length} mm from {foot}, the velocity of {what}; scale "
        "μ_v = {mu_v} (m/s)/mm.",
        "calculated": "The picture does not close from the inputs; the speed of {body} is taken "
        "from the calculation.",
        "any": "The picture closes from {body}: its velocity is laid off at will, and the scale "
        "follows from the ray of the input {input}.",
        "line": "Join {one} and {other}: the line {body} is the picture of velocities of {body}.",
        "meet": "Draw a level line through {foot} to the line {body}; the point {point}: "
        "({foot}{point}) is the velocity of {what}.",
        "rays": "The picture of angular velocities",
        "pole": "Lay off (po) = {pole} mm down from p parallel to yy, and draw the line xx through "
        "o perpendicular to yy.",
        "ray": "Draw a ray from p parallel to the line {body} to xx: the segment (o{body}) stands "
        "for the speed of {body}.",
        "readings": "Reading and computing",
        "read": "({name}) = {read} mm (exact {exact} mm, σ = {sigma} mm).",
        "scale": "{symbol} = {value} {unit}/mm, from {from_what}.",
        "chosen": "μ_v/(μ_l·H)",
        "input": "the ray of the input",
        "found": "{formula} = {read} {unit} (exact {exact}, σ = {sigma}).",
    },
    ruler="Segments are read with a ruler of {ruler} mm; the draughtsman is “{profile}”.",
)
