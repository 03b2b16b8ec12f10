"""What a language must be able to say on the sheets of the plans, of their frame, of structure."""

from __future__ import annotations

from collections.abc import Mapping

from msgspec import Struct


class SheetWording(Struct, frozen=True, kw_only=True):
    """Names of views and tables and sentences of the sheets in one language, rich text.

    As in `Wording`, every field is a template of `str.format`.
    """

    # Names of the views, by the kind of plan: of one position, of many
    views: Mapping[str, tuple[str, str]]

    # Texts of the plans; equations and calculation by the kind of plan
    equations: Mapping[str, str]
    calculation: Mapping[str, str]
    but_for: str
    knots: tuple[str, ...]
    enlarged: str
    read_on: str
    extremes: str
    of_position: str
    wanted: str

    # Table of results
    results: str
    results_exact: str
    results_sigma: str
    exact: str
    read: str
    value: str
    sigma_note: str
    unreadable: str

    # Ellipses of the drafting error
    ellipses: str
    ellipses_enlarged: str
    ellipses_thin: str
    ellipses_strained: str
    ellipses_large: str
    ellipses_undefined: str

    # Force analysis of one position
    loads: str
    not_to_scale: str
    cut_group: str
    cut_driver: str
    cut_link: str
    plan_of_group: str
    plan_of_link: str
    plan_none: str
    apart: str
    lever: str
    lever_turned: str
    lever_stands: str
    lever_no_work: str
    lever_found: str
    lever_difference: str
    lever_expected: str
    computed_loads: str
    load_curve: str
    from_plan: str
    all_zero: str

    # Tables of reactions
    reactions: str
    reactions_exact: str
    reactions_edges: str
    joint: str
    by_plans: str
    by_lever: str
    difference: str

    # Force analysis over the cycle
    wanted_cycle: str
    load_table: str
    balance: Mapping[str, str]
    legend_exact: str
    legend_plans: str
    legend_lever: str
    chords: str
    reactions_of_group: str
    reactions_of_driver: str
    hodographs: str
    of_joint: str
    of_joints: str
    largest_at: str
    cycle_reactions: str
    cycle_plans: str
    cycle_lever: str
    cycle_note: str

    # Sketch
    not_drawn: str


class FrameWording(Struct, frozen=True, kw_only=True):
    """Captions of the forms of GOST 2.104 in one language.

    Attributes
    ----------
    captions : mapping
        By the names in `planmethod.render.frame`.
    copied, format : str
        Graphs 31 and 32, below the frame.
    paper, portrait : str
        The letter of the formats, and a format that stands.
    """

    captions: Mapping[str, str]
    copied: str
    format: str
    paper: str
    portrait: str


class StructureWording(Struct, frozen=True, kw_only=True):
    """Headings, tables, formulas and captions of the structural sheet in one language, rich text.

    As in `Wording`, every sentence is a template of `str.format`.
    """

    # Headings
    title: str
    scheme: str
    parts: str
    pairs: str
    links: str
    formulas: str

    # Tables; names by those of `planmethod.mechanism.describe`
    columns_pairs: tuple[str, ...]
    columns_links: tuple[str, ...]
    pair_kinds: Mapping[str, str]
    motions: Mapping[str, str]

    # Formulas; a no-break space keeps a line together
    counts: str
    chebyshev: str
    spatial: str
    redundant: str
    formula: str
    mechanism_class: str
    kinematic_order: str
    force_order: str

    # Captions of the parts
    primary: str
    group: str
    group_kind: str
    group_leads: Mapping[int, str]
