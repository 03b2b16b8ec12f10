"""Words of gear trains and of the choice of their teeth in English (зубчатые механизмы)."""

from planmethod.note.wording.gear_model import GearSheetWording, GearWording, TeethWording

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
        "found": "{formula} = {read} (exact {exact}, σ = {sigma}).",
    },
    ruler="Segments are read with a ruler of {ruler} mm; the draughtsman is “{profile}”.",
)


GEARS = GearWording(
    sheet=GEAR_SHEET,
    title="Gear train: {title}",
    structure="Structure",
    kinds={
        "ordinary": "ordinary (fixed axes)",
        "planetary": "planetary",
        "differential": "differential",
        "closed differential": "closed differential",
    },
    kind="Kind of train: {kind}",
    chebyshev="W = 3n − 2p_{{1}} − p_{{2}} = 3·{n} − 2·{low} − {high} = {w}",
    of_equal=" (one satellite of each equal ones)",
    by_meshes="Independent meshes: {rank}; mobility W = {w}",
    redundant="Redundant constraints: in the plane q = {plane}, in space (teeth touch along "
    "lines) q = {space}",
    carrier="Carrier {carrier}: central wheels {central}; satellites {satellites}",
    closing="Closing chain: {meshes}",
    equations="Mesh equations",
    equation="{name}: {equation};  {stage}",
    wheels="Wheels",
    columns_wheels=("wheel", "{letter}", "axis, {unit}"),
    speeds="Speeds",
    columns_speeds=("body", "{letter}, {unit}", "fraction", "{other}, {other_unit}", "to carrier"),
    relative="{letter}^{carrier} = {value}",
    across="The axis of {label} is not parallel to the main one: its speed is relative to the "
    "carrier, about its own axis.",
    rack="rack",
    tabular="Tabular method, carrier {carrier}: all turned with the carrier, then {wheel} turned "
    "with the carrier held; the sum is what the equations give",
    tabular_rows=("with the carrier, {letter}", "carrier held, {letter}", "sum, {letter}"),
    asked="Asked",
    columns_asked=("quantity", "value", "fraction", "unit"),
    checked="Conditions",
    conditions={
        "coaxiality": "Coaxiality, axis {axis}: {sums} = {value}",
        "satellites": "Carrier {carrier}: at most {most} satellites (assembly and neighbourhood)",
        "assembly": "Assembly, carrier {carrier}, k = {k}: {whole}/{k} = {value} must be whole",
        "neighbourhood": "Neighbourhood, carrier {carrier}, k = {k}: sin(π/k) = {left} must be "
        "more than {right}",
        "undercutting": "Undercutting: z_{wheel} = {z}, without it at least {least}",
        "interference": "Internal mesh: z_{ring} − z_{wheel} = {less}, at least {least} needed",
    },
    holds={True: "yes", False: "NO"},
    picture="Pictures of velocities",
    scales="μ_l = {mu_l} m/mm; μ_v = {mu_v} (m/s)/mm; pole distance {pole} mm; "
    "μ_ω = {mu_omega} (1/s)/mm. Heights from the main axis upwards, segments to the right are "
    "positive, rays of counter-clockwise bodies are positive.",
    columns_contacts=("point", "height, mm", "segment, mm"),
    columns_rays=("ray", "segment, mm"),
    points={"pitch": "pitch {name}", "axis": "axis {name}"},
    no_picture="No picture: axes are not parallel, their distances do not follow from the wheels, "
    "or all stands still.",
    published="Printed in the source",
    columns_published=("quantity", "printed", "exact", "difference, %"),
    reasons={
        "zero": "{label} stands still, there is no ratio to it",
        "module": "the module is not given",
        "rack": "{label}: a rack has a speed, a wheel turns",
        "satellites": "the number of satellites is found for a carrier with one row of them",
        "efficiency": "needs the efficiency of every mesh, one input, W = 1 and the output; a "
        "train that locks itself has none",
        "wheel": "{label}: there is no size or no axis",
        "teeth": "the wheels are given by radii",
    },
    units={"1/min": "rev/min", "1/s": "1/s", "m/s": "m/s", "mm": "mm", "m": "m", "m/2": "m/2"},
)


TEETH = TeethWording(
    title="Choice of teeth: {scheme}",
    schemes={
        "ring": "planetary, one row, 1-2 external, 2-3 internal, 3 fixed; U_1H = 1 + z_3/z_1",
        "external-internal": "planetary, two rows, 1-2 external, 2'-3 internal, 3 fixed; "
        "U_1H = 1 + z_2·z_3/(z_1·z_2')",
        "two-external": "planetary, two rows, both external, 3 fixed; "
        "U_H1 = 1/(1 − z_2·z_3/(z_1·z_2'))",
        "two-internal": "planetary, two rows, both internal, 3 fixed; "
        "U_H1 = 1/(1 − z_2·z_3/(z_1·z_2'))",
        "pair": "a pair of wheels, external; U_12 = −z_2/z_1",
        "two-stage": "two coaxial stages, both external; U_13 = z_2·z_3/(z_1·z_2')",
    },
    wanted="Given: U = {ratio}, off by at most {within} %{satellites}{modules}.",
    satellites=", satellites k = {k}",
    modules=", modules of the rows {first} and {second} mm",
    bounds="Bounds: z from {least} to {most}{rings}. All combinations looked at: {looked}.",
    rings=", wheels with internal teeth up to {ring_most}",
    conditions="Conditions: coaxiality, no interference of teeth (inside z_3 − z_2 at least "
    "{difference}){carried}.",
    carried=", assembly, neighbourhood",
    found="Sets found: {found}. The first {shown}, by size D/m, then by error of U:",
    none="No combination fits. Widen the bounds (--z-max, --ring-max) or the error (--within), "
    "change the number of satellites or the scheme; the sign of U is that of its formula.",
    columns=("No", "U", "fraction", "error, %", "D/m"),
    file="Chosen train, set {number}",
)
