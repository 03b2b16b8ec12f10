"""What a language must be able to say of forces (фразы силового расчёта)."""

from __future__ import annotations

from collections.abc import Mapping

from msgspec import Struct


class ForceWording(Struct, frozen=True, kw_only=True):
    """Sentence templates of the force analysis in one language.

    As in `Wording`, every field is a template of `str.format`. A place on a force plan is put in
    by one of the ``of_...`` phrases (genitive in Russian: "конца вектора G₂"), a way by one of the
    ``way_...`` phrases.
    """

    # Loads
    title_loads: str
    scale: str
    of_link: str
    weight: str
    inertia: str
    inertia_shifted: str
    shift: str
    shift_on_lever: str
    inertia_zero: str
    inertia_couple: str
    inertia_couple_zero: str
    force: str
    couple: str
    against: str
    along: str
    absent: str
    unloaded: str

    # Force plans
    title_plans: str
    order: str
    own_scale: str
    indices: str
    freed: str
    freed_driver: str
    reaction: str
    from_frame: str
    from_link: str
    and_balance: Mapping[str, str]
    components: str
    passed_on: str
    balance_group: str
    balance_link: str
    nothing: str

    # Moments
    moments_link: str
    moments_links: str
    arms: str
    turns: str
    no_moments: str
    directed: str
    guide_at: str
    guide_through: str
    guide_couple: str
    guide_cancelled: str
    guide_edges: str
    guide_pair: str

    # Steps of a plan
    of_start: str
    of_head: str
    of_tail: str
    of_meeting: str
    way_down: str
    way_up: str
    way_left: str
    way_right: str
    way_angle: str
    way_against: str
    way_tangent: str
    way_back: str
    lay_first: str
    lay_off: str
    lay_before: str
    too_short: str
    meet: str
    vector: str
    close: str
    whole: str
    whole_single: str
    same: str
    plan_of_link: str
    plan_of_group: str
    inner: str
    read_off: str

    # Where a guide's force acts
    side_up: str
    side_down: str
    side_left: str
    side_right: str

    # Lever
    title_lever: str
    unreadable: str
    stands: str
    turned: str
    hung: str
    hung_at: str
    at_pole: str
    pair: str
    pair_sense: str
    pair_still: str
    pair_turning: str
    no_work: str
    lever_arms: str
    lever_sum: str
    compared: str
    expected: str
