"""Sentences in English (английский каталог)."""

from planmethod.note.wording.en.numbers import NOTATION, UNITS
from planmethod.note.wording.model import Wording

NOTE = Wording(
    lang="en",
    decimal=NOTATION.decimal,
    units=UNITS,
    ccw="counter-clockwise",
    cw="clockwise",
    left="left",
    right="right",
    rightmost="right",
    leftmost="left",
    upper="upper",
    lower="lower",
    title_protocol="Construction of the plans, step by step",
    title_results="Results",
    source="Source: {source}",
    one_position="Position: {symbol} = {value}",
    position="Position {number} ({count} in all): {symbol} = {value}",
    formula="Structural formula: {formula}",
    given="Given: {given}.",
    given_count=" ({count} positions)",
    given_steps="from {first} to {last} in steps of {step}",
    given_left="{point} to the left of {line}",
    given_right="{point} to the right of {line}",
    given_through="{guide} through {point}",
    given_along="{point}: {at} along {line} from {start}, {across} across",
    given_position="position: {position}",
    given_extremes={
        "": "extreme position",
        "other": "other extreme position",
        "left": "extreme left position",
        "right": "extreme right position",
        "upper": "extreme upper position",
        "lower": "extreme lower position",
    },
    given_going={
        "right": " (going right)",
        "left": " (going left)",
        "up": " (going up)",
        "down": " (going down)",
        "ccw": " (turning ccw)",
        "cw": " (turning cw)",
        "forth": " (forward stroke)",
        "back": " (return stroke)",
    },
    given_arc="stone {link} in a circular slot R = {radius} (replaced by the link {line})",
    given_guide="∠(guide of link {link}, {line})",
    scales="Scales",
    scales_text="We take the scales {scales}.",
    ruler="Segments are laid off exactly and read with a ruler of {ruler} mm divisions; what "
    "stands in brackets after “exactly” is free of the error of reading.",
    plans={
        "position": "Position plan",
        "velocity": "Velocity plan",
        "acceleration": "Acceleration plan",
    },
    frame="Frame",
    driver="Driving link {link}",
    group="Group {links} ({letters}): class II, order 2, kind {kind}",
    higher_group="Group {links}: class {roman}, order {order}",
    plain_group="Group {links}",
    letters={"R": "R", "P": "P"},
    of_point="point {point}",
    of_pole="the pole {point}",
    of_guide_start="the origin of the guide {guide}",
    parallel="parallel to {base}",
    perpendicular="perpendicular to {base}",
    at_angle="at {angle}° to {base}",
    along="along the line {base}",
    beyond="along the line {base}, produced beyond {point},",
    backwards=", in the opposite sense",
    to_left=" (to the left as one looks along {base})",
    to_right=" (to the right as one looks along {base})",
    line_join="the line {base}",
    line_guide="the guide {guide}",
    line_through="the line from {of} {direction}",
    draw_parallel="From {of} we draw a line parallel to {base}",
    draw_perpendicular="From {of} we draw a line perpendicular to {base}",
    draw_at_angle="From {of} we draw a line at {angle}° to {base}",
    draw_join="We draw the line {base}",
    draw_guide="Through point {point}, at {angle}° to the x axis, we draw the guide {guide}.",
    draw_guide_at="Through the point ({x}; {y}) mm, at {angle}° to the x axis, we draw the guide "
    "{guide}.",
    carries=": this is the direction of {symbol}",
    slot="the guide",
    slot_of="the guide of link {link}",
    x_axis="the x axis",
    fixed_points="We mark the fixed points, coordinates on the drawing in mm: {points}.",
    lay_off_at="From {of}, at {symbol} = {angle}° to the x axis, we lay off {length} and get point "
    "{point}.",
    lay_off="From {of} {direction} we lay off {length}{sense} and get point {point}.",
    two_arcs="We draw arcs about {one} with the radius {first} and about {two} with the radius "
    "{second}. Of their two meetings we take the one on the {side} of the line {one}{two} as one "
    "looks from {one} to {two}: this is point {point}.",
    arc_and_line="About {centre} we draw an arc with the radius {radius}; of its meetings with "
    "{line} we take the {way} one: this is point {point}.",
    touch="About {centre} we draw a circle with the radius {radius} and from {source} a tangent to "
    "it; the touching point {point} lies on the {side} of the line {centre}{source} as one looks "
    "from {centre} to {source}.",
    meet="Where {first} meets {second} we get point {point}{coincide}.",
    meet_coincide=" (which is also {points})",
    measure="We measure the segment {segment} = {length} mm (exactly {exact} mm).",
    measure_drawing="On the position plan we measure the segment {segment} = {length} mm (exactly "
    "{exact} mm).",
    exact=" (exactly {value})",
    zero_length="{symbol} = 0, so point {point} stays at {of}.",
    pole="We choose the pole {pole}",
    pole_fixed="We choose the pole {pole}; the fixed points are there: {points}",
    equation_legend="Under the terms of the equations: a double line where magnitude and direction "
    "are known, a single line where only the direction is.",
    equations="Vector equations:",
    lay_off_vector="From {of} {direction} we lay off the segment {segment} = {length} mm{sense} "
    "and get point {point}{coincide}.",
    sense_of=" in the sense of {symbol} ({sense})",
    sense_normal="{base}, from {tail} to {head},",
    sense_coriolis=", the way {relative} points when it is turned by 90° along {omega} ({sense}),",
    constant_speed="{symbol} is constant, so points of link {link} have normal acceleration only.",
    no_coriolis_frame="{symbol} = 0: the guide {guide} is fixed, there is no Coriolis "
    "acceleration.",
    no_coriolis_link="{symbol} = 0: link {link} does not turn, there is no Coriolis acceleration.",
    translating="Link {link} is in translation: ω{index} = 0, ε{index} = 0, all its points move "
    "alike.",
    shared_turning="Link {link} turns together with link {other}: {symbol} = {same}.",
    turning="The vector {segment}, carried over to point {place}, turns link {link} about point "
    "{joint} {sense}.",
    turning_zero="{symbol} = 0: the segment {segment} is zero.",
    unreadable="{symbol} is not readable on this plan: the ruler reads {divisor} = 0.",
    unreadable_points="Cannot be drawn from what is read: {points}. Exact values: see the results.",
    similar_on="By the similarity theorem point {point} lies on the segment {segment}: from {of} "
    "we lay off {part}{coincide}.",
    similar_beyond="By the similarity theorem point {point} lies on the segment {segment} produced "
    "beyond {beyond}: from {of} we lay off {part}{coincide}.",
    similar_same="By the similarity theorem point {point} falls on point {other}{coincide}.",
    similar_triangle="By the similarity theorem we draw with arcs the triangle {plan}, similar to "
    "the triangle {link}, its letters going round in the same sense, and get point "
    "{point}{coincide}.",
    read_off="By the plan we find:",
    referee_note=(
        "Float64 beside the referee of {digits} digits: error in SI units, condition number "
        "κ, and the error in units of κ·u, u = 2⁻⁵³. A direction φ is given by its cosine and "
        "sine."
    ),
    columns_referee=("result", "referee", "error", "κ", "error/(κ·u)"),
    table_points="Points",
    table_links="Links",
    table_sliding="Relative motion in prismatic pairs",
    table_segments="Segments: {plan}, {scale}",
    columns_points=("point", "x, m", "y, m", "v, m/s", "read", "a, m/s²", "read"),
    columns_links=("link", "φ, °", "ω, s⁻¹", "read", "sense", "ε, s⁻²", "read", "sense"),
    columns_sliding=("point", "v, m/s", "read", "aᵏ, m/s²", "read", "aʳ, m/s²", "read"),
    columns_vectors=("vector", "segment", "exact, mm", "read, mm", "from the reading, {unit}"),
    columns_lengths=("segment", "exact, mm", "read, mm"),
    sliding_row="{point}: {of} on {to}",
    table_forces="Reactions in the joints: force on the first link by the second",
    columns_forces=("joint", "links", "F, N", "read", "φ, °", "M, N·m", "l, m"),
    edges_note=(
        "{joint} {links}: the resultant is outside the slider {length}\u00a0m long; at its edges "
        "{first} and {second} act against one another."
    ),
    edges_couple=(
        "{joint} {links}: the force is nothing, there is a moment only; at the edges of the slider "
        "{length}\u00a0m long acts the couple {first} and {second}."
    ),
    balance={
        "moment": "Balancing moment on the driving link: {value} {unit}.",
        "force": "Balancing force on the driving link: {value} {unit}.",
    },
    lever_stands="The driving link stands: there is no Zhukovsky lever.",
    lever_note=(
        "From the readings: force plans {plans} {unit}, Zhukovsky lever {lever} {unit}, difference "
        "{difference} {unit} ({share}%); the drawing lets expect σ = {sigma} {unit}."
    ),
    resultant_shift="{force} acts in point {point} and stands for {couple}",
    resultant_no_force="{couple} stays: link {link} has no force of inertia.",
    resultant_faint=(
        "{force} and {couple} are not made one force: in one of the positions the acceleration of "
        "the centre of mass is too small on its plan."
    ),
    resultant_far=(
        "{force} and {couple} are not made one force: {shift} = {value} m is more than the largest "
        "length of the mechanism, {limit} m."
    ),
    hand_note="“Read” is what follows from segments read with a ruler of {ruler} mm divisions.",
    many_forces="Reactions in the joints, N; balancing moment (force)",
    many_places="Coordinates of points, m",
    many_velocities="Velocities of points, m/s, and angular velocities of links, s⁻¹",
    many_accelerations="Accelerations of points, m/s², and angular accelerations of links, s⁻²",
    many_by_hand="{title} (read off the plans)",
    number="No.",
    margin="margin",
    sense_note="ω and ε are positive counter-clockwise.",
    profiles={"cad": "CAD", "board": "drawing board", "coarse": "in haste"},
    sigma="±σ",
    sigma_note="±σ is the drafting error: one standard deviation, accuracy “{profile}”.",
    drawn_note="*: first order does not hold here; σ is that of many possible drawings.",
    many_sigmas="Drafting error ±σ: v, m/s; ω, s⁻¹; a, m/s²; ε, s⁻²",
    table_causes="What contributes most to the error",
    worst_result="Largest relative error: {symbol} = {value} ± {sigma} {unit} ({part} %); shares "
    "of the variance:",
    cause_given="marking point {point}",
    cause_angle="setting off the angle {symbol}",
    cause_line="drawing {line}",
    cause_lay_off="laying off the segment from {of} to point {point}",
    cause_meet="marking point {point} where two lines meet",
    cause_arc="fixing point {point} with an arc",
    cause_touch="the tangent at point {point}",
    cause_similar="drawing point {point} by similarity",
    cause_read="reading the segment {segment}",
    roles={
        "frame": "frame",
        "crank": "crank",
        "rocker": "rocker",
        "slider": "slider",
        "rod": "coupler",
        "stone": "stone",
        "slotted link": "slotted link",
    },
    static_counts=(
        "Force analysis: N_y = 3n = 3·{n} = {equations} equations, N_F = {pairs} + {w} = "
        "{unknowns} unknowns (two a lower pair, and what balances the drivers): {verdict}"
    ),
    statically_determinate="statically determinate.",
    statically_not="statically indeterminate.",
    joint_outer="outer pairs: {joints}",
    joint_inner="inner pairs: {joints}",
)
