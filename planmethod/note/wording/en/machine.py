"""The flywheel in English."""

from planmethod.note.wording.machine_model import MachineWording

MACHINE = MachineWording(
    wanted="{flywheel}, sizes of the flywheel",
    means={"half-sum": "(ω_{{max}} + ω_{{min}})/2", "time": "the mean in time"},
    source_signs="weights added with the sign of resistance, as the source adds them",
    diagrams="Diagrams of moments, work, energy, inertia, and the energy-mass diagram",
    by_middle="integrated by middle ordinates",
    by_trapezoid="integrated by trapezoids",
    speed="Deviation of the crank's angular velocity in the steady motion",
    load="Force {name} over the stroke of point {point}",
    over_stroke="H = {stroke}",
    table="Reduced moments, work, moments of inertia and angular velocity",
    sizes={"disc": "Flywheel: a disc", "rim": "Flywheel: a rim"},
    calculation="Moment of inertia of the flywheel",
    title="Choice of the flywheel",
    read="{text} (measured; exactly {exact})",
    construction="{symbol} = μ_{{T}}·KL/({omega}^{{2}}·δ) = {value} {unit}, σ = {sigma} {unit}",
    exact="Exactly (tangents of slopes (1 ± δ/2)^{{2}} to the whole curve): {symbol} = {value} "
    "{unit}",
    parts="The construction is off by {whole} %: {parts}",
    slopes="slopes 1 ± δ: {value} %",
    method="one slope (Mertsalov): {value} %",
    positions="{count} positions: {value} %",
    pencil="ruler: {value} %",
    reached="Checked by the equation of motion: δ = {delta}; ω_{{max}} = {high} at {at_high}, "
    "ω_{{min}} = {low} at {at_low}",
    extreme="φ = {angle}°",
    not_needed="No flywheel is needed: without it δ = {delta}",
    held="the diameter is held by the speed of the rim, {speed}",
    lever_agrees="{lever} is that of the Zhukovsky lever of each position, without inertia.",
    steps=(
        "Compute the reduced moment {M} and the reduced moment of inertia {J} in {count} "
        "positions.",
        "Lay the ordinates of {M} off at the scale {mu_M}.",
        "Integrate graphically with the pole distance H = {pole}: {way}. The scale of the work is "
        "{mu_A}.",
        "Join the beginning and the end of the diagram {A} by a straight line: that is {A_const}, "
        "the moment {M_const} = {constant}.",
        "Carry the differences of the ordinates of {A_const} and {A} to the diagram ΔT.",
        "Draw the diagram {J} at the scale {mu_J} and project its ordinates on a line at 45°.",
        "Where uprights from there meet the levels of ΔT, mark the points of the energy-mass "
        "diagram.",
        "Draw tangents at ψ_{{max}} = {psi_max}° (point {top}) and ψ_{{min}} = {psi_min}° "
        "(point {bottom}); they cut off KL = {KL}.",
    ),
    run_up="Run-up and stop of the machine",
    kloss="{M} = 2M_{{max}}·s·s_{{k}}/(s^{{2}} + s_{{k}}^{{2}}), s = 1 − ω/ω_{{0}} (Kloss): "
    "M_{{max}} = {moment}, s_{{k}} = {slip}, ω_{{0}} = {idle}, reduced to the crank",
    line="{M} = M_{{0}}·(1 − ω/ω_{{0}}): M_{{0}} = {moment}, ω_{{0}} = {idle}, reduced to the "
    "crank",
    ran_up="Run-up with {J}: t_{{r}} = {time}, φ_{{r}} = {angle}° ({turns} turns); from there ω is "
    "within {near} % of the steady one",
    steady="Steady motion with the motor: ω_{{max}} = {high}, ω_{{min}} = {low}, δ = {delta}",
    by_motor="δ = {wanted} with this motor is what {J} gives",
    stays="The motor does not start the machine: at ω = 0 {M} = {motor} is not more than "
    "{R} = {resists} of position 0",
    stalled="The motor does not hold the load: the crank stands at t = {time}, φ = {angle}°",
    not_steady="In {count} cycles the motion does not become steady",
    braked="Stop by the brake {M} = {brake} from position 0: t_{{b}} = {time}, "
    "φ_{{b}} = {angle}° ({turns} turns)",
    coasted="Coasting without motor and brake from position 0: t_{{b}} = {time}, "
    "φ_{{b}} = {angle}° ({turns} turns)",
    not_stopped="In {count} cycles the crank does not stop",
    motor_diagram="Characteristic of the motor and the mean moment of resistance",
    by_time="Run-up: ω over time",
    by_angle="Run-up: ω over the angle turned",
    stop_diagram="Stop: ω over time",
    run_up_table="Run-up",
    stop_table="Stop",
    balancing="Static balancing",
    run_up_wanted="To be found: time and angle of run-up and stop, the steady motion.",
    balancing_wanted="To be found: masses and places of counterweights, main vector of inertia.",
    structures={"four-bar": "four-bar linkage", "slider-crank": "slider-crank mechanism"},
    weighings={
        "full": "balanced in full",
        "partial": "balanced in part, by the crank's counterweight",
    },
    substituted="The mass of rod {link} is replaced statically by masses in {A} and {B}: {one}; "
    "{two}",
    off_line="The centre of mass of rod {link} is off the line {A}{B}: vectors m·r stand for two "
    "masses",
    weight="Link {link}: {terms}; counterweight m·r = {moment}, at r = {radius} the mass "
    "m = {mass} at {angle}° from {line}",
    no_weight="Link {link}: no counterweight is needed",
    measured="by the polygon with the ruler {moment}",
    force_falls="Largest main vector of the inertia forces: {before} before, {after} after",
    centre_stands="The centre of all masses stands: ({x}; {y}) {unit}; links {bare}, with "
    "counterweights {whole}",
    centre_moves="The centre of all masses moves within {before} before and {after} after; links "
    "{bare}, with counterweights {whole}",
    polygon_of="Polygon of m·r of link {link}",
    before="Main vector of inertia before balancing",
    after="Main vector of inertia after balancing",
    weights_table="Counterweights",
    forces_table="Main vector of inertia by positions",
    with_weights="The mechanism with counterweights",
)
