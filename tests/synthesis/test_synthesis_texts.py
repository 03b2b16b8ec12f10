"""Texts, tables and sheets of syntheses: sides and ends that are named, columns, supports."""

from __future__ import annotations

import random
import re
from collections.abc import Iterator
from functools import cache
from itertools import pairwise
from math import atan2, degrees
from typing import Any

import pytest
from cases import each, some
from doors import (
    DRAFTING_PROFILES as PROFILES,
    HATCHING_GROUND as GROUND,
    WORDING_LANGUAGES as LANGUAGES,
    Arc,
    Document,
    Drawing,
    Drawn,
    Stroke,
    Synthesis,
    SynthesisFormulas,
    SynthesisNarrator,
    Text,
    check_rows,
    checks,
    get_language,
    place,
    plain_document,
    plain_text,
    point_name,
    set_angle,
    size_rows,
    size_symbol,
    steps,
    synthesis_document,
    synthesis_sheet,
)
from test_synthesis import ASKED, made

BOARD = PROFILES["board"]


def number(text: str) -> float:
    return float(text.replace("−", "-").replace(",", "."))


@cache
def drawn_of(name: str) -> Drawn:
    return Drawn(made(*ASKED[name])[0], BOARD)


def sentences(name: str) -> Iterator[tuple[str, dict[str, complex]]]:
    """Yield the sentences of a construction, and the places of points by their printed names."""
    drawn = drawn_of(name)
    at = {
        plain_text(point_name(step.out)): place(drawn.paper, step.out)
        for step in drawn.synthesis.board.steps
        if steps.result_kind(step) is steps.PointName
        and step.out not in drawn.synthesis.board.marks
    }
    for sentence in SynthesisNarrator(drawn, get_language("en")).sentences():
        yield plain_text(sentence), at


def two_points(text: str, at: dict[str, complex]) -> tuple[str, str]:
    """Return the points that a line is called by."""
    return next((text[:k], text[k:]) for k in range(1, len(text))
                if text[:k] in at and text[k:] in at)  # fmt: skip


# Sides and ends -----------------------------------------------------------------------------------

TURNED = re.compile(r"from point (\S+) at ([\d.]+)° to (\S+) \(to the (left|right) as")


def test_a_line_is_turned_to_the_stated_side() -> None:
    count = 0
    for name in ("slotted", "shaper", "quick", "loci", "angles", "offset", "positions"):
        for said, at in sentences(name):
            out = re.search(r"we get point (\S+?)\.$|get point (\S+?)\.$", said)
            found = TURNED.search(said)
            if found is None or out is None:
                continue
            origin, angle, base, side = found.groups()
            tail, head = two_points(base, at)
            way = (at[out[1] or out[2]] - at[origin]) / (at[head] - at[tail])
            turn = way if abs(way) > 0 else 1j
            left = turn.imag > 0
            if turn.real < -1e-9 and float(angle) < 90.0:
                left = not left  # the line is produced backwards to the point
            assert left == (side == "left"), (name, said)
            count += 1
    assert count >= 4


ENDS = {"upper": 1j, "lower": -1j, "right-hand": 1.0, "left-hand": -1.0}


def test_an_arc_and_a_line_intersect_at_the_stated_point() -> None:
    """The other one is its mirror image in the foot of the perpendicular from the centre."""
    seen = set()
    for name in ASKED:
        drawn = drawn_of(name)
        paper = drawn.paper
        told = {
            found[2]: found[1]
            for said, _ in sentences(name)
            if (found := re.search(r"we take the ([\w-]+) one, which is point (\S+?)\.", said))
        }
        for step in drawn.synthesis.board.steps:
            if not isinstance(step, steps.IntersectLineCircle):
                continue
            label = plain_text(point_name(step.out))
            if label not in told:
                continue
            one, centre = place(paper, step.out), place(paper, step.centre)
            course = complex(paper.value[step.line][1])
            along = course / abs(course)
            other = one - 2 * ((one - centre) * along.conjugate()).real * along
            way = ENDS[told[label]]
            assert ((one - other) * complex(way).conjugate()).real > 0, (name, label)
            seen.add(told[label])
    assert {"upper", "right-hand", "left-hand"} <= seen


def test_arcs_intersect_on_the_stated_side() -> None:
    count = 0
    for name in ASKED:
        for said, at in sentences(name):
            found = re.search(
                r"arcs about (\S+) with .* and about (\S+) with .* on the (left|right) of the line"
                r" .*: this is point (\S+?)\.",
                said,
            )
            if found is None:
                continue
            one, two, side, out = found.groups()
            turn = ((at[two] - at[one]).conjugate() * (at[out] - at[one])).imag
            assert (turn > 0) == (side == "left"), (name, said)
            count += 1
    assert count


def test_points_are_laid_off_in_the_stated_directions() -> None:
    """Lines at an angle to the x axis, parallel to it and perpendicular to it."""
    count = 0
    for name in ASKED:
        for said, at in sentences(name):
            found = re.search(
                r"From point (\S+) we lay off .*? (at ([-−\d.]+)° to|parallel to|perpendicular to) "
                r"the x axis(, in the opposite sense)? and get point (\S+?)\.$",
                said,
            )
            if found is None:
                continue
            origin, way, angle, back, out = found.groups()
            span = (at[out] - at[origin]) * (-1 if back else 1)
            if angle is not None:
                due = 1j ** (number(angle) / 90)
                assert span / abs(span) == pytest.approx(due, abs=1e-4), (name, said)
            elif way.startswith("parallel"):
                assert abs(span.imag) < 1e-6, (name, said)
                assert (span.real > 0) or name not in ("shaper", "steep"), (name, said)
            else:
                assert abs(span.real) < 1e-6, (name, said)
            count += 1
    assert count > 10


# Tables -------------------------------------------------------------------------------------------


@each("name", ASKED)
def test_the_table_of_sizes_has_exact_read_and_sigma_in_this_order(name: str) -> None:
    drawn, words = drawn_of(name), get_language("en")
    assert words.synthesis["columns"] == ("size", "exact, m", "read, m", "σ, m")
    lengths = drawn.synthesis.metres()
    for (length, metres), row in zip(lengths.items(), size_rows(drawn, words), strict=True):
        symbol, exact, seen, sigma = map(plain_text, row)
        assert symbol == ("e" if length == "e" else f"l_{length}")
        if "·" in exact + seen + sigma or "—" in seen:
            continue
        assert number(exact) == pytest.approx(metres, rel=6e-6, abs=1e-9)
        off = abs(number(seen) - metres)
        assert off <= 4 * number(sigma) + drawn.profile.ruler * drawn.mu + 1e-3 * abs(metres)


def test_the_sizes_are_those_of_the_mechanism_by_hand() -> None:
    """sin(ψ/2)·l_0 is the crank of a slotted link; half a stroke that of a central slider."""
    rows = {
        plain_text(r[0]): number(r[1]) for r in size_rows(drawn_of("shaper"), get_language("en"))
    }
    assert rows["l_O1A"] == pytest.approx(0.4 * 0.3420201433, rel=1e-5)
    assert (rows["l_O1O3"], rows["l_BC"]) == (0.4, 0.2)
    rows = {
        plain_text(r[0]): number(r[1]) for r in size_rows(drawn_of("central"), get_language("en"))
    }
    assert rows["l_OA"] == pytest.approx(0.1)
    assert rows["l_AB"] == pytest.approx(0.1 / 0.3, rel=1e-5)


def measured(name: str, lang: str = "en") -> dict[str, str]:
    found, problem = made(*ASKED[name])
    asked = {**checks(found, problem), **found.facts}
    rows = check_rows(asked, get_language(lang))
    keys = {text: key for key, text in get_language(lang).synthesis["checks"].items()}
    return {keys[title]: plain_text(value) for title, value in rows}


@each("lang", LANGUAGES)
@each("name", ["slotted", "shaper", "offset", "rocker", "beyond"])
def test_slow_and_quick_stroke_make_a_turn_and_their_ratio(name: str, lang: str) -> None:
    told = measured(name, lang)
    slow, quick = (number(told[key].rstrip("°")) for key in ("slow_deg", "quick_deg"))
    assert slow > quick
    assert slow + quick == pytest.approx(360.0, abs=1e-3)
    assert number(told["K_v"]) == pytest.approx(slow / quick, rel=1e-4)
    theta = (number(told["K_v"]) - 1) / (number(told["K_v"]) + 1) * 180
    assert slow == pytest.approx(180 + theta, abs=1e-2)


@each("name", ["offset", "rocker", "shaper"])
def test_pressure_and_transmission_angle_are_complements_and_swings_are_degrees(name: str) -> None:
    told = measured(name)
    pressure, transmission = (number(told[k].rstrip("°")) for k in ("pressure", "transmission"))
    assert pressure + transmission == pytest.approx(90.0, abs=1e-3)
    asked = ASKED[name][1]
    if "stroke" in asked:
        assert told["stroke"].endswith(" m")
        assert number(told["stroke"][:-2]) == pytest.approx(asked["stroke"])
    if "swing" in asked:
        assert number(told["swing"].rstrip("°")) == pytest.approx(asked["swing"])


def test_the_text_prints_the_table_under_its_heads() -> None:
    found, problem = made(*ASKED["shaper"])
    asked = {**checks(found, problem), **found.facts}
    words = get_language("en")
    nodes = synthesis_document(drawn_of("shaper"), asked, words)
    text = plain_document(Document.of(nodes), words)
    assert re.search(r"\nsize +exact, m +read, m +σ, m\n", text)
    row = re.search(r"\nl_O1A +(\S+) +(\S+) +(\S+)\n", text)
    assert row is not None
    assert number(row[1]) == pytest.approx(0.136808)
    assert number(row[2]) / (0.5 * drawn_of("shaper").mu) % 1 == pytest.approx(0.0, abs=1e-6)
    assert number(row[3]) < 0.01


# Sheets -------------------------------------------------------------------------------------------


@cache
def sheet_of(name: str) -> tuple[Drawing, Synthesis]:
    kind, asked = ASKED[name]
    found, problem = made(kind, asked)
    measured = {**checks(found, problem), **found.facts}
    return synthesis_sheet(Drawn(found, BOARD), problem, measured), found


def supports(drawing: Drawing, found: Synthesis) -> Iterator[tuple[str, complex, Drawn]]:
    """Yield the pivots, the places of their supports on the sheet, and the drawing at its scale."""
    drawn = Drawn(found, BOARD, drawing.views[0].per_mm)
    own = {pivot: place(drawn.paper, pivot) for pivot in found.pivots}
    legs = [i.points[1] for i in drawing.items
            if isinstance(i, Stroke) and len(i.points) == 3 and not i.closed
            and abs(abs(i.points[2] - i.points[0]) - 9.0) < 1e-6]  # fmt: skip
    assert len(legs) == len(own)
    shift = sum(legs) / len(legs) - sum(own.values()) / len(own)
    for pivot, at in own.items():
        assert min(abs(leg - at - shift) for leg in legs) < 1e-6
        yield pivot, at + shift, drawn


@each("name", ("slotted", "shaper", "offset", "below", "rocker", "beyond", "positions", "angles"))
def test_supports_point_away_from_the_links_with_the_hatching_behind_their_base(name: str) -> None:
    drawing, found = sheet_of(name)
    strokes = [item for item in drawing.items if isinstance(item, Stroke)]
    for pivot, at, drawn in supports(drawing, found):
        (legs,) = (s for s in strokes if len(s.points) == 3 and abs(s.points[1] - at) < 1e-6)
        foot = (legs.points[0] + legs.points[2]) / 2 - at
        assert abs(foot.real) < 1e-6  # straight up or down
        hatching = [
            point - at
            for stroke in strokes
            for middle in [sum(stroke.points) / len(stroke.points) - at - foot]
            if stroke.tag == GROUND and abs(middle.real) < 7.0 and abs(middle.imag) < 2.5
            for point in stroke.points
        ]
        assert hatching
        middle = sum(hatching) / len(hatching)
        beyond = [(p * foot.conjugate()).real / abs(foot) for p in hatching]
        assert min(beyond) > abs(foot) - 0.01  # none between the pivot and its base
        assert (middle * foot.conjugate()).real > abs(foot) ** 2
        rises = []
        for pose in found.poses:
            for points in pose.links:
                for p, q in pairwise(points):
                    if pivot in (p, q):
                        way = place(drawn.paper, q if p == pivot else p) - place(drawn.paper, pivot)
                        rises.append((way / abs(way)).imag)
        assert rises
        assert foot.imag * sum(rises) <= 1e-6, (name, pivot)  # away from the links
        if abs(sum(rises)) < 1e-6:
            assert foot.imag < 0  # down, unless the links are on one side


@each("name", ("slotted", "shaper", "quick"))
def test_sliding_blocks_are_parallel_to_their_slotted_links(name: str) -> None:
    drawing, found = sheet_of(name)
    places = {pivot: (at, drawn) for pivot, at, drawn in supports(drawing, found)}
    at, drawn = places["O3"]
    shift = at - place(drawn.paper, "O3")
    boxes = [i.points for i in drawing.items
             if isinstance(i, Stroke) and i.closed and len(i.points) == 4]  # fmt: skip
    for pose in found.poses:
        for pin, foot in pose.stones:
            here = place(drawn.paper, pin) + shift
            along = place(drawn.paper, pin) - place(drawn.paper, foot)
            box = min(boxes, key=lambda points: abs(sum(points) / 4 - here))
            assert abs(sum(box) / 4 - here) < 1e-6
            sides = sorted((b - a for a, b in pairwise(box)), key=abs)
            assert abs(sides[-1]) > abs(sides[0]) + 1.0
            assert abs((sides[-1] * along.conjugate()).imag) < 1e-6 * abs(sides[-1] * along)


@each("name", ("offset", "below", "shaper"))
def test_the_guide_is_drawn_under_all_its_sliders(name: str) -> None:
    drawing, found = sheet_of(name)
    (_, at, drawn), *_ = supports(drawing, found)
    shift = at - place(drawn.paper, found.pivots[0])
    sliders = [place(drawn.paper, p) + shift for pose in found.poses for p in pose.sliders]
    low = min(slider.imag for slider in sliders)
    (line,) = (
        item.points for item in drawing.items
        if isinstance(item, Stroke) and len(item.points) == 2 and item.tag != GROUND
        and item.points[0].imag == pytest.approx(item.points[1].imag)
        and 2.0 < low - item.points[0].imag < 6.0
        and item.points[0].real < min(s.real for s in sliders) - 13.0
        and item.points[1].real > max(s.real for s in sliders) + 13.0
        and item.points[0].real > min(s.real for s in sliders) - 15.0
    )  # fmt: skip
    hatching: list[Any] = [
        s.points for s in drawing.items if isinstance(s, Stroke) and s.tag == GROUND
        and line[0].real - 1 < s.points[0].real < line[1].real + 1
        and -4.0 < min(p.imag for p in s.points) - line[0].imag < 0.1
    ]  # fmt: skip
    assert len(hatching) > 10


@pytest.mark.parametrize("name", ["loci", "rocker"])
def test_the_angle_between_the_dead_positions_is_marked(name: str) -> None:
    kind, asked = ASKED[name]
    found, problem = made(kind, asked)
    measured = {**checks(found, problem), **found.facts}
    sheet = synthesis_sheet(Drawn(found, BOARD), problem, measured)
    (arc,) = (item for item in sheet.items if isinstance(item, Arc) and item.tag == "theta")
    ratio = asked["K_v"]
    assert degrees(arc.end - arc.start) == pytest.approx(180.0 * (ratio - 1.0) / (ratio + 1.0))
    size = get_language("ru").notation.as_input(round(180.0 * (ratio - 1.0) / (ratio + 1.0), 2))
    assert [t.text for t in sheet.items if isinstance(t, Text) and t.label == "theta"] == [
        f"θ = {size}°"
    ]
    told = SynthesisFormulas(Drawn(found, BOARD), get_language("ru"))
    assert told.lines[0].startswith("θ = 180°·")
    assert told.values["θ"] == pytest.approx(180.0 * (ratio - 1.0) / (ratio + 1.0))


@pytest.mark.parametrize("name", ASKED)
def test_formulas_give_the_sizes_of_the_construction(name: str) -> None:
    """They are calculated from the given data by triangles, without the construction."""
    found, _ = made(*ASKED[name])
    told = SynthesisFormulas(Drawn(found, BOARD), get_language("en"))
    sizes = {size_symbol(size): value for size, value in found.metres().items()}
    assert told.values.keys() & sizes.keys()
    for symbol in told.values.keys() & sizes.keys():
        assert told.values[symbol] == pytest.approx(abs(sizes[symbol]), rel=1e-9), symbol


@each("seed", range(some(200, 40)))
def test_an_angle_is_laid_off_by_a_mark_of_the_protractor_or_by_two_legs(seed: int) -> None:
    words = get_language("en")
    angle = random.Random(seed).uniform(0.4, 179.6)
    for value in (round(2 * angle) / 2, angle):
        told = plain_text(set_angle(value, 0.5, words))
        assert told.startswith(f"{words.notation.as_input(round(value, 2))}°")
        legs = re.search(r"tan\s([\d.]+)° = ([\d.]+)\s:\s([\d.]+)", told)
        if value != angle:
            assert legs is None
            continue
        assert legs is not None
        sharp, across, along = map(float, legs.groups())
        assert sharp == pytest.approx(min(value, 180.0 - value), abs=0.006)
        assert degrees(atan2(across, along)) == pytest.approx(sharp, abs=0.08)
        assert max(across, along) <= 120 and all(2 * leg == int(2 * leg) for leg in (across, along))
