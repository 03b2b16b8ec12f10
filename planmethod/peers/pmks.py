"""Share links of PMKS+, Planar Mechanism Kinematic Simulator (ссылки PMKS+).

A link has ``settings.joints..links..forces..selection``, and a check character at its end. Numbers
are thousandths, in base 64 with a leading 0 for minus. Source: ``src/app/services/transcoding`` of
github.com/PMKS-Web/PMKSWeb.
"""

from __future__ import annotations

import math
import re
from urllib.parse import unquote

from msgspec import Struct

from planmethod.languages import translate
from planmethod.peers.foreign import (
    ForeignBody,
    ForeignDriver,
    ForeignMechanism,
    ForeignSlide,
    reject,
)

DIGITS = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_-"
UNITS = {"0": "in", "1": "cm", "2": "m"}
METRES = {"in": 0.0254, "cm": 0.01, "m": 1.0}
_LINK = r"(?:[^?\n]{0,200}\?)?([\w-]{1,4}\.[\w,-]{1,40}\.[\w,-]{1,40}\.\d{1,8}\.[^?\n]+)"


class _Joint(Struct):
    name: str
    place: complex
    angle: float
    flags: int
    slot: tuple[str, ...]

    @property
    def is_slide(self) -> bool:
        return bool(self.flags & 1)

    @property
    def is_input(self) -> bool:
        return bool(self.flags & 2)

    @property
    def is_fixed(self) -> bool:
        return bool(self.flags & 4)

    @property
    def is_welded(self) -> bool:
        return bool(self.flags & 8)


def is_pmks(text: str) -> bool:
    """Return whether a text is a share link of PMKS+, or the part of it after the question mark."""
    match = re.fullmatch(_LINK, unquote(text.strip()))
    return match is not None


def read_pmks(text: str, source: str) -> ForeignMechanism:
    """Read a share link.

    Raises
    ------
    ProblemError
        It is cut off or damaged, or has a driver that planmethod lacks.
    """
    match = re.fullmatch(_LINK, unquote(text.strip()))
    if match is None:
        reject(source, "this is not a share link of PMKS+")
    return _Link(match[1], source).read()


class _Link:
    def __init__(self, code: str, source: str) -> None:
        self.code, self.source = code, source
        self.remarks: list[str] = []

    def read(self) -> ForeignMechanism:
        """Read the joints and links."""
        parts = self.code.split(".")
        settings, rest = parts[:4], parts[4:]
        if len(rest) < 3 or not rest[0]:
            reject(self.source, "the share link has no joints")
        joints, rest = self._until_empty(rest)
        links, rest = self._until_empty(rest)
        forces, _ = self._until_empty(rest)
        old = len(joints[0].split(",")) < 5
        if not old:
            self._check_end()
        self.joints: dict[str, _Joint] = {}
        for text in joints:
            joint = self._joint(text, old=old)
            if joint[0] in self.joints:
                reject(self.source, "joint {} is there twice", joint[0])
            self.joints[joint[0]] = joint[1]
        self.links = [one for text in links if (one := self._link(text, old=old)) is not None]
        if forces:
            message = "{} forces are not read: give them in [[loads]]"
            self.remarks.append(translate(message, len(forces)))
        return self._mechanism(settings)

    def _until_empty(self, parts: list[str]) -> tuple[list[str], list[str]]:
        end = parts.index("") if "" in parts else len(parts)
        return parts[:end], parts[end + 1 :]

    def _check_end(self) -> None:
        body, last = self.code[:-1], self.code[-1]
        expected = DIGITS[len(body) % 62]
        if last != expected:
            reject(
                self.source, "the share link is cut off or changed: it ends in {}, not in {}",
                last, expected, hint="Copy the whole link again.",
            )  # fmt: skip

    def _integer(self, text: str) -> int:
        minus = len(text) > 1 and text[0] == "0"
        number = 0
        if len(text) > 12:
            reject(self.source, "{!r} is not a number of a share link", text[:20])
        for digit in text[1:] if minus else text:
            place = DIGITS.find(digit)
            if place < 0:
                reject(self.source, "{!r} is not a number of a share link", text[:20])
            number = number * 64 + place
        return -number if minus else number

    def _number(self, text: str) -> float:
        return self._integer(text) / 1000

    def _joint(self, text: str, *, old: bool) -> tuple[str, _Joint]:
        head, *tokens = text.split(",")
        if not old and tokens:
            name, *tokens = tokens
        else:
            name = head[1:]
        if not head or len(tokens) not in (3, 6):
            reject(self.source, "joint {!r} is damaged", text[:40])
        x, y, angle = map(self._number, tokens[:3])
        flags = self._integer(head[0])
        return head[1:], _Joint(name, complex(x, y), angle, flags, tuple(tokens[3:]))

    def _link(self, text: str, *, old: bool) -> tuple[str, bool, tuple[str, ...]] | None:
        """Return the name of a link, whether it is a block, and its joints; None of a part."""
        head, *tokens = text.split(",")
        if not old:
            if head[:1] != "Y":
                return None  # a part of a welded link, which is there as a whole
            head = head[1:]
        kind, name = head[:1], head[1:]
        tokens = tokens[4:] if old else tokens[6:]
        if "" in tokens:
            tokens = tokens[: tokens.index("")]
        if kind not in ("R", "P") or not tokens or not {*tokens} <= {*self.joints}:
            reject(self.source, "link {!r} is damaged", text[:40])
        return name, kind == "P", tuple(tokens)

    def _mechanism(self, settings: list[str]) -> ForeignMechanism:
        unit = UNITS.get(settings[3][:1], "cm")
        rigid_bodies = self._rigid_bodies()
        slides: list[ForeignSlide] = []
        for name, is_block, joints in self.links:
            if is_block:
                slides += self._slide(name, joints, rigid_bodies)
        slotted = {j for j, one in self.joints.items() if one.is_slide}
        self.remarks.append(translate("masses and centres of mass are not read"))
        return ForeignMechanism(
            program="PMKS+",
            title="PMKS+",
            unit=unit,
            points={j: one.place for j, one in self.joints.items() if j not in slotted},
            fixed=frozenset(
                j for j, one in self.joints.items() if one.is_fixed and j not in slotted
            ),
            rigid_bodies=tuple(ForeignBody(name, points) for name, points in rigid_bodies.items()),
            slides=tuple(slides),
            driver=self._driver(settings, rigid_bodies, unit),
            remarks=tuple(self.remarks),
        )

    def _rigid_bodies(self) -> dict[str, tuple[str, ...]]:
        """Return the rigid bodies; those that are welded at a joint are one."""
        rigid_bodies: dict[str, tuple[str, ...]] = {}
        for name, is_block, joints in self.links:
            if is_block:
                continue
            points = tuple(j for j in joints if not self.joints[j].is_slide)
            welded = [
                other for other, own in rigid_bodies.items()
                if any(j in own and self.joints[j].is_welded for j in points)
            ]  # fmt: skip
            for other in welded:
                points = tuple(dict.fromkeys((*rigid_bodies.pop(other), *points)))
            rigid_bodies[name] = points
        return rigid_bodies

    def _slide(
        self, name: str, joints: tuple[str, ...], rigid_bodies: dict[str, tuple[str, ...]]
    ) -> list[ForeignSlide]:
        pins = [j for j in joints if not self.joints[j].is_slide]
        lines = [j for j in joints if self.joints[j].is_slide]
        if len(pins) != 1 or len(lines) != 1:
            reject(self.source, "block {} needs one pin and one slide", name)
        line, pin = self.joints[lines[0]], pins[0]
        body = ""
        if self.joints[pin].is_welded:
            body = next((one for one, points in rigid_bodies.items() if pin in points), "")
        if line.is_fixed or not line.slot:
            angle = round(math.degrees(line.angle), 1)  # thousandths of a radian are 0.06 degrees
            quarter = round(angle / 90.0) * 90.0
            angle = quarter if abs(angle - quarter) < 0.1 else math.degrees(line.angle)
            return [ForeignSlide(pin, body, angle=angle)]
        carrier, *slot = line.slot
        host = carrier if carrier in rigid_bodies else ""
        for one, points in rigid_bodies.items():
            if not host and {*slot} <= {*points}:
                host = one
        if not host or len(slot) != 2 or not {*slot} <= {*rigid_bodies[host]}:
            reject(self.source, "the slot of {} names link {}, which is not there", name, carrier)
        return [ForeignSlide(pin, body, host, tuple(slot))]

    def _driver(
        self, settings: list[str], rigid_bodies: dict[str, tuple[str, ...]], unit: str
    ) -> ForeignDriver:
        inputs = [j for j, one in self.joints.items() if one.is_input]
        if len(inputs) > 1:
            reject(self.source, "{} joints are inputs: planmethod needs one", len(inputs))
        if not inputs:
            return ForeignDriver()
        joint = self.joints[inputs[0]]
        clockwise = -1.0 if self._integer(settings[0]) & 1 else 1.0
        if not joint.is_slide:
            driven = [name for name, points in rigid_bodies.items() if inputs[0] in points]
            if not joint.is_fixed or len(driven) != 1:
                reject(
                    self.source, "input {} does not join one link to the frame", joint.name,
                    hint="Drive a link that turns about a fixed joint.",
                )  # fmt: skip
            rpm = self._integer(settings[2].split(",")[0])
            return ForeignDriver(driven[0], omega=clockwise * rpm * math.pi / 30.0)
        if joint.slot:
            hint = "Drive a crank or a slider on the frame; a cylinder is DE, v_DE in [driver]."
            reject(
                self.source, "input {} slides on a moving link: it is not read", joint.name,
                hint=hint,
            )  # fmt: skip
        decimals = settings[1].split(",")
        speed = self._number(decimals[1]) if len(decimals) > 1 else 1.0
        (pin,) = [
            j for _, block, joints in self.links if block and inputs[0] in joints
            for j in joints if not self.joints[j].is_slide
        ]  # fmt: skip
        return ForeignDriver(pin=pin, v=clockwise * speed * METRES[unit])
