"""Instant centres and velocities by them, as tables and records (мгновенные центры скоростей)."""

from __future__ import annotations

from collections.abc import Iterator
from math import isnan
from typing import Any

import numpy as np

from planmethod.mechanism.model import FRAME
from planmethod.note.document import (
    Caption,
    Chapter,
    Document,
    Node,
    Paragraph,
    Table,
    Title,
    table_of,
)
from planmethod.note.formula import Rich, escape
from planmethod.note.narrate.naming import point_name
from planmethod.note.numbers import finite_or_none
from planmethod.note.wording import Language
from planmethod.solved.centres import Centre, Centres, find_centres
from planmethod.solved.reading import Reals
from planmethod.solved.solution import Solution


def centre_symbol(solution: Solution, first: str, second: str) -> Rich:
    """Return the symbol of a centre: ``P_{13}``, by the printed numbers of its links."""
    mechanism = solution.problem.mechanism
    names = [mechanism.called(link) for link in (first, second)]
    return f"P_{{{('' if max(map(len, names)) == 1 else ',').join(names)}}}"


def line_symbol(solution: Solution, centres: Centres, pair: tuple[str, str], by: str) -> Rich:
    """Return a line by the two centres of two links with a third one: ``P_{12}P_{23}``."""
    ends = (centres.of(link, by).links for link in pair)
    return "".join(centre_symbol(solution, *links) for links in ends)


def centres_table(solution: Solution, index: int, language: Language) -> Table:
    """Return all centres of a position, how each is found, and its place, m."""
    said, notation = language.sheets["centres"], language.notation
    centres, rows = find_centres(solution, index), list[list[Rich]]()
    for centre in centres.centres.values():
        place = ["", ""]
        if centre.is_infinite:
            turn = float(np.degrees(np.angle(centre.towards))) % 180.0
            place = [said["far"].format(angle=notation.as_input(round(turn, 2))), "∞"]
        elif not isnan(centre.at.real):
            place = [notation.short(x, 4) for x in (centre.at.real, centre.at.imag)]
        symbol = centre_symbol(solution, *centre.links)
        rows.append([symbol, _source_text(solution, centres, centre, language), *place])
    return table_of(said["heads"], rows, names=2)


def _source_text(solution: Solution, centres: Centres, centre: Centre, language: Language) -> Rich:
    said = language.sheets["centres"]
    if centre.point:
        return str(said["joint"].format(point=point_name(centre.point)))
    if centre.pole:
        return str(said["pole"].format(point=point_name(centre.pole)))
    if centre.slide:
        return str(said["slide"].format(line=escape(centre.slide)))
    if centre.by:
        lines = [line_symbol(solution, centres, centre.links, by) for by in centre.by]
        return str(said["lines"].format(first=lines[0], second=lines[1]))
    is_known = centre.is_infinite or not isnan(centre.at.real)
    return str(said["velocities" if is_known else "none"].format())


def motions_table(solution: Solution, index: int, language: Language) -> Table:
    """Return ω of the links, 1/s, and v of their points, m/s: by centres and by the plan."""
    said, notation = language.sheets["centres"], language.notation
    called, rows = solution.problem.mechanism.called, list[list[Rich]]()
    for symbol, link, by_centres, by_plan in velocities(solution, index):
        name = f"ω_{{{called(link)}}}" if not symbol else f"v_{{{symbol}}}"
        source = centre_symbol(solution, FRAME, link)
        rows.append([name, source, *map(notation.computed, (by_centres, by_plan))])
    return table_of(said["motion_heads"], rows, names=2)


def velocities(solution: Solution, index: int) -> Iterator[tuple[str, str, float, float]]:
    """Yield point (empty of an ω), link, and the value by centres and by the plan."""
    centres = find_centres(solution, index)
    for link in solution.problem.mechanism.links:
        if (motion := centres.motions.get(link)) is None:
            continue
        yield "", link, motion.omega, float(solution.links[link].omega[index])
    told: set[str] = set()
    for link, body in solution.problem.bodies.items():
        if link not in centres.motions:
            continue
        for point in body.points:
            if point in told or point not in solution.points:
                continue
            told.add(point)
            there = solution.points[point]
            speed = abs(there.velocity[index])
            if speed:
                found = abs(centres.motions[link].velocity(complex(there.place[index])))
                yield point, link, float(found), float(speed)


def centres_nodes(solution: Solution, index: int, language: Language) -> Iterator[Node]:
    """Yield the method and the tables of one position."""
    said = language.sheets["centres"]
    yield Paragraph(said["method"].format())
    yield centres_table(solution, index, language)
    yield Paragraph(said["by_centres"].format())
    yield motions_table(solution, index, language)


def centres_chapter(solution: Solution, index: int, language: Language) -> Iterator[Node]:
    """Yield the chapter on the centres of one position, of a protocol or a note."""
    yield Chapter(language.sheets["centres"]["title"].format())
    yield from centres_nodes(solution, index, language)


def centres_document(solution: Solution, language: Language) -> Document:
    """Return the centres of every position."""

    def nodes() -> Iterator[Node]:
        said = language.sheets["centres"]
        yield Title(said["title"].format())
        for index in range(len(solution.positions)):
            if len(solution.positions) > 1:
                title = said["title"].format()
                yield Caption(language.sheets.of_position.format(title=title, number=index))
            yield from centres_nodes(solution, index, language)

    return Document.of(nodes())


def centres_columns(solution: Solution) -> dict[str, Reals]:
    """Return columns of the centres, ndarrays of shape (n,): m, and degrees of those at infinity.

    Columns: ``P_13.x``, ``P_13.y``, ``P_13.towards_deg``, NaN where they do not apply.
    """
    found = [find_centres(solution, index) for index in range(len(solution.positions))]
    columns: dict[str, Reals] = {}
    for pair in found[0].centres if found else ():
        name = centre_symbol(solution, *pair).translate({ord("{"): None, ord("}"): None})
        own = [centres.centres[pair] for centres in found]
        columns[f"{name}.x"] = np.array([one.at.real for one in own])
        columns[f"{name}.y"] = np.array([one.at.imag for one in own])
        turned = [_angle(one) if one.is_infinite else np.nan for one in own]
        columns[f"{name}.towards_deg"] = np.array(turned)
    return columns


def centres_record(solution: Solution) -> list[dict[str, Any]]:
    """Return the centres of every position for JSON: m, degrees, 1/s."""
    return [_record(solution, index) for index in range(len(solution.positions))]


def _record(solution: Solution, index: int) -> dict[str, Any]:
    centres = find_centres(solution, index)
    called = solution.problem.mechanism.called
    listed = [
        {
            "links": [called(link) for link in one.links],
            "x": finite_or_none(one.at.real),
            "y": finite_or_none(one.at.imag),
            "towards_deg": _angle(one) if one.is_infinite else None,
            "joint": one.point or None,
            "pole": one.pole or None,
            "slide": one.slide or None,
            "lines": [
                [[called(link) for link in centres.of(end, by).links] for end in one.links]
                for by in one.by
            ],
        }
        for one in centres.centres.values()
    ]
    speeds = {
        f"v_{point}" if point else f"omega_{called(link)}": value
        for point, link, value, _ in velocities(solution, index)
    }
    return {"centres": listed, "velocities": speeds}


def _angle(centre: Centre) -> float:
    return float(np.degrees(np.angle(centre.towards))) % 180.0
