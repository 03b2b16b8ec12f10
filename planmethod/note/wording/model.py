"""What a language must be able to say: the sentence templates of the note."""

from __future__ import annotations

from collections.abc import Mapping

from msgspec import Struct


class Wording(Struct, frozen=True, kw_only=True):
    """Sentence templates of one language (каталог фраз).

    Every field is a template of `str.format`, with the same named places in every language. A
    point is put in by one of the ``of_...`` phrases (genitive in Russian: "из точки b"), a line by
    one of the ``line_...`` phrases (genitive) or ``draw_...`` phrases (accusative).
    """

    lang: str
    decimal: str
    units: Mapping[str, str]

    # Senses and sides
    ccw: str
    cw: str
    left: str
    right: str
    rightmost: str
    leftmost: str
    upper: str
    lower: str

    # Headings
    title_protocol: str
    title_results: str
    source: str
    one_position: str
    position: str
    formula: str
    given: str
    given_count: str
    given_steps: str
    given_left: str
    given_right: str
    given_through: str
    given_along: str
    given_position: str
    given_extremes: Mapping[str, str]
    given_going: Mapping[str, str]
    given_arc: str
    given_guide: str
    scales: str
    scales_text: str
    ruler: str
    plans: Mapping[str, str]
    frame: str
    driver: str
    group: str
    higher_group: str
    plain_group: str
    letters: Mapping[str, str]

    # Points, lines and directions
    of_point: str
    of_pole: str
    of_guide_start: str
    parallel: str
    perpendicular: str
    at_angle: str
    along: str
    beyond: str
    backwards: str
    to_left: str
    to_right: str
    line_join: str
    line_guide: str
    line_through: str
    draw_parallel: str
    draw_perpendicular: str
    draw_at_angle: str
    draw_join: str
    draw_guide: str
    draw_guide_at: str
    carries: str
    slot: str
    slot_of: str
    x_axis: str

    # Steps of the position plan
    fixed_points: str
    lay_off_at: str
    lay_off: str
    two_arcs: str
    arc_and_line: str
    touch: str
    meet: str
    meet_coincide: str
    measure: str
    measure_drawing: str
    exact: str
    zero_length: str

    # Steps of the velocity and acceleration plans
    pole: str
    pole_fixed: str
    equation_legend: str
    equations: str
    lay_off_vector: str
    sense_of: str
    sense_normal: str
    sense_coriolis: str
    constant_speed: str
    no_coriolis_frame: str
    no_coriolis_link: str
    translating: str
    shared_turning: str
    turning: str
    turning_zero: str
    unreadable: str
    unreadable_points: str
    similar_on: str
    similar_beyond: str
    similar_same: str
    similar_triangle: str
    read_off: str

    # Result tables
    referee_note: str
    columns_referee: tuple[str, ...]
    table_points: str
    table_links: str
    table_sliding: str
    table_segments: str
    columns_points: tuple[str, ...]
    columns_links: tuple[str, ...]
    columns_sliding: tuple[str, ...]
    columns_vectors: tuple[str, ...]
    columns_lengths: tuple[str, ...]
    sliding_row: str
    table_forces: str
    columns_forces: tuple[str, ...]
    edges_note: str
    edges_couple: str
    balance: Mapping[str, str]
    lever_stands: str
    lever_note: str
    resultant_shift: str
    resultant_no_force: str
    resultant_faint: str
    resultant_far: str
    hand_note: str
    many_forces: str
    many_places: str
    many_velocities: str
    many_accelerations: str
    many_by_hand: str
    number: str
    margin: str
    sense_note: str

    # Drafting errors
    profiles: Mapping[str, str]
    sigma: str
    sigma_note: str
    drawn_note: str
    many_sigmas: str
    table_causes: str
    worst_result: str
    cause_given: str
    cause_angle: str
    cause_line: str
    cause_lay_off: str
    cause_meet: str
    cause_arc: str
    cause_touch: str
    cause_similar: str
    cause_read: str

    # Structure
    roles: Mapping[str, str]
    static_counts: str
    statically_determinate: str
    statically_not: str
    joint_outer: str
    joint_inner: str
