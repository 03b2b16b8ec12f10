"""Expressions and project files of Pyslvs: ``M[J[R, P[0.0, 0.0], L[ground, L1]], ...]``.

A project is YAML that has the expression and the inputs, pairs of joints. Source: the grammar of
``pyslvs/expression_parser.py`` and ``pyslvs_ui/io/format_editor.py`` of github.com/KmolYuan/pyslvs.
"""

from __future__ import annotations

import re

from planmethod.languages import translate
from planmethod.peers.foreign import (
    MEMBER_LIMIT,
    ForeignBody,
    ForeignDriver,
    ForeignMechanism,
    ForeignSlide,
    finite,
    reject,
)

GROUND = "ground"
_NUMBER = r"([-+]?[\d.]+(?:[eE][-+]?\d+)?)"
_JOINT = (  # without white space
    r"J\[(RP|R|P),"
    rf"(?:A\[{_NUMBER}\],)?"
    r"(?:color\[[^\]]{0,60}\],)?"
    rf"P\[{_NUMBER},{_NUMBER}\],"
    r"L\[([\w,]{0,400})\]\],?"
)
_SECTIONS = {"mechanism", "input", "links", "pyslvs_ver", "file_type"}
"""Sections of a project that are read, or only change how it looks."""


def is_pyslvs(text: str) -> bool:
    """Return whether a text has an expression of Pyslvs."""
    return re.search(r"(?<![\w\]])M\[", text[:200_000]) is not None and "J[" in text


def read_pyslvs(text: str, source: str) -> ForeignMechanism:
    """Read an expression or a YAML project of Pyslvs; lengths are in millimetres.

    Raises
    ------
    ProblemError
        The expression is damaged, or has a driver that planmethod lacks.
    """
    return _Expression(text, source).read()


class _Expression:
    def __init__(self, text: str, source: str) -> None:
        self.text, self.source = text, source
        self.remarks: list[str] = []
        self.places: dict[str, complex] = {}
        self.fixed: set[str] = set()
        self.rigid_bodies: dict[str, list[str]] = {}
        self.slides: list[ForeignSlide] = []

    def read(self) -> ForeignMechanism:
        """Read the joints and the input."""
        match = re.search(r"(?<![\w\]])M\[", self.text)
        if match is None:
            reject(self.source, "the file has no expression M[...]")
        joints, at = "".join(self.text[match.end() :].split()), 0
        while (joint := re.compile(_JOINT).match(joints, at)) is not None:
            self._joint(*joint.groups())
            at = joint.end()
            if len(self.places) > MEMBER_LIMIT:
                reject(self.source, "more than {} points or links", MEMBER_LIMIT)
        if not joints.startswith("]", at):
            rest = joints[at : at + 60]
            reject(self.source, "the expression is not read from here: {}", rest)
        for section in re.findall(r"(?m)^(\w+):", self.text):
            if section not in _SECTIONS:
                self.remarks.append(translate("the section {} is not read", section))
        return ForeignMechanism(
            program="Pyslvs",
            title="Pyslvs",
            unit="mm",
            points=self.places,
            fixed=frozenset(self.fixed),
            rigid_bodies=tuple(ForeignBody(k, tuple(own)) for k, own in self.rigid_bodies.items()),
            slides=tuple(self.slides),
            driver=self._driver(),
            remarks=tuple(self.remarks),
        )

    def _joint(self, kind: str, angle: str | None, x: str, y: str, links: str) -> None:
        name = f"Point{len(self.places)}"
        self.places[name] = complex(*(finite(self.source, one, name) for one in (x, y)))
        names = [one for one in links.split(",") if one]
        if not names:
            self.remarks.append(translate("{} is on no link and is not read", name))
            return
        if kind == "R":
            self._add(name, names)
            return
        turned = finite(self.source, angle or "0", f"A of {name}")
        slot, *others = names
        if not others:
            reject(self.source, "slider {} has no second link", name)
        host = "" if slot == GROUND else slot
        if host:
            self.rigid_bodies.setdefault(slot, [])
        if kind == "RP":
            self._add(name, others)
            self.slides.append(ForeignSlide(name, host=host, angle=turned))
            return
        if len(others) > 1 or (others == [GROUND] and not host):
            reject(self.source, "slider {} of the type P joins more than two links", name)
        if others == [GROUND]:  # the link with the slot moves along the frame
            self._add(name, [slot])
            self.slides.append(ForeignSlide(name, body=slot, angle=turned))
            return
        self._add(name, others)
        self.slides.append(ForeignSlide(name, body=others[0], host=host, angle=turned))

    def _add(self, name: str, links: list[str]) -> None:
        for link in links:
            if link == GROUND:
                self.fixed.add(name)
            else:
                self.rigid_bodies.setdefault(link, []).append(name)

    def _driver(self) -> ForeignDriver:
        inputs = self._inputs()
        if len(inputs) > 1:
            reject(self.source, "{} inputs: planmethod needs one", len(inputs))
        if not inputs:
            base = next((p for p in self.places if p in self.fixed), "")
            driven = [k for k, own in self.rigid_bodies.items() if base in own]
            if base and driven:
                message = "the file has no input: link {} about {} is driven"
                self.remarks.append(translate(message, driven[0], base))
                return ForeignDriver(driven[0])
            return ForeignDriver()
        one, two = (f"Point{k}" for k in inputs[0])
        if one == two:
            return ForeignDriver(pin=one)
        driven = [k for k, own in self.rigid_bodies.items() if one in own and two in own]
        if not driven or one not in self.fixed:
            reject(
                self.source, "input {}, {} does not turn a link about the frame", one, two,
                hint="Its first joint must be on ground and on the driven link.",
            )  # fmt: skip
        return ForeignDriver(driven[0])

    def _inputs(self) -> list[tuple[int, int]]:
        """Return the inputs of a project: pairs of numbers of joints, in both styles of YAML."""
        start = re.search(r"(?m)(?:^|[{,]\s*)[\"']?input[\"']?:", self.text)
        if start is None:
            return []
        rest = self.text[start.end() : start.end() + 2000]
        listed = re.match(r"[\s\d\[\],-]*", rest)  # up to the next key
        numbers = [int(one) for one in re.findall(r"\d{1,6}", listed[0] if listed else "")]
        return list(zip(numbers[::2], numbers[1::2], strict=False))
