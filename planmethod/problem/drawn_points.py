"""Coordinates of one drawn position, and the sizes that follow from them (координаты рисунка)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any, TypeAlias

from planmethod.languages import translate
from planmethod.problem import keys
from planmethod.problem.drawn_lines import DrawnLines, plain_name
from planmethod.problem.drive import is_place, is_posed
from planmethod.problem.figure_checks import LENGTH_TOLERANCE, SAME
from planmethod.problem.file_node import FileNode
from planmethod.problem.joints import DRAWN
from planmethod.problem.model import DrawnPoints, DrawnSize
from planmethod.problem.names import UNITS, format_length, is_point_name, split_pair
from planmethod.problem.placement import heading

FLAT = 0.02
"""Height of a third point above the line of two others, relative to their distance, below which
coordinates along and across that line place it: lengths would lose its height."""

FilePath: TypeAlias = tuple[str, ...]
"""Path of a value in the file."""


def with_sizes(file: FileNode) -> tuple[FileNode, DrawnPoints | None]:
    """Return a file with the sizes that follow from its coordinates; None if these are faulty.

    Parameters
    ----------
    file : FileNode
        The whole problem file, its unit read.
    """
    drawn = file["drawn"]
    step = drawn.read("round", FileNode.length)
    places = drawn.read("points", partial(_read_points, file=file))
    if not places or not drawn.is_sound:
        return file, None
    return _Sizes(file, places, step).fill()


def _read_points(node: FileNode, file: FileNode) -> dict[str, complex]:
    node.table("points = { A = [0, 0], B = [0.05, 0.1] }")
    node.require_at_most(keys.POINT_LIMIT, "{} points, the limit is {}")
    links, frame = file["links"].value, file["frame"].value
    known = [k for k in (frame if isinstance(frame, Mapping) else ()) if k not in keys.FRAME]
    for table in links.values() if isinstance(links, Mapping) else ():
        points = table.get("points") if isinstance(table, Mapping) else None
        known += [point for point in points or () if isinstance(point, str)]

    def read_place(entry: FileNode) -> complex:
        name = entry.unmask(str(entry.key))
        if not is_point_name(name) or name not in {plain_name(one) for one in known}:
            entry.reject_unknown(name, dict.fromkeys(known), "no link has the point '{}'")
        return entry.place()

    found = {}
    for entry in node.entries():
        place = entry.attempt(read_place)
        if place is not None:
            found[entry.unmask(str(entry.key))] = place
    node.require_sound()
    if not found:
        node.reject("no points are given", hint=translate("For example: points = {{ A = [0, 0] }}"))
    return found


class _Sizes:
    """The tables of a file with the sizes that follow from coordinates."""

    def __init__(self, file: FileNode, places: dict[str, complex], step: float | None) -> None:
        self.file, self.given, self.step = file, dict(places), step
        self.per = UNITS[file.faults.unit]
        self.lines = DrawnLines(file, dict(places))
        self.z, self.links = self.lines.z, self.lines.links
        self.table: dict[str, Any] = dict(file.value)
        self.sizes: list[DrawnSize] = []
        self.values: dict[FilePath, Any] = {}
        self.found: dict[FilePath, Any] = {}

    def fill(self) -> tuple[FileNode, DrawnPoints]:
        """Fill in the frame, the links and the driver."""
        self._frame()
        links = self.table.get("links")
        if isinstance(links, Mapping):
            for name, table in links.items():
                if isinstance(table, Mapping):
                    self.links[plain_name(str(name))] = dict(table)
        for name in self.links:
            self._lengths(name)
        self._guides()
        for name in self.links:
            self._slide(name)
        if isinstance(links, Mapping):
            own = {name: self.links.get(plain_name(str(name)), links[name]) for name in links}
            self.table["links"] = own
        position = self._driver()
        shown = DrawnPoints(
            self.given, tuple(self.sizes), self.step, position, self.values, self.found
        )
        return self.file.with_value(self.table), shown

    # Numbers -----------------------------------------------------------------------------------

    def _add(self, path: FilePath, exact: float, of: tuple[str, ...] = ()) -> float:
        """Return a size that follows, rounded if the file asks for it, in its unit."""
        value = exact
        if self.step is not None:
            value = round(exact / self.step) * self.step
            value = round(value * self.per, 12) / self.per
            if of and not value:
                self.file["drawn"]["round"].note(
                    "{} = {} becomes zero", path[-1], self._format(exact),
                    hint="Round to a smaller step.",
                )  # fmt: skip
                value = exact
        self.sizes.append(DrawnSize(path, exact, value, of))
        return round(value * self.per, 12) if self.step is not None else value * self.per

    def _format(self, metres: float) -> str:
        return format_length(metres, self.file.faults.unit, 5)

    # Frame -------------------------------------------------------------------------------------

    def _frame(self) -> None:
        """Fill in the fixed points that are drawn, and compare the others."""
        frame = self.table.get("frame")
        if not isinstance(frame, Mapping):
            return
        frame = dict(frame)
        self.fixed = [plain_name(str(key)) for key in frame if key not in keys.FRAME]
        for key, value in frame.items():
            name = plain_name(str(key))
            if key in keys.FRAME:
                continue
            parts = value if isinstance(value, list) and len(value) == 2 else [value, value]
            drawn = [part == DRAWN for part in parts]
            if not any(drawn):
                place = self.lines.read(value, FileNode.place)
                if place is not None:
                    self._compare(("frame", name), place, name)
                    self.z[name] = place
                continue
            if name not in self.given:
                continue  # found by the other numbers of the figure
            place = self.given[name]
            shown: list[float] = []
            for k, part in enumerate((place.real, place.imag)):
                if drawn[k]:
                    shown.append(self._add(("frame", name, "xy"[k]), part))
                else:
                    known = self.lines.read(parts[k], FileNode.coordinate)
                    shown.append(part * self.per if known is None else known * self.per)
            self.values["frame", name] = value
            self.found["frame", name] = [one / self.per for one in shown]
            self._compare(("frame", name), complex(*self.found["frame", name]), name, self.step)
            frame[key] = shown
        self.table["frame"] = frame

    def _compare(
        self, path: FilePath, place: complex, name: str, step: float | None = None
    ) -> None:
        """Note a fixed point that is elsewhere in the figure."""
        if name not in self.given:
            return
        off = abs(place - self.given[name])
        if off > LENGTH_TOLERANCE * self.lines.extent + (step or 0.0):
            self.file["drawn"]["points"][name].note(
                "[frame] has {} {} away from there", name, self._format(off),
                hint='Correct one of them, or write [frame] A = "drawn".',
            )  # fmt: skip

    # Links -------------------------------------------------------------------------------------

    def _lengths(self, link: str) -> None:
        """Add the lengths of a link that place its points, and the sides of third points."""
        table = self.links[link]
        listed = table.get("points")
        names = [plain_name(p) for p in listed or () if isinstance(p, str)]
        given = self._given_lengths(link, names)
        if "slides" in table:
            self._along_slide(link, names)
            return
        if len(names) < 2:
            return
        forms = {plain_name(str(k)): v for k, v in table.items() if isinstance(v, Mapping)}
        whole = {name for name, form in forms.items() if name in names and "side" not in form}
        base = next((pair for pair in given if not whole & {*pair}), None)
        pivot = next((p for p in names if p in getattr(self, "fixed", ())), names[0])
        if base is None or (self._is_crank(link) and pivot != base[0]):
            free = [p for p in names if p != pivot and p not in whole and p in self.z]
            if pivot not in self.z or not free:
                return
            base = (pivot, free[0])
            self._add_length(link, *base, first=True)
        self.lines.axes[link] = base if not given or self._is_crank(link) else given[0]
        placed = [*base]
        for point in names:
            if point in placed or point in whole or point not in self.z:
                continue
            known = [q for q in placed if (q, point) in given or (point, q) in given]
            if len(known) == 1 and self._has_angle(table, point):
                placed.append(point)
            elif len(known) < 2 or "side" not in forms.get(point, {}):
                self._third(link, point, placed, known, forms.get(point))
                placed.append(point)
            else:
                placed.append(point)

    def _given_lengths(self, link: str, names: Sequence[str]) -> list[tuple[str, str]]:
        """Return the lengths that a link has, compared with the coordinates."""
        found = []
        for key, value in self.links[link].items():
            pair = split_pair(plain_name(str(key)))
            if pair is None or not {*pair} <= {*names} or isinstance(value, Mapping):
                continue
            found.append(pair)
            length = self.lines.read(value, FileNode.length)
            if length is None or not {*pair} <= {*self.z}:
                continue
            shown = abs(self.z[pair[1]] - self.z[pair[0]])
            if abs(shown - length) > LENGTH_TOLERANCE * length + SAME * self.lines.extent:
                self.file["drawn"]["points"].note(
                    "{} = {} in [links.{}], but the coordinates put {} and {} {} apart",
                    key, self._format(length), link, *pair, self._format(shown),
                    hint="Correct one of them, or leave the length out: it then follows.",
                )  # fmt: skip
        return found

    def _is_crank(self, link: str) -> bool:
        driver = self.file["driver"]["link"].value
        return isinstance(driver, str) and plain_name(driver) == link

    def _has_angle(self, table: Mapping[str, Any], point: str) -> bool:
        angles = table.get("angle")
        return isinstance(angles, Mapping) and any(point in str(key) for key in angles)

    def _add_length(self, link: str, one: str, two: str, *, first: bool = False) -> None:
        """Add the distance of two points of a link; ``first`` gives it the own axis."""
        length = abs(self.z[two] - self.z[one])
        if length <= SAME * self.lines.extent:
            message = "{} and {} of link {} are at the same place, so {} would be zero"
            self.file["drawn"]["points"].note(
                message, one, two, link, f"{one}{two}",
                hint="Give them one letter, or correct their coordinates.",
            )  # fmt: skip
            return
        key = f"{one}{two}"
        value = self._add(("links", link, key), length, (one, two))
        table = self.links[link]
        if first:
            points = {k: v for k, v in table.items() if k == "points"}
            table = {**points, key: value, **{k: v for k, v in table.items() if k != "points"}}
            self.links[link] = table
        else:
            table[key] = value

    def _third(
        self, link: str, point: str, placed: Sequence[str], known: list[str], form: Any
    ) -> None:
        """Place a third point: by two lengths and its side, or along the line if it is flat."""
        a, b = placed[:2]
        if a not in self.z or b not in self.z:
            return
        line = self.z[b] - self.z[a]
        if abs(line) <= SAME * self.lines.extent:
            return  # noted where the length of the line was added
        across = (self.z[point] - self.z[a]) / line
        if not known and form is None and abs(across.imag) < FLAT:
            along = self._add(("links", link, point, "at"), across.real * abs(line))
            self.links[link][point] = {"on": f"{a}{b}", "at": along}
            if abs(across.imag) > SAME:
                height = self._add(("links", link, point, "across"), across.imag * abs(line))
                self.links[link][point]["across"] = height
            return
        for other in placed:
            if len(known) < 2 and other not in known:
                self._add_length(link, other, point)
                known.append(other)
        one, two = known[:2]
        side = (self.z[point] - self.z[one]) / (self.z[two] - self.z[one])
        if form is None and abs(side.imag) > SAME:
            word = "left" if side.imag > 0 else "right"
            self.links[link][point] = {"side": f"{word} of {one}{two}"}
            self.sizes.append(DrawnSize(("links", link, point, "side"), 0.0, 0.0))

    # Slides ------------------------------------------------------------------------------------

    def _along_slide(self, link: str, names: Sequence[str]) -> None:
        """Place the further points of a slider along and across its slide."""
        table, course = self.links[link], self.lines.course(link)
        pin = names[0] if names else ""
        for point in names[1:]:
            key = next((k for k in table if point in (split_pair(str(k)) or ())), None)
            if key is not None or point in table or not {pin, point} <= {*self.z}:
                continue
            if course is None:
                continue
            vector = (self.z[point] - self.z[pin]) / course
            form: dict[str, Any] = {"from": pin}
            form["at"] = self._add(("links", link, point, "at"), vector.real)
            if abs(vector.imag) > SAME * self.lines.extent:
                form["across"] = self._add(("links", link, point, "across"), vector.imag)
            table[point] = form

    def _guides(self) -> None:
        """Fill in the guides that are drawn."""
        frame = self.table.get("frame")
        guides = frame.get("guides") if isinstance(frame, Mapping) else None
        if not isinstance(frame, Mapping) or not isinstance(guides, Mapping):
            return
        filled = dict(guides)
        for name, guide in guides.items():
            if not isinstance(guide, Mapping):
                continue
            through = guide.get("through")
            parts = through if isinstance(through, list) else [through, through]
            line = self.lines.guide(name) if DRAWN in parts or guide.get("angle") == DRAWN else None
            if line is None:
                continue
            made, path = dict(guide), ("frame", "guides", name)
            if DRAWN in parts:
                self.values[*path, "through"] = through
                shown = [
                    self._add((*path, "through", "xy"[k]), one) if part == DRAWN else one * self.per
                    for k, (part, one) in enumerate(
                        zip(parts, (line[0].real, line[0].imag), strict=True)
                    )
                ]
                self.found[*path, "through"] = [one / self.per for one in shown]
                made["through"] = shown
            if guide.get("angle") == DRAWN:
                made["angle"] = heading(line[1])
                self.values[*path, "angle"] = DRAWN
                self.found[*path, "angle"] = made["angle"]
            filled[name] = made
        self.table["frame"] = {**frame, "guides": filled}

    def _slide(self, link: str) -> None:
        """Add the distance of a pin from the line that its block slides along."""
        slides = self.links[link].get("slides")
        points = self.links[link].get("points")
        if not (isinstance(slides, Mapping) and isinstance(points, list) and points):
            return
        if "centre" in slides or "radius" in slides:
            self._slot(link, slides, str(points[0]))
            return
        pin, line = self.z.get(plain_name(str(points[0]))), self.lines.line(link)
        if pin is None or line is None:
            return
        across = ((pin - line[0]) / line[1]).imag
        known = self.lines.read(slides.get("offset", 0.0), FileNode.coordinate)
        if "offset" in slides:
            if known is not None and abs(across - known) > LENGTH_TOLERANCE * self.lines.extent:
                self.file["drawn"]["points"].note(
                    "the coordinates put {} {} from the line of link {}, offset = {}",
                    points[0], self._format(across), link, self._format(known),
                    hint="Correct one of them, or leave the offset out: it then follows.",
                )  # fmt: skip
        elif abs(across) > SAME * self.lines.extent:
            offset = self._add(("links", link, "slides", "offset"), across)
            self.links[link]["slides"] = {**slides, "offset": offset}

    def _slot(self, link: str, slides: Mapping[str, Any], pin: str) -> None:
        """Add the radius of a circular slot."""
        pin, centre = (
            plain_name(pin),
            plain_name(str(slides.get("centre"))),
        )
        if "radius" in slides or not {pin, centre} <= {*self.z}:
            return
        radius = abs(self.z[pin] - self.z[centre])
        value = self._add(("links", link, "slides", "radius"), radius, (centre, pin))
        self.links[link]["slides"] = {**slides, "radius": value}

    # Driver ------------------------------------------------------------------------------------

    def _driver(self) -> float | None:
        """Fill in the position of the driver, and return that of the figure, degrees or m."""
        driver = self.table.get("driver")
        if not isinstance(driver, Mapping):
            return None
        link = plain_name(str(driver.get("link")))
        table = self.links.get(link)
        if table is None:
            return None
        turns = "slides" not in table
        key, found = ("phi", self._phi(link)) if turns else ("s", self._travel(link))
        own = driver.get(key)
        others = any(
            is_posed(str(one)) or (is_place(str(one)) and one != key) or one == "cam"
            for one in driver
        )
        asked = own == DRAWN or (own is None and not others and "cycle" not in self.table)
        if asked and found is not None:
            self.table["driver"] = {**driver, key: found if turns else found * self.per}
            self.values["driver", key] = DRAWN
            self.found["driver", key] = found
        return found

    def _phi(self, link: str) -> float | None:
        axis = self.lines.axis(link, 0)
        return None if axis is None else heading(axis) % 360.0

    def _travel(self, link: str) -> float | None:
        points, line = self.links[link].get("points"), self.lines.line(link)
        if line is None or not isinstance(points, list) or not points:
            return None
        pin = self.z.get(plain_name(str(points[0])))
        return None if pin is None else ((pin - line[0]) / line[1]).real
