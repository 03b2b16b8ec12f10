from __future__ import annotations

import random

import pytest
from doors import (
    FRAME,
    AssurGroup,
    Mechanism,
    Prismatic,
    Revolute,
    analyse,
    links_of,
    roman,
)
from drawings import CLASS_IV, EX1, EX2, EX3, PRESS, SIX_LINK, TASK12, TRIAD, mechanism
from hypothesis import given, strategies as st

WORKED = {
    "ex1": (EX1, "I(0,1) → II(2,3)", ["RRP"], 3),
    "ex2": (EX2, "I(0,1) → II(2,3)", ["RRR"], 3),
    "ex3": (EX3, "I(0,1) → II(2,3) → II(4,5)", ["RPR", "RRP"], 6),
    "six-link": (SIX_LINK, "I(0,1) → II(2,3) → II(4,5)", ["RRR", "PRP"], 6),
    "task12": (TASK12, "I(0,1) → II(2,3) → II(4,5)", ["RPR", "RPP"], 6),
    "press": (PRESS, "I(0,1) → II(2,3) → II(4,5)", ["RPR", "RRP"], 6),
}


@pytest.mark.parametrize("name", WORKED)
def test_worked_examples(name: str) -> None:
    mech, formula, signatures, redundant = WORKED[name]
    found = analyse(mech)
    assert found.formula == formula
    assert [group.signature for group in found.groups] == signatures
    assert found.redundant == redundant
    assert found.mobility == 1
    assert found.class_number == 2
    assert found.higher_pairs == 0
    assert found.moving_links == len(mech.links)
    assert found.spatial_mobility == 1 - redundant


def test_numbers_of_the_six_link_are_those_of_the_textbook() -> None:
    found = analyse(SIX_LINK)
    assert (found.moving_links, found.lower_pairs) == (5, 7)
    assert (found.mobility, found.spatial_mobility, found.redundant) == (1, -5, 6)


def test_force_analysis_goes_the_other_way() -> None:
    found = analyse(EX3)
    assert [group.links for group in found.force_order] == [("4", "5"), ("2", "3")]
    group = found.group_of("5")
    assert group is not None
    assert group.signature == "RRP"
    assert found.group_of("1") is None


DYADS = {
    "RRR": ("A:01 B:12 C:23 D:03", "", 1),
    "RRP": ("A:01 B:12 C:23", "3/0@C", 2),
    "RPR": ("A:01 B:12 D:03", "2/3@B", 3),
    "PRP": ("A:01 C:23", "2/1@C 3/0@C", 4),
    "RPP": ("A:01 B:12", "2/3@B 3/0@E", 5),
}


@pytest.mark.parametrize("signature", DYADS)
def test_dyads(signature: str) -> None:
    points, slides, kind = DYADS[signature]
    (group,) = analyse(mechanism(points, slides)).groups
    assert (group.signature, group.kind) == (signature, kind)
    assert (group.class_number, group.order) == (2, 2)
    assert [lead.link for lead in group.legs] == ["2", "3"]
    assert [lead.to for lead in group.legs] == ["1", "0"]


@pytest.mark.parametrize(
    ("points", "slides", "signature"),
    [
        ("A:01 C:23 D:03", "1/2@B", "RRP"),  # the known link slides on the group's
        ("A:01 D:03", "2/1@B 2/3@B", "RPP"),  # the outer prismatic joint first
        ("A:01 B:12 D:03", "3/2@D", "RPR"),
        ("A:01 C:23", "1/2@A 3/0@C", "PRP"),
    ],
)
def test_signature_does_not_depend_on_the_writing(points: str, slides: str, signature: str) -> None:
    (group,) = analyse(mechanism(points, slides)).groups
    assert group.signature == signature


def test_driving_slider() -> None:
    found = analyse(mechanism("B:12 C:23 D:03", "1/0@B"))
    assert found.formula == "I(0,1) → II(2,3)"
    assert found.groups[0].signature == "RRR"


def test_driver_alone() -> None:
    found = analyse(mechanism("A:01"))
    assert (found.formula, found.class_number, found.redundant) == ("I(0,1)", 1, 0)


def test_hinge_of_three_links_is_closed_by_the_group_that_reaches_it_first() -> None:
    found = analyse(mechanism("A:01 D:03 B:12 C:234 E:45", "5/0@E"))
    assert found.lower_pairs == 7
    first, second = found.groups
    assert first.links == ("2", "3")
    assert first.inner == (Revolute("C", ("2", "3", "4")),)
    assert second.links == ("4", "5")
    lead = second.legs[0]
    assert (lead.link, lead.to) == ("4", "2")


def test_hinge_is_closed_by_the_links_that_can_though_the_file_names_others_first() -> None:
    found = analyse(mechanism("A:01 D:05 B:14 C:245 E:23", "3/0@E"))
    assert found.formula == "I(0,1) → II(4,5) → II(2,3)"
    assert found.groups[1].legs[0].to == "4"


def test_links_on_a_fixed_hinge_of_the_crank_are_joined_to_the_frame() -> None:
    found = analyse(mechanism("A:013 B:12", "2/3@B"))
    (group,) = found.groups
    assert group.legs[1].to == FRAME


def test_point_carried_by_a_known_link_for_two_later_groups() -> None:
    found = analyse(mechanism("A:01 B:12 C:23 D:03 E:246 F:45 G:05 H:67 K:07"))
    assert found.formula == "I(0,1) → II(2,3) → II(4,5) → II(6,7)"
    assert [group.legs[0].to for group in found.groups[1:]] == ["2", "2"]


def test_independent_groups_are_in_file_order() -> None:
    found = analyse(mechanism("A:01 B:14 C:45 D:05 E:12 F:23 G:03"))
    assert found.formula == "I(0,1) → II(2,3) → II(4,5)"


def test_class_three() -> None:
    found = analyse(TRIAD)
    (group,) = found.groups
    assert (group.class_number, group.order, group.kind) == (3, 3, None)
    assert group.signature == "RRR-RRR"
    assert found.class_number == 3
    assert found.formula == "I(0,1) → III(2,3,4,5)"


def test_class_three_with_sliders() -> None:
    (group,) = analyse(mechanism("A:01 B:13 C:23 D:24 E:25", "4/0@D 5/0@E")).groups
    assert (group.class_number, group.order, group.signature) == (3, 3, "PPR-RRR")


def test_class_three_with_two_base_links() -> None:
    points = "A:01 B:12 C:23 D:34 E:35 F:56 G:57 H:04 K:06 L:07"
    (group,) = analyse(mechanism(points)).groups
    assert (group.class_number, group.order) == (3, 4)


def test_rigid_contour_of_three_links_is_a_base_of_class_three() -> None:
    points = "A:01 P:23 Q:34 R:24 B:15 C:25 D:36 E:06 F:47 G:07"
    (group,) = analyse(mechanism(points)).groups
    assert (group.class_number, group.order) == (3, 3)


def test_class_four() -> None:
    found = analyse(CLASS_IV)
    (group,) = found.groups
    assert (group.class_number, group.order, group.kind) == (4, 2, None)
    assert found.formula == "I(0,1) → IV(2,3,4,5)"


def test_class_five() -> None:
    points = "A:01 B:23 C:34 D:45 E:56 F:26 G:12 H:47 K:07 L:50"
    (group,) = analyse(mechanism(points)).groups
    assert (group.class_number, group.order) == (5, 3)


def test_dyad_after_a_group_of_class_four() -> None:
    found = analyse(mechanism("A:01 B:12 C:23 D:34 E:45 F:25 G:04 H:36 K:67", "7/0@K"))
    assert found.formula == "I(0,1) → IV(2,3,4,5) → II(6,7)"
    assert found.class_number == 4


@pytest.mark.parametrize(
    ("number", "text"), [(1, "I"), (2, "II"), (4, "IV"), (9, "IX"), (14, "XIV"), (48, "XLVIII")]
)
def test_roman(number: int, text: str) -> None:
    assert roman(number) == text


MECHANISMS = [EX1, EX2, EX3, SIX_LINK, TASK12, PRESS, TRIAD, CLASS_IV]
MECHANISMS += [mechanism("A:01 D:03 B:12 C:234 E:45", "5/0@E")]
MECHANISMS += [mechanism("A:01 B:12 C:23 D:03 E:246 F:45 G:05 H:67 K:07")]


def _shuffled(mech: Mechanism, seed: int) -> tuple[Mechanism, dict[str, str]]:
    rng = random.Random(seed)
    links = list(mech.links)
    rng.shuffle(links)
    new = {link: f"L{i}" for i, link in enumerate(mech.links)} | {FRAME: FRAME}
    order = [FRAME, *links]
    revolutes = [
        Revolute(f"P{joint.point}", tuple(new[x] for x in sorted(joint.links, key=order.index)))
        for joint in mech.revolutes
    ]
    prismatics = [Prismatic(new[p.slider], new[p.host], p.pin) for p in mech.prismatics]
    rng.shuffle(revolutes)
    rng.shuffle(prismatics)
    again = Mechanism(
        tuple(new[x] for x in links), tuple(revolutes), tuple(prismatics), new[mech.driver]
    )
    return again, new


@given(st.sampled_from(MECHANISMS), st.integers(0, 10**6))
def test_names_and_order_of_links_do_not_change_the_groups(mech: Mechanism, seed: int) -> None:
    again, new = _shuffled(mech, seed)

    def essence(group: AssurGroup, names: dict[str, str]) -> tuple[object, ...]:
        return (
            frozenset(names[link] for link in group.links),
            group.signature,
            group.class_number,
            group.order,
            group.kind,
        )

    same = {name: name for name in new.values()}
    before = {essence(group, new) for group in analyse(mech).groups}
    after = {essence(group, same) for group in analyse(again).groups}
    assert before == after


@given(st.sampled_from(MECHANISMS), st.integers(0, 10**6))
def test_every_leg_starts_from_links_known_before_its_group(mech: Mechanism, seed: int) -> None:
    again, _ = _shuffled(mech, seed)
    known = {FRAME, again.driver}
    for group in analyse(again).groups:
        for lead in group.legs:
            assert lead.to in known
            assert lead.to in links_of(lead.joint)
        assert 3 * len(group.links) == 2 * (len(group.legs) + _inner_pairs(group))
        known.update(group.links)
    assert known == {FRAME, *again.links}


def _inner_pairs(group: AssurGroup) -> int:
    return sum(sum(x in group.links for x in links_of(joint)) - 1 for joint in group.inner)


def test_links_of_a_group_keep_the_order_of_the_file() -> None:
    turned = Mechanism(EX3.links[::-1], EX3.revolutes, EX3.prismatics, EX3.driver)
    assert [group.links for group in analyse(turned).groups] == [("3", "2"), ("5", "4")]
