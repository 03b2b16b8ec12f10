from __future__ import annotations

import pytest
from doors import (
    Mechanism,
    MotionKind,
    PairKind,
    Role,
    kind_of_motion,
    pairs,
)
from drawings import EX1, EX2, EX3, PRESS, SIX_LINK, TASK12, mechanism

R, P = PairKind.REVOLUTE, PairKind.PRISMATIC


def test_table_of_pairs_of_the_textbook() -> None:
    rows = [(row.name, row.links, row.kind) for row in pairs(TASK12)]
    assert rows == [
        ("A", ("0", "1"), R),
        ("C", ("0", "3"), R),
        ("B", ("1", "2"), R),
        ("D", ("3", "4"), R),
        ("B(2,3)", ("2", "3"), P),
        ("D(4,5)", ("4", "5"), P),
        ("E", ("0", "5"), P),
    ]


def test_hinge_of_four_links_is_three_pairs() -> None:
    rows = [row for row in pairs(mechanism("A:01 C:2345")) if row.point == "C"]
    assert [(row.name, row.links) for row in rows] == [
        ("C", ("2", "3")),
        ("C(2,4)", ("2", "4")),
        ("C(2,5)", ("2", "5")),
    ]


@pytest.mark.parametrize("mech", [EX1, EX2, EX3, SIX_LINK, TASK12, PRESS])
def test_as_many_rows_as_pairs_and_no_name_twice(mech: Mechanism) -> None:
    rows = pairs(mech)
    assert len(rows) == mech.lower_pairs
    assert len({row.name for row in rows}) == len(rows)


ROTATION, TRANSLATION, PLANE = MotionKind.ROTATION, MotionKind.TRANSLATION, MotionKind.PLANE

MOTIONS = {
    "ex1": (EX1, [(ROTATION, Role.CRANK), (PLANE, Role.ROD), (TRANSLATION, Role.SLIDER)]),
    "ex2": (EX2, [(ROTATION, Role.CRANK), (PLANE, Role.ROD), (ROTATION, Role.ROCKER)]),
    "ex3": (
        EX3,
        [
            (ROTATION, Role.CRANK),
            (PLANE, Role.SLIDING_BLOCK),
            (ROTATION, Role.SLOTTED_LINK),
            (PLANE, Role.ROD),
            (TRANSLATION, Role.SLIDER),
        ],
    ),
    "six-link": (
        SIX_LINK,
        [
            (ROTATION, Role.CRANK),
            (PLANE, Role.ROD),
            (ROTATION, Role.ROCKER),
            (PLANE, Role.SLIDING_BLOCK),
            (TRANSLATION, Role.SLIDER),
        ],
    ),
    # The source calls the motion of 4 plane; between two guides at a right angle it is translation.
    "task12": (
        TASK12,
        [
            (ROTATION, Role.CRANK),
            (PLANE, Role.SLIDING_BLOCK),
            (ROTATION, Role.SLOTTED_LINK),
            (TRANSLATION, Role.SLIDING_BLOCK),
            (TRANSLATION, Role.SLIDER),
        ],
    ),
    "bar through a swinging block": (
        mechanism("A:01 B:12 D:03 C:24 E:45", "2/3@B 5/0@E"),
        [
            (ROTATION, Role.CRANK),
            (PLANE, Role.ROD),
            (ROTATION, Role.SLIDING_BLOCK),
            (PLANE, Role.ROD),
            (TRANSLATION, Role.SLIDER),
        ],
    ),
    "driving slider": (
        mechanism("B:12 C:23 D:03", "1/0@B"),
        [(TRANSLATION, Role.SLIDER), (PLANE, Role.ROD), (ROTATION, Role.ROCKER)],
    ),
}


@pytest.mark.parametrize("name", MOTIONS)
def test_kind_of_motion(name: str) -> None:
    mech, wanted = MOTIONS[name]
    frame, *rows = kind_of_motion(mech)
    assert (frame.link, frame.motion, frame.role) == ("0", MotionKind.FIXED, Role.FRAME)
    assert [row.link for row in rows] == list(mech.links)
    assert [(row.motion, row.role) for row in rows] == wanted
