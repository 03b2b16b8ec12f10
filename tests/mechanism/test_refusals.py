from __future__ import annotations

import random

import numpy as np
import numpy.typing as npt
import pytest
from doors import (
    FRAME,
    ExitCode,
    Mechanism,
    Prismatic,
    Revolute,
    StructureError,
    analyse,
)
from drawings import mechanism

BALANCE = "Mobility W = 3n - 2p1 = 1, but only by count: "

REFUSED = {
    "loose end": (
        mechanism("A:01 B:12 C:23"),
        "Mobility W = 3n - 2p1 = 3·3 - 2·3 = 3, but 1 driver is given: pairs are missing. Link 3 "
        "has only one pair. Give the links more common points or slides, or remove the loose "
        "links.",
    ),
    "five-bar": (
        mechanism("A:01 B:12 C:23 D:34 E:04"),
        "Mobility W = 3n - 2p1 = 3·4 - 2·5 = 2, but 1 driver is given: pairs are missing. Give "
        "the links more common points or slides, or remove the loose links. Or give the motion of "
        "4 too: [[drivers]] is a list of driving links.",
    ),
    "two loose ends": (
        mechanism("A:01 B:12 C:13"),
        "Mobility W = 3n - 2p1 = 3·3 - 2·3 = 3, but 1 driver is given: pairs are missing. Links "
        "2, 3 have only one pair. Give the links more common points or slides, or remove the "
        "loose links.",
    ),
    "truss": (
        mechanism("A:01 B:12 C:02"),
        "Mobility W = 3n - 2p1 = 3·2 - 2·3 = 0, but 1 driver is given: the mechanism has too many "
        "pairs, or links are missing. Check for points with the same name and for slides "
        "given twice.",
    ),
    "third crank of a parallelogram": (
        mechanism("O:01 K:03 L:04 A:12 B:23 C:24"),
        "Mobility W = 3n - 2p1 = 3·4 - 2·6 = 0, but 1 driver is given: the mechanism has too many "
        "pairs, or links are missing. Check for points with the same name and for slides "
        "given twice. A link that only repeats the motion of the others is passive, as the third "
        "crank of a parallelogram is: leave one such out. Without link 3 or 4 W is 1.",
    ),
    "driver between others": (
        mechanism("A:01 B:12 C:23 D:03", driver="2"),
        "Driver 2 is not joined with the frame: its pairs are with links 1, 3. Drive a link that "
        "turns about a fixed point or slides on the frame: links 1, 3.",
    ),
    "driver unknown": (
        mechanism("A:01 B:12 C:23 D:03", driver="7"),
        "Driver 7 is not among the moving links 1, 2, 3. Name one of them as the driving link.",
    ),
    "driver held twice": (
        mechanism("A:01 B:12 C:23 D:03", "1/0@B"),
        "Driver 1 is joined with the frame by 2 pairs (point A, the slide of 1) and cannot move. "
        "Keep one of them.",
    ),
    "not connected": (
        mechanism("A:01 B:23 C:24"),
        "Links 2, 3, 4 are not connected with the frame by any chain of pairs. Check the names "
        "of the points: links are joined by points that share a name, by slides and by the "
        "points of [frame].",
    ),
    "one not connected": (
        Mechanism(("1", "2"), (Revolute("A", ("0", "1")),), (), "1"),
        "Link 2 is not connected with the frame by any chain of pairs. Check the names of the "
        "points: links are joined by points that share a name, by slides and by the points of "
        "[frame].",
    ),
    "wedge": (
        mechanism("", "1/0@A 2/1@B 2/0@B"),
        "The frame and links 1, 2 form a contour of 3 prismatic pairs only (PPP): it is not "
        "an Assur group, because its links do not turn and one pair repeats the constraints "
        "of the others on the angles. Make one of the pairs revolute.",
    ),
    "two slides on the frame": (
        mechanism("A:01 B:12", "2/0@C 2/0@D"),
        "The frame and link 2 form a contour of 2 prismatic pairs only (PPP): it is not an Assur "
        "group, because its links do not turn and one pair repeats the constraints of the "
        "others on the angles. Make one of the pairs revolute.",
    ),
    "PPP dyad": (
        mechanism("A:01 B:14 D:45 E:05", "2/4@C 3/2@C 3/4@C"),
        "Links 2, 3, 4 form a contour of 3 prismatic pairs only (PPP): it is not an Assur "
        "group, because its links do not turn and one pair repeats the constraints of the "
        "others on the angles. Make one of the pairs revolute.",
    ),
    "PPP closed through the crank": (
        mechanism("A:01", "2/1@B 3/2@C 3/0@C"),
        BALANCE + "the frame and links 1, 2, 3 have too many pairs among themselves, while links "
        "2, 3 have too few and do not follow the driver. Check which links share a point or a "
        "slide, and move a pair from the first to the second.",
    ),
    "two common points": (
        mechanism("A:01 B:12 C:23 D:23"),
        BALANCE + "links 2, 3 have too many pairs among themselves, while links 2, 3 have too few "
        "and do not follow the driver. Check which links share a point or a slide, and move a "
        "pair from the first to the second.",
    ),
    "tight here, loose there": (
        mechanism("A:01 B:12 C:02 D:03 E:34 F:45 G:05"),
        BALANCE + "the frame and links 1, 2 have too many pairs among themselves, while links "
        "3, 4, 5 have too few and do not follow the driver. Check which links share a point or a "
        "slide, and move a pair from the first to the second.",
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_faulty_mechanisms_are_rejected(name: str) -> None:
    mech, message = REFUSED[name]
    with pytest.raises(StructureError) as refused:
        analyse(mech)
    assert str(refused.value) == message
    assert refused.value.exit_code == ExitCode.PROBLEM


def _random_mechanism(rng: random.Random) -> Mechanism:
    """Links and pairs thrown together so that W = 1, good or bad."""
    n = rng.choice((3, 5, 7))
    links = [FRAME, *map(str, range(1, n + 1))]
    p1 = (3 * n - 1) // 2
    members: list[list[str]] = [[FRAME, "1"]]
    slides: list[tuple[str, str]] = []
    count = 1
    while count < p1:
        if rng.random() < 0.25:
            slides.append((rng.choice(links[2:]), rng.choice(links)))
            if slides[-1][0] == slides[-1][1]:
                slides.pop()
                continue
        elif rng.random() < 0.2:
            point = rng.choice(members)
            rest = [link for link in links[2:] if link not in point]
            if not rest:
                continue
            point.append(rng.choice(rest))
        else:
            members.append(rng.sample(links, 2))
        count += 1
    return Mechanism(
        tuple(links[1:]),
        tuple(
            Revolute(f"P{i}", tuple(sorted(point, key=links.index)))
            for i, point in enumerate(members)
        ),
        tuple(Prismatic(s, h, f"S{i}") for i, (s, h) in enumerate(slides)),
        "1",
    )


def _moves_definitely(mech: Mechanism, rng: random.Random) -> bool:
    """Rank of the constraints at a random pose: full when the driver settles everything."""
    spot = {link: 3 * i for i, link in enumerate(mech.links)}

    def slope(link: str, place: complex, u: complex) -> npt.NDArray[np.float64]:
        """Derivatives of the component along u of a point's place."""
        row = np.zeros(3 * len(spot))
        if link != FRAME:
            i = spot[link]
            row[i], row[i + 1], row[i + 2] = u.real, u.imag, (1j * place * u.conjugate()).real
        return row

    def turn(link: str) -> npt.NDArray[np.float64]:
        row = np.zeros(3 * len(spot))
        if link != FRAME:
            row[spot[link] + 2] = 1
        return row

    rows = []
    for joint in mech.revolutes:
        place = complex(rng.gauss(0, 1), rng.gauss(0, 1))
        first, *others = joint.links
        for other in others:
            rows += [slope(first, place, u) - slope(other, place, u) for u in (1, 1j)]
    for pair in mech.prismatics:
        place, u = (complex(rng.gauss(0, 1), rng.gauss(0, 1)) for _ in range(2))
        rows.append(slope(pair.slider, place, u) - slope(pair.host, place, u))
        rows.append(turn(pair.slider) - turn(pair.host))
    rows.append(turn("1"))  # the driver's direction is given
    return bool(np.linalg.matrix_rank(np.array(rows), tol=1e-9) == 3 * len(spot))


def test_a_mechanism_is_rejected_exactly_when_its_constraints_are_singular_in_every_pose() -> None:
    rng = random.Random(7)
    verdicts = {True: 0, False: 0}
    for _ in range(1500):
        mech = _random_mechanism(rng)
        try:
            analyse(mech)
            good = True
        except StructureError:
            good = False
        assert good == _moves_definitely(mech, rng), mech
        verdicts[good] += 1
    assert min(verdicts.values()) > 30
