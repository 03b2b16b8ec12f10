"""The statements of docs/reference/problem-file.md on the grammar of a problem file."""

from __future__ import annotations

import re
import tomllib

import pytest
from cases import each
from doors import (
    ProblemError,
    parse_quantity,
    problem_loads as loads,
    reader_loads as moving_loads,
)
from mechanisms import CRANK, LOADED
from worked import ROOT

PAGE = (ROOT / "docs" / "reference" / "problem-file.md").read_text("utf-8")
FOURBAR = """
[frame]
A = [0, 0]
K = [0.3, 0]
[links.1]
points = ["A", "B"]
AB = 0.1
[links.3]
points = ["K", "C"]
KC = 0.2
[driver]
link = "1"
phi = 60
omega = 10
"""
FUNCTIONS = re.findall(
    r"[a-z]+",
    " ".join(re.findall(r"`(cos tg [^`]*|tan [^`]*)`", PAGE)) + " sin",
)


def part(title: str) -> str:
    (text,) = re.findall(rf"(?ms)^## {title}\n(.*?)(?=^## |\Z)", PAGE)
    assert isinstance(text, str)
    return text


def fragment(title: str) -> list[str]:
    """Return the lines of a block that is a part of a file, without comments."""
    (text,) = re.findall(rf'(?ms)^```toml title="{title}"\n(.*?)^```$', PAGE)
    lines = [re.sub(r" +#.*", "", line) for line in text.splitlines()]
    return [line for line in lines if line]


def test_third_points_of_the_page_are_read() -> None:
    *sides, along, across, vertex, angle = fragment("link")
    base = 'points = ["C", "B", "D"]\nCB = 0.2\n'
    for form in ("\n".join(sides), along, across, vertex):
        found = loads(f"{FOURBAR}[links.2]\n{base}{form}\n", name="page").bodies["2"]
        assert "D" in found.points, form
    crank = FOURBAR.replace("A", "O").replace("B", "A")  # its pivot is O, its pin A
    link = 'points = ["A", "C", "O1", "D"]\nOA = 0.2\n'.replace("OA", "O1A")
    text = f"{crank}[links.2]\n{link}O1D = 0.1\nO1C = 0.3\nangle.AO1C = 40\n"
    placed = loads(text + angle.replace("O", "O1"), name="page").bodies["2"].points
    turn = (placed["D"] - placed["O1"]) / (placed["A"] - placed["O1"])
    assert turn == pytest.approx(complex(-0.25, 3**0.5 / 4))


def test_positions_of_the_page_are_read() -> None:
    counts = []
    for line in fragment("driver"):
        text = CRANK.replace("phi = { from = 0, count = 4 }", line)
        counts.append(len(loads(text, name="page").drive.positions))
    assert counts == [3, 12, 7]


def test_rules_of_the_page_are_read() -> None:
    """The words of a rule, with the point names of another mechanism."""
    rules = tomllib.loads("\n".join(fragment("assembly")))["assembly"]
    assert [*rules] == ["B", "E", "S4", "C", "F", "H"]
    words = [rules["B"].replace("AC", "AB"), rules["E"], "left of D", "above D", "below D"]
    words += [rules["S4"], "away from E", rules["H"]["rule"]]
    for phrase in words:
        known = re.sub(r"\b[DEG]\b", "B", phrase)
        rule = CRANK.replace('"right of B"', f'"{known}"').replace("count = 4", "count = 12")
        try:
            loads(rule, name="page")
        except ProblemError as error:  # read, and judged by the mechanism
            assert "expected" not in str(error), (phrase, str(error))


def test_variants_of_the_page_are_read() -> None:
    text = 'answers = [{ what = "v C" }]\n' + CRANK + LOADED + "\n".join(fragment("variants"))
    assert loads(text, name="page", variant="Б").drive.positions == (120,)


@each(
    "text", re.findall(r'`("[^`"]+")`', part("Numbers, expressions and units").split("`units")[0])
)
def test_numbers_of_the_page_are_read(text: str) -> None:
    key = {'"20 рад/с"': "omega", '"20*pi"': "omega", '"2,5 кН"': "force"}.get(text, "AB")
    if key == "force":
        loads(CRANK + f'[[loads]]\nlink = "2"\nat = "C"\nangle = 0\nforce = {text}\n', name="page")
    elif key == "omega":
        loads(CRANK.replace("omega = 10", f"omega = {text}"), name="page")
    else:
        scheme = CRANK.replace("AB = 0.1", f"AB = {text}").replace("BC = 0.3", "BC = 3")
        assert loads(scheme, name="page").lengths


@each("name", FUNCTIONS)
def test_functions_of_the_page_are_known(name: str) -> None:
    text = f'title = "p"\n[point]\nx = "{name}(t)"\ny = "t**2 + e^t"\nt = 0.5\n'
    assert moving_loads(text, name="page") is not None


@each("text", re.findall(r"(?m)^- (`.*?`): ", part("Selectors")))
def test_selectors_of_the_page_are_read(text: str) -> None:
    """In the rows of `machine` and `diagram` that word precedes each name, as the page says."""
    names = re.findall(r"`([^`]+)`", text)
    head = names[0].partition(" ")[0]
    for one in names:
        whole = one.startswith(head) or head not in ("machine", "diagram")
        assert parse_quantity(one if whole else f"{head} {one}"), one
