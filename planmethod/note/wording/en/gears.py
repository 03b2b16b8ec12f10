"""Words of gear trains in English (зубчатые механизмы по-английски)."""

from planmethod.note.wording.en.gearsheet import GEAR_SHEET
from planmethod.note.wording.gear_model import GearWording

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
    chebyshev="W = 3n − 2p₁ − p₂ = 3·{n} − 2·{low} − {high} = {w} (one satellite of each equal "
    "ones)",
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
