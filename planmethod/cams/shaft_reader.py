"""Read a file with ``[[cams]]``: several cams on one shaft (чтение кулачкового вала)."""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import partial
from math import pi, radians
from pathlib import Path

from planmethod.cams.model import CamProblem
from planmethod.cams.reader import PLACED, SIZE_NAMES, TOP as TOP_OF_CAM, read_cam
from planmethod.cams.shaft import Camshaft
from planmethod.errors import ProblemError
from planmethod.languages import translate
from planmethod.problem import keys
from planmethod.problem.answers import ComputedAnswerNames, read_answers
from planmethod.problem.file_node import FileNode, needed
from planmethod.problem.names import short
from planmethod.problem.reader import varied
from planmethod.problem.sheet import read_head

TOP = tuple("cams" if key == "cam" else key for key in TOP_OF_CAM)
"""Tables of the file that a camshaft may have."""

_EXAMPLE = '[[cams]] name = "A", phase = 0, follower = "translating", stroke = 0.02, rise = 90, …'
_NAME = re.compile(r"\w{1,12}\Z")


def load(path: str | Path, *, variant: str | None = None) -> Camshaft:
    """Read a file with ``[[cams]]``.

    Raises
    ------
    ProblemError
        With every fault of the file.
    """
    path = Path(path)
    file, variants = varied(path, variant)
    file.allow(TOP)
    head = read_head(file)
    cams = file["cams"].attempt(_read_cams) or ()
    count = max((cam.count for cam in cams), default=1)
    answers = read_answers(file, _scene([cam.name for cam in cams], count))
    if file.faults or not cams:
        raise ProblemError(str(path), file.faults.listed)
    return Camshaft(
        name=path.stem,
        source_file=str(path),
        variants=variants,
        variant=variant,
        answers=answers,
        cams=cams,
        **head,
    )


def _read_cams(node: FileNode) -> tuple[CamProblem, ...]:
    node.tables(keys.CAM_LIMIT, "{} cams, the limit is {}")
    if not node.value:
        node.reject("the shaft has no cam", hint=_EXAMPLE)
    names, speeds = list[str](), list[tuple[str, float]]()
    for entry in node.entries():
        name = entry.require("name", partial(_read_name, earlier_names=tuple(names)), _EXAMPLE)
        names.append(name or "")
        speed = entry.read("n", lambda n: n.number("a rotational speed in rev/min"))
        if speed is None:
            continue
        if speeds and speed != speeds[0][1]:
            message = "cam {} makes {:g} rev/min, and cam {} on the same shaft {:g}"
            hint = "Give the speed of the shaft once."
            entry["n"].note(message, name or "", speed, *speeds[0], hint=hint)
        speeds.append((name or "", speed))
    common = speeds[0][1] if speeds else None
    found = [
        entry.attempt(partial(_read_one, name=name, speed=common))
        for entry, name in zip(node.entries(), names, strict=True)
    ]
    node.require_sound()
    return tuple(map(needed, found))


def _read_one(node: FileNode, name: str, speed: float | None) -> CamProblem:
    phase = node.read("phase", FileNode.angle, 0.0)
    own = {key: value for key, value in node.value.items() if key not in ("name", "phase")}
    found = read_cam(node.with_value(own), speed)
    turned = radians(needed(phase)) % (2 * pi)
    return CamProblem(name=name, **found, phase=turned)


def _read_name(node: FileNode, earlier_names: Sequence[str]) -> str:
    name = str(node.value)
    if _NAME.match(name) is None:
        node.reject_value("a name of 1 to 12 letters and digits", 'For example: name = "A"')
    if name in earlier_names:
        node.reject("another cam is named {}", name, hint="Give each cam its own name.")
    return name


def named_quantity(name: str, cams: Sequence[str]) -> tuple[str, str] | None:
    """Return the quantity and the cam of a name in ``[[answers]]``: ``s_A``; None of another."""
    for cam in sorted(cams, key=len, reverse=True):
        quantity = name.removesuffix(f"_{cam}")
        if quantity != name and quantity in (*SIZE_NAMES, *PLACED):
            return quantity, cam
    return None


def _scene(cams: Sequence[str], count: int) -> ComputedAnswerNames:
    def fault(name: str) -> str:
        if not cams or named_quantity(name, cams) is not None:
            return ""
        return translate("the camshaft has no '{}'", short(name))

    known = [f"{quantity}_{cam}" for quantity in ("s", "r_min") for cam in cams]
    hint = translate("Known here: {}.", ", ".join(known))
    return ComputedAnswerNames(fault, lambda name: False, hint, count)
