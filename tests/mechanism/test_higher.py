"""Higher pairs: counted as stated, replaced by lower ones, moved as the profiles do."""

from __future__ import annotations

import cmath
import math
import re

import pytest
from doors import (
    ModelProblem as Problem,
    PairKind,
    Pen,
    Solution,
    Stroke,
    Text,
    analyse,
    get_language,
    pairs,
    plain_document,
    problem_loads as loads,
    self_aligning,
    stated_pairs,
    structure_document,
    structure_in_full,
    structure_sheet,
)

A, D = 0j, 0.12 + 0.02j
AO, DC, REACH, OMEGA = 0.02, 0.1, 0.06, 10.0

FOLLOWER = """
title = "Кулачок"
[frame]
A = [0, 0]
D = [0.12, 0.02]
[links.1]
points = ["A", "O"]
AO = 0.02
[links.2]
points = ["D", "C"]
DC = 0.1
[[higher_pairs]]
name = "K"
links = ["1", "2"]
{pair}
[driver]
link = "1"
phi = 40
omega = 10
epsilon = 0
"""
ROUND = 'centres = ["O", "C"]\ndistance = 0.06'
ASSEMBLY = '\n[assembly]\nC = "above A"\n'


def _follower(pair: str, assembly: str = "") -> Problem:
    return loads(FOLLOWER.format(pair=pair) + assembly, name="cam")


def test_a_cam_with_a_roller_has_a_local_mobility() -> None:
    problem = _follower(ROUND + '\nroller = "3"', ASSEMBLY)
    found = analyse(problem.mechanism)
    assert (found.moving_links, found.lower_pairs, found.higher_pairs) == (3, 3, 1)
    assert (found.mobility, found.local_mobility) == (2, 1)
    assert (found.spatial_mobility, found.redundant) == (6 * 3 - 5 * 3 - 2, 1)
    assert [group.links for group in found.groups] == [("2", "4")]
    rows = [(pair.name, pair.links, pair.kind) for pair in stated_pairs(problem.mechanism)]
    assert rows[2:] == [
        ("K", ("1", "3"), PairKind.HIGHER),
        ("C", ("2", "3"), PairKind.REVOLUTE),
    ]
    record = structure_in_full(found, problem.mechanism, self_aligning(problem, found))
    schemes = record["self_aligning"]["schemes"]
    assert schemes == [{"A 0-1": "1v", "C 2-3": "1v", "D 0-2": "1v", "K 1-3": "5t"}]
    assert set(schemes[0]) == {row["pair"] for row in record["pairs"]}
    # A row for each constraint, all independent: 18 columns less W0 and the roller's turn.
    assert record["self_aligning"]["rank"] == 16 == 5 * 3 + 1


def test_without_a_roller_the_profile_itself_touches() -> None:
    problem = _follower(ROUND, ASSEMBLY)
    found = analyse(problem.mechanism)
    assert (found.moving_links, found.lower_pairs, found.higher_pairs) == (2, 2, 1)
    assert (found.mobility, found.local_mobility, found.redundant) == (1, 0, 1)
    assert problem.mechanism.higher[0].by == "3"
    assert len(pairs(problem.mechanism)) == 4


def test_a_higher_pair_may_be_in_any_group_and_by_any_name() -> None:
    numbered = _follower(ROUND + '\nby = "9"', ASSEMBLY)
    assert numbered.mechanism.links == ("1", "2", "9")
    text = FOLLOWER.format(pair=ROUND) + ASSEMBLY
    text = text.replace('["D", "C"]', '["D", "C", "F"]').replace(
        "DC = 0.1\n", 'DC = 0.1\nF = { on = "DC", at = 0.05 }\n'
    )
    text = text.replace(
        "[[higher_pairs]]",
        '[links.3]\npoints = ["F", "E"]\nFE = 0.15\n[links.4]\npoints = ["E"]\n'
        'slides = { on = "x-x" }\n[[higher_pairs]]',
    ).replace("[links.1]", 'guides.x-x = { through = "A", angle = 0 }\n[links.1]')
    problem = loads(text + 'E = "right of F"\n', name="cam")
    found = analyse(problem.mechanism)
    assert found.formula == "I(0,1) → II(2,5) → II(3,4)"
    assert found.redundant == 1 + 3
    aligned = self_aligning(problem, found)
    assert aligned.schemes[0]["K 1-2"] == "5t"
    assert aligned.rank == aligned.rows == 6 * 4 - 1


def _exact(phi: float) -> complex:
    """Return where the follower's centre of curvature is: two circles meet, the upper one."""
    o = cmath.rect(AO, phi)
    gap = D - o
    along = (REACH**2 - DC**2 + abs(gap) ** 2) / (2 * abs(gap))
    up = math.sqrt(REACH**2 - along**2)
    both = [o + gap / abs(gap) * complex(along, side * up) for side in (1, -1)]
    return max(both, key=lambda z: z.imag)


def test_the_replacing_mechanism_moves_the_follower_as_the_profiles_do() -> None:
    positions = [0.0, 40.0, 170.0, 265.0]
    solution = Solution(_follower(ROUND, ASSEMBLY), positions=positions)
    h = 1e-4
    for k, phi in enumerate(positions):
        turns = [cmath.phase(_exact(math.radians(phi) + s * h) - D) for s in (-1, 0, 1)]
        omega = (turns[2] - turns[0]) / (2 * h) * OMEGA
        epsilon = (turns[2] - 2 * turns[1] + turns[0]) / h**2 * OMEGA**2
        assert math.isclose(solution.links["2"].omega[k], omega, rel_tol=1e-7)
        assert math.isclose(solution.links["2"].epsilon[k], epsilon, rel_tol=1e-6)


def test_a_straight_follower_is_replaced_by_a_block_sliding_along_it() -> None:
    problem = _follower('centres = ["O"]\nslides = { along = "DC", offset = 0.04 }')
    solution = Solution(problem)
    assert solution.structure.groups[0].signature == "RPR"
    o = cmath.rect(AO, math.radians(40.0))
    turn = math.radians(solution.links["2"].phi_deg[0])
    # The disc of radius 0.04 touches the line through D.
    assert abs(((o - D) * cmath.rect(1.0, -turn)).imag) == pytest.approx(0.04, abs=1e-12)
    assert solution.structure.higher_pairs == 1


TAPPET = """
title = "Толкатель"
[frame]
A = [0, 0]
guides.y-y = {{ through = "A", angle = 90 }}
[links.1]
points = ["A", "O"]
AO = 0.02
[links.2]
points = ["B"]
slides = {{ on = "y-y" }}
[[higher_pairs]]
name = "K"
links = ["1", "2"]
centres = ["O"]
slides = {{ through = "B", angle = {angle}, offset = -0.03 }}
[driver]
link = "1"
phi = 40
omega = 10
epsilon = 0
"""


def test_a_round_tappet_may_turn_only_where_its_face_is_oblique() -> None:
    found = {}
    for angle in (0, 30):
        problem = loads(TAPPET.format(angle=angle), name="tappet")
        aligned = self_aligning(problem, analyse(problem.mechanism))
        found[angle] = [(one["K 1-2"], one["B 0-2"]) for one in aligned.schemes]
        assert aligned.rank == aligned.rows == 11
    # About its own line a level face turns freely under the cam, and tilts to the cam nevertheless.
    assert found[0] == [("5t", "1p")]
    assert sorted(found[30]) == [("4l", "2c"), ("5t", "1p")]


@pytest.mark.parametrize("lang", ["ru", "en"])
def test_the_replacement_is_described_and_drawn(lang: str) -> None:
    problem = _follower(ROUND + '\nroller = "3"', ASSEMBLY)
    found, words = analyse(problem.mechanism), get_language(lang)
    aligned = self_aligning(problem, found)
    document = structure_document(problem.mechanism, found, words, None, aligned)
    text = re.sub(r"\s+", " ", plain_document(document, words))
    told = {
        "ru": ("Высшую пару K звеньев 1–3 заменяем звеном 4 с низшими парами O (1–4), C (2–4).",
               "Ролик 3 на звене 2 вращается сам", "Заменяющий механизм: W = 3·3 − 2·4 = 1"),
        "en": ("The higher pair K of the links 1–3 is replaced by link 4 with the lower pairs",
               "The roller 3 on link 2 turns about itself", "mechanism: W = 3·3 − 2·4 = 1"),
    }[lang]  # fmt: skip
    assert all(line in text for line in told)
    assert "3·3 − 2·3 − 1 = 2" in text and "= 6·3 − 5·3 − 2·1 = 1" in text
    assert "= 1 + 1 − 1 = 1" in text and "6·3 − 5·3 − 1·1 = 2" in text
    sheet = structure_sheet(problem, found, aligned)
    letters = "".join(item.text for item in sheet.items if isinstance(item, Text))
    assert "заменяющего" in letters
    tags = [i.tag for i in sheet.items if isinstance(i, Stroke) and i.pen is Pen.HIDDEN]
    assert tags.count("link 4") == 2 and "link 1" not in tags  # in the scheme and in the group
