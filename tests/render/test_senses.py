from __future__ import annotations

import pytest
from cases import each
from doors import Arc, Solution, View, Views, misleading, scheme_picture, writings_of
from worked import problem_of

NAMES = [
    "levers/task-33", "levers/task-37", "levers/task-43", "levers/task-49", "levers/task-57",
    "levers/task-65", "linkages/2.1.7", "levers/task-12", "levers/task-60", "linkages/ex3",
]  # fmt: skip


@each("name", NAMES)
def test_arrows_and_letters_of_a_scheme_do_not_mislead(name: str) -> None:
    solution = Solution(problem_of(name), views=Views.for_paper("A2", 1))
    picture = scheme_picture(solution, 0)
    found = misleading(
        picture.items, writings_of(picture.items), [View("position", picture.bounds)]
    )
    assert [finding.message for finding in found] == []


@pytest.mark.parametrize("name", ["levers/task-43", "levers/task-57"])
def test_an_arrow_turns_as_its_link_does(name: str) -> None:
    solution = Solution(problem_of(name), views=Views.for_paper("A2", 1))
    items = scheme_picture(solution, 0).items
    for link, motion in solution.links.items():
        for sign, value in (("ω", motion.omega[0]), ("ε", motion.epsilon[0])):
            tags = [item for item in items if item.tag == f"{sign} {link}"]
            if not tags:
                continue
            (arc,) = (item for item in tags if isinstance(item, Arc))
            (head,) = (item for item in tags if not isinstance(item, Arc))
            tip = head.points[0] - arc.centre  # type: ignore[union-attr]
            turned = (tip / (head.points[2] - arc.centre)).imag  # type: ignore[union-attr]
            assert turned * value > 0.0
