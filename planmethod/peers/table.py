"""Problem file of a mechanism of another program: names, links, guides, driver (файл задачи)."""

from __future__ import annotations

from collections.abc import Iterator
from string import ascii_uppercase
from typing import Any

from msgspec.structs import replace

from planmethod.languages import translate
from planmethod.mechanism.model import FRAME
from planmethod.peers.foreign import (
    MEMBER_LIMIT,
    ForeignBody,
    ForeignMechanism,
    ForeignSlide,
    reject,
)
from planmethod.problem.names import is_point_name
from planmethod.problem.placement import heading, rotation


def problem_table(mechanism: ForeignMechanism, source: str) -> tuple[dict[str, Any], list[str]]:
    """Return the table of a problem file, and remarks on what it lacks.

    Raises
    ------
    ProblemError
        The file has no mechanism with one driver.
    """
    if max(len(mechanism.points), len(mechanism.rigid_bodies)) > MEMBER_LIMIT:
        reject(source, "more than {} points or links", MEMBER_LIMIT)
    return _Table(mechanism, source).build()


class _Table:
    def __init__(self, mechanism: ForeignMechanism, source: str) -> None:
        self.mechanism, self.source, self.remarks = mechanism, source, [*mechanism.remarks]
        self.rigid_bodies = self._moving_bodies()
        self.slides = [one for one in mechanism.slides if self._is_joined(one)]
        self._give_lines_points()
        self.names = self._point_names()
        self.numbers = self._link_numbers()

    def build(self) -> tuple[dict[str, Any], list[str]]:
        """Return the table and the remarks."""
        mechanism, names = self.mechanism, self.names
        frame: dict[str, Any] = {
            names[p]: [mechanism.points[p].real, mechanism.points[p].imag]
            for p in mechanism.fixed
            if p in names
        }
        frame = dict(sorted(frame.items()))
        links = self._links(frame)
        table: dict[str, Any] = {"title": mechanism.title or mechanism.program}
        if mechanism.unit != "m":
            table["units"] = mechanism.unit
        table |= {"frame": frame, "links": links, "driver": self._driver()}
        shown = {names[p]: [z.real, z.imag] for p, z in mechanism.points.items() if p in names}
        table["drawn"] = {"points": {p: z for p, z in shown.items() if p not in frame}}
        if not table["drawn"]["points"]:
            reject(self.source, "no moving points")
        renamed = [f"{p} → {name}" for p, name in names.items() if p != name]
        if renamed:
            self.remarks.append(translate("points have other names: {}", ", ".join(renamed)))
        return table, self.remarks

    # Bodies ------------------------------------------------------------------------------------

    def _moving_bodies(self) -> list[ForeignBody]:
        """Return the rigid bodies that move, without parts of the frame and loose ones."""
        mechanism = self.mechanism
        kept = []
        for body in mechanism.rigid_bodies:
            points = tuple(dict.fromkeys(p for p in body.points if p in mechanism.points))
            if len([p for p in points if p in mechanism.fixed]) > 1:
                if set(points) - mechanism.fixed:
                    message = "link {} has two fixed points and is not read"
                    self.remarks.append(translate(message, body.name))
                continue
            if points:
                kept.append(ForeignBody(body.name, points))
        reached, grown = set(mechanism.fixed), True
        joined: set[str] = set()
        while grown:
            grown = False
            for body in kept:
                slid = any(
                    s.body == body.name or s.host == body.name or s.pin in body.points
                    for s in mechanism.slides
                )
                if body.name not in joined and (reached & {*body.points} or slid):
                    joined.add(body.name)
                    reached.update(body.points)
                    grown = True
        for body in kept:
            if body.name not in joined:
                self.remarks.append(
                    translate("link {} is joined to nothing and is not read", body.name)
                )
        sliding = {one.body for one in mechanism.slides} | {one.host for one in mechanism.slides}
        return [b for b in kept if b.name in joined and (len(b.points) > 1 or b.name in sliding)]

    def _is_joined(self, slide: ForeignSlide) -> bool:
        known = {body.name for body in self.rigid_bodies}
        on = {p for body in self.rigid_bodies for p in body.points} | self.mechanism.fixed
        if slide.pin in on and all(one in known for one in (slide.body, slide.host) if one):
            return True
        message = "the slide at {} is joined to nothing and is not read"
        self.remarks.append(translate(message, slide.pin))
        return False

    def _give_lines_points(self) -> None:
        """Give a second point to each link that has one point and a line for a slide."""
        for slide in self.slides:
            host = next((one for one in self.rigid_bodies if one.name == slide.host), None)
            if host is None or slide.guide_points or len(host.points) > 1:
                continue
            (start,) = host.points
            at, pin = self.mechanism.points[start], self.mechanism.points[slide.pin]
            end = f"{host.name}.line"
            reach = abs(pin - at) or 1.0
            places = {**self.mechanism.points, end: at + reach * rotation(slide.angle)}
            self.mechanism = replace(self.mechanism, points=places)
            grown = ForeignBody(host.name, (start, end))
            self.rigid_bodies = [grown if one is host else one for one in self.rigid_bodies]
            message = "link {} gets a second point, for the direction of its slide"
            self.remarks.append(translate(message, host.name))

    def _point_names(self) -> dict[str, str]:
        """Return a letter for each point; those that may be kept are."""
        used = dict.fromkeys(p for body in self.rigid_bodies for p in body.points)
        for slide in self.slides:
            used |= dict.fromkeys((slide.pin, *slide.guide_points))
        names = {p: p for p in used if is_point_name(p) and p.isascii()}
        free = _letters({*names.values()})
        return {p: names.get(p) or next(free) for p in used if p in self.mechanism.points}

    def _link_numbers(self) -> dict[str, str]:
        """Return the numbers of links and blocks, that of the driver first."""
        order = [body.name for body in self.rigid_bodies]
        order += [_block(slide) for slide in self.slides if not slide.body]
        driver = self.mechanism.driver
        first = driver.body
        for slide in self.slides:
            if driver.pin and slide.pin == driver.pin:
                first = slide.body or _block(slide)
        if first not in order:
            reject(
                self.source, "no link is driven",
                hint="Make one joint the input in the other program, and save again.",
            )  # fmt: skip
        order.sort(key=lambda name: name != first)
        return {name: str(k) for k, name in enumerate(order, 1)}

    # Links -------------------------------------------------------------------------------------

    def _links(self, frame: dict[str, Any]) -> dict[str, Any]:
        names = self.names
        made: dict[str, Any] = {}
        for body in self.rigid_bodies:
            points = sorted(body.points, key=lambda p: p not in self.mechanism.fixed)
            slide = next((one for one in self.slides if one.body == body.name), None)
            if slide is not None:
                points = [slide.pin, *(p for p in points if p != slide.pin)]
            link: dict[str, Any] = {"points": [names[p] for p in points]}
            if slide is not None:
                link["slides"] = self._line(slide, frame)
            made[self.numbers[body.name]] = link
        for slide in self.slides:
            if not slide.body:
                line = self._line(slide, frame)
                made[self.numbers[_block(slide)]] = {"points": [names[slide.pin]], "slides": line}
        return dict(sorted(made.items(), key=lambda item: int(item[0])))

    def _line(self, slide: ForeignSlide, frame: dict[str, Any]) -> dict[str, Any]:
        """Return the ``slides`` of a link."""
        names, mechanism = self.names, self.mechanism
        if slide.host:
            on = self.numbers[slide.host]
            if slide.guide_points:
                return {"on": on, "along": "".join(names[p] for p in slide.guide_points)}
            host = next(body for body in self.rigid_bodies if body.name == slide.host)
            points = sorted(host.points, key=lambda p: p not in mechanism.fixed)
            axis = heading(mechanism.points[points[1]] - mechanism.points[points[0]])
            return {"on": on, "through": names[points[0]], "angle": slide.angle - axis}
        if slide.guide_points:
            return {"on": FRAME, "along": "".join(names[p] for p in slide.guide_points)}
        guides = frame.setdefault("guides", {})
        level = {0.0: "x-x", 90.0: "y-y"}.get(slide.angle % 180.0)
        guide = level if level and level not in guides else f"n{len(guides) + 1}"
        at = mechanism.points[slide.pin]
        guides[guide] = {"through": [at.real, at.imag], "angle": slide.angle}
        return {"on": guide}

    def _driver(self) -> dict[str, Any]:
        driver = self.mechanism.driver
        made: dict[str, Any] = {"link": "1"}
        if driver.pin:
            if not driver.v:
                self.remarks.append(translate("the file has no speed: v = 1 m/s is assumed"))
            return {**made, "v": driver.v or 1.0}
        omega = driver.omega
        if not omega:
            self.remarks.append(translate("the file has no speed: omega = 1 1/s is assumed"))
            omega = 1.0
        return {**made, "omega": omega}


def _block(slide: ForeignSlide) -> str:
    """Return the name of a sliding block that the other program does not name."""
    return f"\0{slide.pin}\0{slide.host}"


def _letters(used: set[str]) -> Iterator[str]:
    for number in ["", *map(str, range(1, 100))]:
        for letter in ascii_uppercase:
            if letter not in "IO" and f"{letter}{number}" not in used:
                yield f"{letter}{number}"
