"""Schemes without redundant constraints: true by rank, as another program finds it."""

from __future__ import annotations

import cmath
import math
import random
import re
from functools import cache
from itertools import combinations, product

import pytest
from cases import each, sampled, some
from doors import (
    FRAME,
    Drive,
    HigherPair,
    Mechanism,
    ModelProblem as Problem,
    Prismatic,
    Revolute,
    SelfAligning,
    Solution,
    aligned_lines,
    aligned_record,
    analyse,
    constraint_rank,
    get_language,
    poses,
    problem_loads as loads,
    self_aligning,
    structure_sheet,
)
from mechanisms import TRIAD
from msgspec.structs import replace
from newton import solve as newton
from spatial import Rank, rank_of
from worked import PROBLEMS, problem_of

from benchmarks.generator import random_problem

LEVERS = ("levers/task-13", "levers/task-33", "levers/task-49", "levers/crosshead")
NAMES = ("linkages/ex1", "linkages/ex3", "levers/six-link", "levers/task12", "press/press",
         "press/press-stone", "levers/task-12", *LEVERS)  # fmt: skip


@cache
def aligned(name: str) -> SelfAligning:
    problem = problem_of(name)
    return self_aligning(problem, analyse(problem.mechanism))


def places_of(
    problem: Problem, found: SelfAligning, position: float | None = None
) -> dict[str, tuple[complex, complex]]:
    """Return where the pairs are by the plans' own program, not by that which finds the schemes."""
    at = problem.drive.positions[0] if position is None else position
    solution = Solution(problem, positions=[at])
    points = {name: complex(point.place[0]) for name, point in solution.points.items()}
    turns = {link: math.radians(motion.phi_deg[0]) for link, motion in solution.links.items()}
    return _places(problem, found, points, {FRAME: 0.0, **turns})


def _places(
    problem: Problem, found: SelfAligning, points: dict[str, complex], turns: dict[str, float]
) -> dict[str, tuple[complex, complex]]:
    places = {}
    for pair in found.pairs:
        if isinstance(pair.joint, Revolute):
            places[pair.key] = (points[pair.joint.point], 0j)
            continue
        assert isinstance(pair.joint, Prismatic)
        slide = problem.slides[pair.joint.slider]
        along = cmath.rect(1.0, turns[slide.host] + math.radians(slide.angle))
        places[pair.key] = (points[slide.pin] - 1j * slide.offset * along, along)
    return places


def _is_true(rank: Rank) -> bool:
    return (rank.redundant, rank.mobility, rank.counted) == (0, 1, 1)


@pytest.mark.parametrize("name", NAMES)
def test_every_scheme_is_true_by_rank_in_the_position_of_the_file_and_beside_it(name: str) -> None:
    problem, found = problem_of(name), aligned(name)
    assert found.schemes
    for away in (0.0, 3.7):
        places = places_of(problem, found, problem.drive.positions[0] + away)
        for scheme in found.schemes:
            rank = rank_of(scheme, places)
            assert _is_true(rank), (scheme, rank)
    assert found.rank == 6 * len(problem.mechanism.links) - 1
    assert sum(k * count for k, count in found.counts.items()) == 6 * (
        len(found.pairs) - len(problem.mechanism.links)
    ) + 1  # fmt: skip


@pytest.mark.parametrize("name", NAMES)
def test_no_scheme_that_keeps_its_groups_apart_is_forgotten(name: str) -> None:
    problem, found = problem_of(name), aligned(name)
    places = places_of(problem, found, problem.drive.positions[0] + 3.7)
    first = found.drivers[0].key
    every = 1
    for group in found.groups:
        own = list(group.pairs)
        known = {"0", *_links_before(found, group.group.links)}
        good = set()
        for classes in product(*(pair.classes for pair in own)):
            named = dict(zip((pair.key for pair in own), classes, strict=True))
            there = {_grounded(key, known): places[key] for key in named}
            judged = rank_of({_grounded(key, known): name for key, name in named.items()}, there)
            if (judged.redundant, judged.mobility) == (0, 0):
                good.add(classes)
        assert {scheme.classes for scheme in group.schemes} == good
        every *= len(good)
    assert len(found.schemes) == every
    assert all(scheme[first][0] == "1" for scheme in found.schemes)


def _links_before(found: SelfAligning, links: tuple[str, ...]) -> set[str]:
    before = set(found.drivers[0].links)
    for group in found.groups:
        if group.group.links == links:
            break
        before |= set(group.group.links)
    return before


def _grounded(key: str, known: set[str]) -> str:
    point, ends = key.split()
    return f"{point}.{ends} " + "-".join("0" if x in known else x for x in ends.split("-"))


def test_the_printed_scheme_of_the_six_link_is_right_by_count_and_wrong_by_rank() -> None:
    problem, found = problem_of("levers/six-link"), aligned("levers/six-link")
    places = places_of(problem, found)
    printed = {pair.key: pair.classes[0] for pair in found.pairs}
    printed |= {"C 2-3": "2c", "D 0-3": "3s", "H 4-5": "3s", "H 0-5": "2c"}
    rank = rank_of(printed, places)
    assert (rank.counted, rank.redundant, rank.mobility) == (1, 1, 2)
    assert printed not in found.schemes
    group = found.groups[1]
    assert [pair.key for pair in group.pairs] == ["H 4-5", "H 2-4", "H 0-5"]
    wrong = {scheme.classes: scheme.loose for scheme in group.counted}
    assert wrong[("3s", "1p", "2c")] == wrong[("3s", "2c", "1p")] == 1
    assert {scheme.classes for scheme in group.schemes} == {
        ("2c", "2c", "2c"), ("1v", "2c", "3pl"), ("1v", "3pl", "2c"),
    }  # fmt: skip


REFERENCE = {  # numbers of schemes group by group, found elsewhere by exhaustion
    "linkages/ex1": 3, "linkages/ex3": 6, "levers/six-link": 18, "levers/task12": 4,
    "press/press": 6, "press/press-stone": 6,
}  # fmt: skip


@pytest.mark.parametrize("name", REFERENCE)
def test_as_many_schemes_are_found_as_there_are(name: str) -> None:
    assert len(aligned(name).schemes) == REFERENCE[name]


@each("seed", sampled(range(some(200, few=25)), 3))
def test_random_mechanisms_have_true_schemes_the_best_first(seed: int) -> None:
    text, pose = random_problem(seed)
    problem = loads(text, name=f"random-{seed}")
    found = self_aligning(problem, analyse(problem.mechanism))
    motion = newton(problem, problem.drive.positions[0], pose)
    points = {point: place for (_, point), place in motion.position.items()}
    for pair in found.pairs:
        if isinstance(pair.joint, Prismatic):
            points[pair.joint.pin] = motion.position[pair.joint.slider, pair.joint.pin]
    turns = {FRAME: 0.0} | {link: where[2] for link, where in motion.pose.items()}
    places = _places(problem, found, points, turns)
    assert found.schemes
    for scheme in found.schemes:
        assert _is_true(rank_of(scheme, places)), scheme
    changes = [sum(name[0] != "1" for name in scheme.values()) for scheme in found.schemes]
    assert changes == sorted(changes)
    assert len({tuple(scheme.items()) for scheme in found.schemes}) == len(found.schemes)


def _bare(points: str, slides: str = "") -> Problem:
    revolutes, prismatics, links = [], [], []
    for word in points.split():
        name, ends = word.split(":")
        revolutes.append(Revolute(name, tuple(ends)))
        links += [end for end in ends if end != FRAME and end not in links]
    for word in slides.split():
        ends, pin = word.split("@")
        slider, host = ends.split("/")
        prismatics.append(Prismatic(slider, host, pin))
        links += [end for end in (slider, host) if end != FRAME and end not in links]
    mechanism = Mechanism(tuple(sorted(links)), tuple(revolutes), tuple(prismatics), "1")
    drive = Drive("1", "A", (0.0,), 1.0, 0.0)
    return Problem(name="b", title="b", mechanism=mechanism, bodies={}, slides={}, drive=drive)


@pytest.mark.parametrize(
    ("points", "slides", "changes"),
    [
        ("A:01 B:12 C:23 D:34 E:04 F:35 G:05", "", 3),  # class III
        ("A:01 B:13 C:23 D:24 E:25", "4/0@D 5/0@E", 3),
        ("A:01 B:12 C:23 D:24 E:35 F:45 G:05", "", 3),  # class IV
        ("A:01 B:12 C:23 D:03 E:246 F:45 G:05 H:67 K:07", "", 6),  # two groups on one hinge
        ("A:01 D:05 B:14 C:245 E:23", "3/0@E", 4),  # the hinge closed by a later part of the file
    ],
)
def test_groups_of_any_class_without_sizes(points: str, slides: str, changes: int) -> None:
    problem = _bare(points, slides)
    structure = analyse(problem.mechanism)
    found = self_aligning(problem, structure)
    assert found.schemes
    assert found.rank == 6 * len(problem.mechanism.links) - 1
    assert sum(name[0] != "1" for name in found.schemes[0].values()) == changes
    assert set(found.schemes[0]) == {pair.key for pair in found.pairs}
    assert len(found.pairs) == problem.mechanism.lower_pairs
    rng = random.Random(7)
    at = {name: complex(rng.uniform(-1, 1), rng.uniform(-1, 1)) for name in "ABCDEFGHK"}
    lines = {pair.key: cmath.rect(1.0, rng.uniform(0, 3)) if isinstance(pair.joint, Prismatic)
             else 0j for pair in found.pairs}  # fmt: skip
    places = {key: (at[key[0]], along) for key, along in lines.items()}
    assert all(_is_true(rank_of(scheme, places)) for scheme in found.schemes)


def test_a_scheme_that_jams_in_the_position_of_the_file_is_left_out() -> None:
    text = (PROBLEMS / "linkages/ex1.toml").read_text("utf-8")
    every = []
    for phi in ("phi = 0", "phi = 33"):
        problem = loads(re.sub(r"(?m)^phi = [0-9.]+", phi, text), name="slider-crank")
        found = self_aligning(problem, analyse(problem.mechanism))
        every.append([scheme.classes for scheme in found.groups[0].schemes])
    # The sphere B is on the cylinder's line, about which the rod and the slider are loose.
    assert ("3s", "1v", "2c") not in every[0] and ("3s", "1v", "2c") in every[1]
    assert not next(s for s in found.groups[0].schemes if s.classes == ("3s", "1v", "2c")).steady
    assert set(every[0]) < set(every[1])


def test_sizes_that_close_nowhere_give_the_schemes_of_random_ones() -> None:
    text = (PROBLEMS / "linkages/ex2.toml").read_text("utf-8")
    problem = loads(re.sub(r"(?m)^((?:AB|BC) = )[0-9.]+", r"\g<1>0.0001", text), name="open")
    found = self_aligning(problem, analyse(problem.mechanism))
    assert len(found.schemes) == 6 and found.rank == 17
    assert found.random and aligned_record(found)["sizes"] == "random"
    told = next(
        aligned_lines(problem.mechanism, analyse(problem.mechanism), found, get_language("ru"))
    )
    assert told.endswith("ранги найдены при случайных размерах.")
    assert not aligned("linkages/2.1.15").random  # its position is found by an angle of links
    assert not aligned("linkages/ex1").random and "sizes" not in aligned_record(
        aligned("press/press")
    )


def test_a_group_of_class_three_closes_and_has_schemes_in_its_own_pose() -> None:
    problem = loads(TRIAD, name="triad")
    structure = analyse(problem.mechanism)
    swept = poses(problem, structure)
    assert len(swept) == 24
    known = (0.235632 + 0.080103j, 0.109611 + 0.232919j)  # found elsewhere, to 1e-6
    assert min(abs(swept[0].places["B"] - one) for one in known) < 1e-6
    found = self_aligning(problem, structure)
    for pose in swept[:4]:
        places = {pair.key: pose.line(pair.joint) for pair in found.pairs}
        assert all(_is_true(rank_of(scheme, places)) for scheme in found.schemes)
    assert found.rank == found.rows == 29


def _touched(text: str) -> str:
    """Return a triad whose legs are profiles that touch: its base link lies on three of them."""
    for link, ends, name, frame in (("2", "AB", "K", "1"), ("4", "EC", "L", "0"),
                                    ("5", "FD", "M", "0")):  # fmt: skip
        leg = rf'\[links.{link}\]\npoints = \["{ends[0]}", "{ends[1]}"\]\n{ends} = ([0-9.]+)\n'
        pair = f'name = "{name}"\nlinks = ["{frame}", "3"]\ncentres = {list(ends)}\n'
        text = re.sub(leg, rf"[[higher_pairs]]\n{pair}distance = \1\n", text)
    return text.replace("'", '"')


def test_a_link_on_three_profiles_keeps_a_local_mobility_which_is_reported() -> None:
    problem = loads(_touched(TRIAD), name="touched")
    found = self_aligning(problem, structure := analyse(problem.mechanism))
    assert structure.higher_pairs == 3 and [group.links for group in found.groups] == [("3",)]
    keys = ("K 1-3", "L 0-3", "M 0-3")
    judged = {}
    for pose in poses(problem, structure)[:4]:
        places = {pair.key: pose.line(pair.joint) for pair in found.pairs}
        for classes in product(("4l", "5t"), repeat=3):
            scheme = {"O 0-1": "1v", **dict(zip(keys, classes, strict=True))}
            rank = rank_of(scheme, places)
            judged[classes] = (rank.redundant, rank.mobility, classes.count("5t"))
        # One point is enough: with more of them the link turns as well.
        best = [one for one, told in judged.items() if told == (0, 2, 1)]
        assert len(best) == 3 and judged["4l", "4l", "4l"] == (1, 2, 0)
        assert {one for one, told in judged.items() if told[0] == 0 and told[1] < 3} == {*best}
        assert {tuple(one[key] for key in keys) for one in found.schemes} == {*best}
    assert found.local == (1, 1, 1) and found.rank == found.rows == 10
    record = aligned_record(found)
    assert record["valid"] and record["local_mobility"] == [1, 1, 1]
    assert record["reason"] == "every scheme of the links 3 with q = 0 leaves a local mobility"
    told = aligned_lines(problem.mechanism, structure, found, get_language("ru"))
    lines = [line.replace("\u00a0", " ") for line in told]
    assert "W_{пр} = 6·1 − 2·2 − 1·1 = 1, q = 0" in lines[0] and "W_{м} = 1" in lines[1]
    assert "Схема без изменения пар не годится" in lines[3] and "меньше на 1" in lines[3]
    assert "W_{пр} = 6·2 − 5·1 − 2·2 − 1·1 = 2; q = 1 + 1 − 2 = 0" in lines[5]
    assert structure_sheet(problem, structure, found).items


def test_schemes_with_a_local_mobility_are_those_of_an_exhaustive_search(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """With the regular schemes excluded, as if there were none: those then offered for a group."""
    monkeypatch.setattr("planmethod.solved.aligned.schemes.TRIED", 0)
    for points, slides in (("A:01 B:12 C:23 D:03", ""), ("A:01 B:12 C:23", "3/0@C"),
                           ("A:01 B:13 C:23 D:24 E:25", "4/0@D 5/0@E")):  # fmt: skip
        problem = _bare(points, slides)
        found = self_aligning(problem, structure := analyse(problem.mechanism))
        pose = poses(problem, structure)[2]
        places = {pair.key: pose.line(pair.joint) for pair in found.pairs}
        good = {}
        for classes in product(*(pair.classes for pair in found.groups[0].pairs)):
            named = dict(zip((pair.key for pair in found.groups[0].pairs), classes, strict=True))
            rank = rank_of({found.drivers[0].key: "1v", **named}, places)
            if rank.redundant == 0 and rank.mobility > 1:
                changes = sum(name[0] != "1" for name in classes)
                good[classes] = (changes, rank.mobility - 1)
        best = {
            one for one, (changes, local) in good.items()
            if not any(c <= changes and m <= local and (c, m) != (changes, local)
                       for c, m in good.values())
        }  # fmt: skip
        schemes = found.groups[0].schemes
        assert {one.classes for one in schemes} == best and best
        assert all((one.changes, one.local) == good[one.classes] for one in schemes)
        assert [one.changes for one in schemes] == sorted(one.changes for one in schemes)


def test_if_no_scheme_is_found_the_links_are_named(monkeypatch: pytest.MonkeyPatch) -> None:
    for tried in ("TRIED", "TRIED_FREER"):
        monkeypatch.setattr(f"planmethod.solved.aligned.schemes.{tried}", 0)
    problem = problem_of("levers/six-link")
    structure = analyse(problem.mechanism)
    record = aligned_record(found := self_aligning(problem, structure))
    assert (record["valid"], record["schemes"]) == (False, [])
    assert "2-3; 4-5" in record["reason"]
    lines = list(aligned_lines(problem.mechanism, structure, found, get_language("ru")))
    assert len(lines) == 1 and "2–3; 4–5" in lines[0]
    assert structure_sheet(problem, structure, found).items


@pytest.mark.parametrize(
    ("points", "slides", "higher"),
    [
        ("A:01 B:12 C:23 D:34 E:04 F:35 G:05", "", HigherPair("K", ("1", "3"), "2")),
        ("A:01 O:15 C:23 D:03 E:24 F:04", "5/2@O", HigherPair("K", ("1", "2"), "5")),
    ],
)
def test_profiles_that_touch_are_freed_with_the_pairs_of_their_group(
    points: str, slides: str, higher: HigherPair
) -> None:
    bare = _bare(points, slides)
    problem = replace(bare, mechanism=replace(bare.mechanism, higher=(higher,)))
    found = self_aligning(problem, structure := analyse(problem.mechanism))
    assert structure.redundant == 1 - (6 * 4 - 5 * 5 - 2)
    assert {scheme["K 1-" + higher.links[1]] for scheme in found.schemes} == {"4l", "5t"}
    for pose in poses(problem, structure):
        places = {pair.key: pose.line(pair.joint) for pair in found.pairs}
        if slides:  # the normal of a straight profile is across its line
            (along,) = (line for _, line in pose.lines.values())
            places["K 1-2"] = (places["K 1-2"][0], 1j * along)
        assert all(_is_true(rank_of(scheme, places)) for scheme in found.schemes)
    assert found.rank == found.rows == 6 * 4 - 1
    plane = {pair.key: pair.classes[0] for pair in found.pairs}
    for one in combinations(found.groups[0].pairs, 2):
        for classes in product(*(pair.classes[1:] for pair in one)):
            scheme = plane | dict(zip((pair.key for pair in one), classes, strict=True))
            assert (scheme in found.schemes) == _is_true(rank_of(scheme, places)), scheme


@pytest.mark.parametrize("name", NAMES[:6])
def test_the_rank_of_all_constraints_is_that_of_the_contours(name: str) -> None:
    problem, found = problem_of(name), aligned(name)
    pose = poses(problem, analyse(problem.mechanism))[3]
    places = {pair.key: pose.line(pair.joint) for pair in found.pairs}
    rng = random.Random(3)
    tried = [{pair.key: rng.choice(pair.classes) for pair in found.pairs}
             for _ in range(some(200, few=25))]  # fmt: skip
    for group in found.groups:
        keys = [pair.key for pair in group.pairs]
        tried += [
            dict(found.schemes[0]) | dict(zip(keys, one.classes, strict=True))
            for one in group.counted
        ]
    for classes in tried:
        rows = sum(6 - int(one[0]) for one in classes.values())
        told = rank_of(classes, places)
        assert constraint_rank(found.pairs, classes, pose) == rows - told.redundant, classes


def test_a_driver_alone_has_no_redundant_constraints() -> None:
    problem = _bare("A:01")
    assert self_aligning(problem, analyse(problem.mechanism)).schemes == ({"A 0-1": "1v"},)


def test_ten_links_are_searched_at_once() -> None:
    problem = _bare("A:01 B:12 C:23 D:03 E:34 F:45 G:05 H:56 K:67 L:07 M:78 N:89 P:09")
    found = self_aligning(problem, analyse(problem.mechanism))
    assert len(found.schemes) == 60  # of 6⁴
    assert all(sum(name[0] != "1" for name in scheme.values()) == 8 for scheme in found.schemes)


def test_shipped_levers_have_schemes() -> None:
    none = []
    for path in sorted((PROBLEMS / "levers").glob("*.toml")):
        name = f"levers/{path.stem}"
        if not aligned(name).schemes:
            none.append(name)
    assert none == []
