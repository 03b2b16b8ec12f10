"""Layers and colours of the plans (слои и цвета)."""

# Cyrillic letters: names of layers and colours, as drawings of students have them

from __future__ import annotations

from collections.abc import Iterable, Mapping

from planmethod.check.submissions.faults import SubmissionError
from planmethod.plans.model import PlanKind
from planmethod.problem.names import fold
from planmethod.render.backends.layers import FIGURES, VECTORS

PLANS = "plans"
"""Value for a layer with both plans; the letter of the pole distinguishes them."""

COLOURS = {
    "red": 1, "yellow": 2, "green": 3, "cyan": 4, "blue": 5, "magenta": 6, "white": 7,
    "красный": 1, "жёлтый": 2, "зелёный": 3, "голубой": 4, "синий": 5, "пурпурный": 6, "белый": 7,
}  # fmt: skip
"""Numbers of colours in AutoCAD's index by their names; ``color 30`` names any."""

_WORDS = {
    PlanKind.VELOCITY.value: (
        "velocity", "velocities", "velocity plan", "скорость", "скорости", "план скоростей",
    ),
    PlanKind.ACCELERATION.value: (
        "acceleration", "accelerations", "acceleration plan",
        "ускорение", "ускорения", "план ускорений",
    ),
    PLANS: ("plans", "планы", VECTORS, FIGURES),
}  # fmt: skip
"""Names of layers that are recognised by default."""


def _key(text: str) -> str:
    return fold(" ".join(text.replace("_", " ").replace("-", " ").casefold().split()))


_OF_NAME = {_key(word): plan for plan, words in _WORDS.items() for word in words}


_OF_COLOUR = {_key(word): number for word, number in COLOURS.items()}
_COLOUR = tuple(map(_key, ("color", "colour", "цвет")))


def read_layers(options: Iterable[str]) -> dict[str, str]:
    """Return the plan of each layer and colour: ``PLAN_V=velocity``, ``red=velocity``.

    Raises
    ------
    WorksError
        Something is no such pair.
    """
    found: dict[str, str] = {}
    for one in options:
        name, equal, plan = one.partition("=")
        kind = _OF_NAME.get(_key(plan), "") if equal else ""
        if not name.strip() or not kind:
            raise SubmissionError(
                "--layer {}: write NAME=velocity, NAME=acceleration or NAME=plans.", one[:60]
            )
        found[_key(name)] = kind
    return found


def plan_of_layer(layers: Mapping[str, str], layer: str, colour: int) -> str:
    """Return which plan a line of a layer and colour belongs to; empty where it is of none."""
    if plan := layers.get(_key(layer)):
        return plan
    for name, plan in layers.items():
        word, _, number = name.rpartition(" ")
        numbered = word in _COLOUR and number == str(colour)
        if colour and (numbered or _OF_COLOUR.get(name) == colour):
            return plan
    return "" if layers else _OF_NAME.get(_key(layer), "")
