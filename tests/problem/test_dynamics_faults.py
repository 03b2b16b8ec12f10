"""Faulty masses and loads: every fault is reported with exactly this message, and no other."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path
from typing import Any

import pytest
from doors import ProblemError, problem_loads as loads
from mechanisms import CRANK, LOADED, SLIDER, messages

F = '[[loads]]\nlink = "2"\nat = "S2"\n'
M = '[[loads]]\nlink = "2"\n'
A = "angle = 0\n"

FAULTS = {
    "dynamics a number": (
        "dynamics = 3\n",
        ['dynamics: expected a table, got the integer 3. For example: [dynamics.links.2] mass = '
         '40, centre = "S2", inertia = 2'],
    ),
    "unknown key": (
        "[dynamics]\ngravitiy = 9.8\n",
        ["dynamics.gravitiy: unknown key. Did you mean 'gravity'?"],
    ),
    "gravity true": (
        "[dynamics]\ngravity = true\n",
        ["dynamics.gravity: expected a number in m/s² or false, got the boolean true. Omit this "
         "key for 9.81."],
    ),
    "gravity negative": (
        "[dynamics]\ngravity = -9.81\n",
        ["dynamics.gravity: expected an acceleration of free fall in m/s² from 0 to 10000, got "
         "-9.81. Check the unit: the file is in SI units and degrees."],
    ),
    "resultant a number": (
        "[dynamics]\nresultant = 1\n",
        ["dynamics.resultant: expected true or false, got the integer 1"],
    ),
    "resultant in quotes": (
        '[dynamics]\nresultant = "true"\n',
        ["dynamics.resultant: expected true or false, got the string 'true'. Write it without "
         "quotes."],
    ),
    "mass of an unknown link": (
        "[dynamics.links.7]\nmass = 1\n",
        ["dynamics.links.7: unknown link '7'. Known here: 1, 2, 3."],
    ),
    "mass of the frame": (
        "[dynamics.links.0]\nmass = 1\n",
        ["dynamics.links.0: 0 is the frame (стойка), which does not move. Moving links have mass: "
         "1, 2, 3."],
    ),
    "mass negative": (
        '[dynamics.links.2]\nmass = -40\ncentre = "S2"\n',
        ["dynamics.links.2.mass: expected a mass in kg, 0 or greater, got -40"],
    ),
    "mass in quotes": (
        '[dynamics.links.3]\nmass = "40,5"\n',
        ["dynamics.links.3.mass: expected a mass in kg, got the string '40,5'. Write 40.5 without "
         "quotes."],
    ),
    "mass not a number": (
        "[dynamics.links.3]\nmass = nan\n",
        ["dynamics.links.3.mass: expected a mass in kg, got nan. The number must be finite."],
    ),
    "mass huge": (
        "[dynamics.links.3]\nmass = 1e300\n",
        ["dynamics.links.3.mass: expected a mass in kg from 0 to 1e+12, got 1e+300. Check "
         "the unit: the file is in SI units and degrees."],
    ),
    "inertia negative": (
        "[dynamics.links.1]\ninertia = -5\n",
        ["dynamics.links.1.inertia: expected a moment of inertia in kg·m², 0 or greater, got -5"],
    ),
    "no centre": (
        "[dynamics.links.2]\nmass = 40\n",
        ["dynamics.links.2.centre: missing. Name the centre of mass among the points of link 2 "
         "(B, C, S2), or give the link another point there."],
    ),
    "centre misspelt": (
        '[dynamics.links.2]\nmass = 40\ncenter = "S2"\n',
        ["dynamics.links.2.center: unknown key. Did you mean 'centre'?"],
    ),
    "centre on another link": (
        '[dynamics.links.1]\nmass = 40\ncentre = "S2"\n',
        ["dynamics.links.1.centre: link 1 has no point 'S2'. S2 is a point of link 2; the points "
         "of link 1 are A, B."],
    ),
    "centre on the frame": (
        '[dynamics.links.2]\nmass = 40\ncentre = "A"\n',
        ["dynamics.links.2.centre: link 2 has no point 'A'. A is a point of link 1; the points of "
         "link 2 are B, C, S2."],
    ),
    "centre in the other case": (
        '[dynamics.links.2]\nmass = 40\ncentre = "s2"\n',
        ["dynamics.links.2.centre: link 2 has no point 's2'. Did you mean 'S2'?"],
    ),
    "centre unknown": (
        '[dynamics.links.2]\nmass = 40\ncentre = "S1"\n',
        ["dynamics.links.2.centre: link 2 has no point 'S1'. The points of link 2 are "
         "B, C, S2."],
    ),
    "centre in Cyrillic": (
        '[dynamics.links.2]\nmass = 40\ncentre = "С"\n',
        ["dynamics.links.2.centre: 'С' is the Cyrillic letter С (U+0421), expected the Latin "
         "letter 'C'. Type 'C' in the Latin layout."],
    ),
    "loads a table": (
        "[loads]\nF = 3\n",
        ["loads: expected tables [[loads]], got a table"],
    ),
    "empty load": (
        "[[loads]]\n",
        ["loads[0].link: missing. Name the link: 1, 2, 3.",
         'loads[0]: expected force or couple, got neither. For example: link = "5", at = "H", '
         "force = 6000, angle = -90."],
    ),
    "unknown load key": (
        F + "forse = 1\n" + A,
        ["loads[0].forse: unknown key. Did you mean 'force'?"],
    ),
    "unknown link": (
        '[[loads]]\nlink = "22"\nat = "B"\nforce = 1\n' + A,
        ["loads[0].link: unknown link '22'. Did you mean '2'?"],
    ),
    "link a number": (
        '[[loads]]\nlink = 2\nat = "B"\nforce = 1\n' + A,
        ['loads[0].link: expected the name of a link, got the integer 2. Write link = "2".'],
    ),
    "load on the frame": (
        '[[loads]]\nlink = "0"\nat = "A"\nforce = 1\n' + A,
        ["loads[0].link: 0 is the frame (стойка), which does not move. Moving links carry loads: "
         "1, 2, 3."],
    ),
    "at missing": (
        M + "force = 1\n" + A,
        ["loads[0].at: missing. Name the point of link 2 where it acts: B, C, S2."],
    ),
    "at on another link": (
        '[[loads]]\nlink = "3"\nat = "B"\nforce = 1\n' + A,
        ["loads[0].at: link 3 has no point 'B'. B is a point of links 1, 2; the points of link 3 "
         "are C."],
    ),
    "at not a point": (
        '[[loads]]\nlink = "3"\nat = "BC"\nforce = 1\n' + A,
        ["loads[0].at: expected the name of a point, got the string 'BC'. A point is a Latin "
         "letter, perhaps with digits or primes: B, O3, S2, C'."],
    ),
    "force and couple": (
        F + "force = 1\ncouple = 2\n" + A,
        ["loads[0].couple: force and couple are both given. Write them as two [[loads]]."],
    ),
    "no direction": (
        F + "force = 1\n",
        ['loads[0]: expected a direction, got neither angle nor against. Give angle = -90 '
         '(degrees from +x) or against = "velocity".'],
    ),
    "angle and against": (
        F + 'force = 1\nagainst = "velocity"\n' + A,
        ["loads[0].against: angle and against are both given. A force has one direction: keep one "
         "of them."],
    ),
    "against what": (
        F + 'force = 1\nagainst = "speed"\n',
        ["loads[0].against: expected 'velocity' or 'rotation', got the string 'speed'"],
    ),
    "force against rotation": (
        F + 'force = 1\nagainst = "rotation"\n',
        ["loads[0].against: expected 'velocity', got 'rotation'. A force acts against the "
         "velocity of its point."],
    ),
    "couple against velocity": (
        M + 'couple = 1\nagainst = "velocity"\n',
        ["loads[0].against: expected 'rotation', got 'velocity'. A couple acts against the "
         "rotation of its link."],
    ),
    "against the velocity of a fixed point": (
        '[[loads]]\nlink = "1"\nat = "A"\nforce = 1\nagainst = "velocity"\n',
        ["loads[0].against: point A is fixed and has no velocity. Give the direction as an angle."],
    ),
    "couple with a point and an angle": (
        F + "couple = 1\n" + A,
        ["loads[0].at: not valid for a couple. A couple acts on the whole link.",
         "loads[0].angle: not valid for a couple. A couple is counter-clockwise when positive."],
    ),
    "force infinite": (
        F + "force = inf\n" + A,
        ["loads[0].force: expected a force in N, got inf. The number must be finite."],
    ),
    "couple huge": (
        M + "couple = 1e15\n",
        ["loads[0].couple: expected a couple in N·m from -1e+12 to 1e+12, got 1e+15. Check the "
         "unit: the file is in SI units and degrees."],
    ),
    "force a list": (
        F + "force = [1, 2]\n" + A,
        ["loads[0].force: expected a force in N or a table, got a list of 2. A table: "
         '{ over = "phi", values = [[0, 0], [90, 730]], interpolation = "linear" }.'],
    ),
    "angle nan": (
        F + "force = 1\nangle = nan\n",
        ["loads[0].angle: expected an angle in degrees, got nan. The number must be finite."],
    ),
    "name": (
        F + 'name = "F_{5"\nforce = 1\n' + A,
        ["loads[0].name: expected a letter with its indices, got the string 'F_{5'. For example: "
         "F_{5}, P, M_{1}^{c}."],
    ),
    "name twice": (
        (F + 'name = "P"\nforce = 1\n' + A) * 2,
        ["loads[1].name: loads[0] is also named P. Give it another letter."],
    ),
    "empty table": (
        F + "force = {}\n" + A,
        ["loads[0].force.over: missing. Give the variable of the table: "
         "phi, s, x, y, position, path.",
         'loads[0].force.values: missing. For example: { over = "phi", values = [[0, 0], '
         '[90, 730]], interpolation = "linear" }.',
         'loads[0].force.interpolation: missing. Select the interpolation between '
         'the rows: interpolation = "linear" or "step".'],
    ),
    "over what": (
        F + 'force = { over = "hpi", values = [[0, 0], [1, 1]], interpolation = "linear" }\n' + A,
        ["loads[0].force.over: expected 'phi', 's', 'x', 'y', 'position' or 'path', "
         "got the string 'hpi'. "
         "Did you mean 'phi'?"],
    ),
    "interpolation": (
        F + 'force = { over = "x", values = [[0, 0], [1, 1]], interpolation = "lineer" }\n' + A,
        ["loads[0].force.interpolation: expected 'linear' or 'step', got the string 'lineer'. "
         "Did you mean 'linear'?"],
    ),
    "over x in Cyrillic": (
        F + 'force = { over = "х", values = [[0, 0], [1, 1]], interpolation = "step" }\n' + A,
        ["loads[0].force.over: 'х' is the Cyrillic letter х (U+0445), expected the Latin letter "
         "'x'. Type 'x' in the Latin layout."],
    ),
    "over s of a crank": (
        F + 'force = { over = "s", values = [[0, 0], [1, 1]], interpolation = "linear" }\n' + A,
        ["loads[0].force.over: 's' does not apply to the driver: link 1 turns. Give the table over "
         "phi."],
    ),
    "couple over x": (
        M + 'couple = { over = "x", values = [[0, 0], [1, 1]], interpolation = "linear" }\n',
        ["loads[0].couple.over: 'x' is not valid for a couple. A couple has no point: give a "
         "table over phi, s or position."],
    ),
    "not increasing": (
        F + 'force = { over = "x", values = [[0, 0], [2, 1], [1, 3]], interpolation = "step" }\n'
        + A,
        ["loads[0].force.values[2]: x = 1 after 2. Put the rows in order."],
    ),
    "abscissa twice": (
        F + 'force = { over = "phi", values = [[0, 0], [90, 1], [90, 3]], interpolation = '
        '"step" }\n' + A,
        ["loads[0].force.values[2]: phi = 90 is in two rows. Keep one of them."],
    ),
    "over a turn": (
        F + 'force = { over = "phi", values = [[0, 0], [370, 1]], interpolation = "step" }\n' + A,
        ["loads[0].force.values: the rows span 370 degrees, a turn has 360. The table repeats "
         "with every turn."],
    ),
    "turn not closed": (
        F + 'force = { over = "phi", values = [[0, 0], [360, 1]], interpolation = "linear" }\n' + A,
        ["loads[0].force.values: 0 at 0 degrees and 1 a turn later. The table repeats with every "
         "turn: its ends are one position."],
    ),
    "one row": (
        F + 'force = { over = "phi", values = [[0, 5]], interpolation = "linear" }\n' + A,
        ["loads[0].force.values: expected at least two rows [phi, value], got 1. For example: "
         '{ over = "phi", values = [[0, 0], [90, 730]], interpolation = "linear" }. A constant '
         "load is just a number."],
    ),
    "odd rows": (
        F + 'force = { over = "y", values = [[0, "5"], [1], [nan, 2]], interpolation = "step" }\n'
        + A,
        ["loads[0].force.values[0][1]: expected a force in N, got the string '5'. Write 5 without "
         "quotes.",
         "loads[0].force.values[1]: expected [y, value], got a list of 1",
         "loads[0].force.values[2][0]: expected a distance in metres, got nan. The number must be "
         "finite."],
    ),
    "values for other positions": (
        F + 'force = { over = "position", values = [1, 2, 3] }\n' + A,
        ["loads[0].force.values: 3 values for 4 positions. Give one for each position of the "
         "driver, or a table over its motion."],
    ),
    "positions have no interpolation": (
        F + 'force = { over = "position", values = [1, 2, 3, 4], interpolation = "step" }\n' + A,
        ['loads[0].force.interpolation: not valid with over = "position". There is a value for '
         "each position."],
    ),
    "phases empty": (
        F + "force = 1\nphases = {}\n" + A,
        ["loads[0].phases: expected phi, moving or turning, got an empty table. For example: "
         'phases = { phi = [90, 270] } or phases = { moving = "down" }.'],
    ),
    "phases a list": (
        F + "force = 1\nphases = [90, 270]\n" + A,
        ["loads[0].phases: expected a table, got a list of 2. For example: phases = { phi = "
         '[90, 270] } or phases = { moving = "down" }.'],
    ),
    "phase of nothing": (
        F + "force = 1\nphases = { phi = [90, 90] }\n" + A,
        ["loads[0].phases.phi: expected a phase within one turn, got 90 to 90. A load without "
         "phases always acts."],
    ),
    "phase of one number": (
        F + "force = 1\nphases = { phi = [[90, 180], 200] }\n" + A,
        ["loads[0].phases.phi[1]: expected [from, to] in degrees, got the integer 200"],
    ),
    "moving where": (
        F + 'force = 1\nphases = { moving = "dwn" }\n' + A,
        ["loads[0].phases.moving: expected 'up', 'down', 'left' or 'right', got the string 'dwn'. "
         "Did you mean 'down'?"],
    ),
    "moving of a couple": (
        M + 'couple = 1\nphases = { moving = "up" }\n',
        ["loads[0].phases.moving: not valid for a couple. A couple has no point; it may have "
         'turning = "ccw" or "cw".'],
    ),
    "moving of a fixed point": (
        '[[loads]]\nlink = "1"\nat = "A"\nforce = 1\nphases = { moving = "up" }\n' + A,
        ["loads[0].phases.moving: point A is fixed and does not move"],
    ),
    "too many": (
        M * 201,
        ["loads: 201 loads, the limit is 200"],
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", FAULTS)
def test_faults(name: str) -> None:
    text, wanted = FAULTS[name]
    if text.startswith("dynamics ="):
        with pytest.raises(ProblemError) as caught:
            loads(text + CRANK, name="v")
        assert [str(fault) for fault in caught.value.faults] == wanted
    else:
        assert messages(text) == wanted


def test_faults_of_a_file_with_a_driving_slider() -> None:
    size = '{ over = "phi", values = [[0, 1], [1, 2]], interpolation = "linear" }'
    text = f'[[loads]]\nlink = "1"\ncouple = {size}\nphases = {{ phi = [0, 90] }}\n'
    assert messages(text, SLIDER) == [
        "loads[0].couple.over: 'phi' does not apply to the driver: link 3 slides. "
        "Give the table over s.",
        "loads[0].phases.phi: link 3 slides, it has no phi. "
        "Give the direction in which the point moves: "
        'phases = { moving = "down" }.',
    ]


def test_too_many_rows() -> None:
    rows = ",\n".join(f"[{n}e-5, 1]" for n in range(10_001))
    text = F + f'angle = 0\n[loads.force]\nover = "phi"\ninterpolation = "step"\nvalues = [{rows}]'
    assert messages(text) == ["loads[0].force.values: 10001 values, the limit is 10000"]


def test_all_faults_come_at_once() -> None:
    text = (
        '[dynamics.links.2]\nmass = -1\ncentre = "X"\n' + F + "force = nan\n" + M + "couple = 'a'"
    )
    broken = CRANK.replace("omega = 10", "omga = 10")
    assert [line.split(":")[0] for line in messages(text, broken)] == [
        "driver.omga",
        "dynamics.links.2.mass",
        "dynamics.links.2.centre",
        "loads[0]",
        "loads[0].force",
        "loads[1].couple",
    ]


def test_a_link_that_cannot_be_read_raises_no_more_faults() -> None:
    broken = CRANK.replace('points = ["B", "C", "S2"]', 'points = ["B", "C", 2]')
    text = '[dynamics.links.2]\nmass = 1\ncentre = "S2"\n' + F + "force = 1\nangle = 0\n"
    assert [line.split(":")[0] for line in messages(text, broken)] == ["links.2.points[2]"]


def schema_faults(text: str) -> list[Any]:
    jsonschema = pytest.importorskip("jsonschema")
    path = Path(__file__).parents[2] / "planmethod" / "problem" / "schema.json"
    schema = jsonschema.Draft202012Validator(json.loads(path.read_text(encoding="utf-8")))
    return list(schema.iter_errors(tomllib.loads(CRANK + text)))


def test_the_schema_accepts_all_that_the_reader_accepts() -> None:
    assert schema_faults(LOADED.replace("[variants]", "")) == []
    couple = '[[loads]]\nlink = "1"\ncouple = { over = "position", values = [1, 2, 3, 4] }\n'
    rest = 'against = "rotation"\nphases = { phi = [[300, 30]], turning = "cw" }\n'
    assert schema_faults(couple + rest + "[dynamics]\ngravity = false\n") == []


SEEN = [
    "unknown key",
    "gravity true",
    "gravity negative",
    "resultant a number",
    "resultant in quotes",
    "mass of the frame",
    "mass negative",
    "mass in quotes",
    "inertia negative",
    "centre misspelt",
    "loads a table",
    "empty load",
    "unknown load key",
    "load on the frame",
    "at missing",
    "force and couple",
    "no direction",
    "angle and against",
    "force against rotation",
    "couple against velocity",
    "couple with a point and an angle",
    "force a list",
    "empty table",
    "over what",
    "interpolation",
    "one row",
    "odd rows",
    "positions have no interpolation",
    "phases empty",
    "moving where",
    "too many",
]


@pytest.mark.parametrize("name", SEEN)
def test_the_schema_finds_all_faults_that_it_can(name: str) -> None:
    assert schema_faults(FAULTS[name][0])
