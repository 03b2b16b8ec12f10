"""Given data of links and guides in symbols: lengths, third points, slides, coordinates (Дано)."""

# no messages: rules, in the words of the file

from __future__ import annotations

import re
from collections.abc import Iterator

from msgspec.structs import replace

from planmethod.mechanism.model import FRAME
from planmethod.note.document import GivenFact
from planmethod.note.narrate.naming import point_name
from planmethod.note.narrate.sizes import coordinate_letters
from planmethod.note.numbers import MINUS, Notation, trimmed, with_unit
from planmethod.note.wording import Language
from planmethod.plans.model import Relation
from planmethod.plans.motion.legs import offset_name, slot_name, track_direction
from planmethod.problem.model import (
    Body,
    PointForm,
    Problem,
    Slide,
)
from planmethod.problem.names import UNITS, segment, split_names
from planmethod.problem.placement import rotation


class StatedNumbers:
    """Numbers as a file gives them: in its arithmetic and its unit of lengths (как дано)."""

    def __init__(self, problem: Problem, language: Language) -> None:
        self.problem, self.language, self.notation = problem, language, language.notation
        self.sizes = coordinate_letters(problem)

    def number_text(self, value: float, path: str = "") -> str:
        """Return a number without its unit; its arithmetic where digits would not be exact."""
        stated = self.problem.stated.get(path)
        if stated is not None and self._names_sizes(stated):
            return arithmetic(stated, self.notation)
        if stated is None or abs(float(trimmed(value, 6)) - value) <= 1e-12 * abs(value):
            return self.notation.as_input(value)
        return arithmetic(stated, self.notation)

    def number(self, value: float, unit: str, path: str = "") -> str:
        """Return a number with its unit; a product of sizes of the synthesis has none."""
        stated = self.problem.stated.get(path, "+")
        if not re.search(r"[-+−]", stated) and self._names_sizes(stated):
            return self.number_text(value, path)
        return with_unit(self.number_text(value, path), self.notation.units[unit])

    def _names_sizes(self, stated: str) -> bool:
        """Return whether arithmetic of the file names a result of its synthesis."""
        task = self.problem.synthesis
        return task is not None and task.is_named_in(stated)

    def metres(self, value: float, path: str = "") -> str:
        """Return a length, m, in the unit of the file."""
        unit = self.problem.unit
        return self.number(value * UNITS[unit], unit, path)

    def size(self, value: float, path: str = "") -> str:
        """Return the magnitude of a length whose sense is given in words."""
        return self.metres(value, path) if value >= 0 else self.metres(-value)


def arithmetic(text: str, notation: Notation) -> str:
    """Return arithmetic of a file as rich text: ``0.25/3`` gives ``0,25/3``."""
    text = text.replace("**", "^").replace("sqrt", "√").replace("pi", "π").strip(" °")
    text = re.sub(r"\btan\b", "tg", text)
    text = re.sub(r"\b([lxy])_([A-Z][A-Z0-9]*)", r"\1_{\2}", text)
    text = re.sub(r"\bphi_([0-9])", r"φ_{\1}", text).replace("theta", "θ")
    text = re.sub(r"\b(sin|cos|tg|ctg)\(([0-9.]+)\)", "\\1\u00a0\\2°", text)
    text = re.sub(r"\^ *([0-9]+)", r"^{\1}", text.replace("²", "^2").replace("³", "^3"))
    return text.replace(".", notation.decimal).replace("*", "·").replace("-", MINUS)


def file_path_of_link(link: str, key: str) -> str:
    """Return the path of a key of a link in the file."""
    return f"links.{segment(link)}.{key}"


DRAWN = 5
"""Digits of a coordinate that was computed: a hundredth of a millimetre of a link."""


def offset_slide(guide: str, problem: Problem) -> Slide | None:
    """Return the only slide of a guide, if it is offset from the point that locates the guide.

    The guide is then described, and drawn, where the slider runs; else where the file has it.
    """
    if problem.guides[guide][0] is None:
        return None
    on = [s for s in problem.slides.values() if s.host == FRAME and s.label == guide]
    return on[0] if len(on) == 1 and on[0].offset else None


def guide_facts(text: StatedNumbers, sought: frozenset[str]) -> Iterator[GivenFact]:
    """Yield where the guides of the frame run that something slides on; not of those sought."""
    problem = text.problem
    carried = {slide.label for slide in problem.slides.values() if slide.host == FRAME}
    for guide, (through, base, angle) in problem.guides.items():
        on = [s for s in problem.slides.values() if s.host == FRAME and s.label == guide]
        if guide in sought:
            pass  # told with the figure of the task
        elif through is not None and guide in carried:
            yield from _through_point(guide, through, text)
        elif through is None:
            yield from _guide(guide, base, angle, text)
        if offset_slide(guide, problem) is not None:
            continue  # the guide is described where the slider runs
        for slide in on:
            if slide.offset:
                way = text.language.note["given_ways"][_offset_side(slide)]
                yield _offset(slide, way, text)


def _offset(slide: Slide, side: str, text: StatedNumbers) -> GivenFact:
    """Return the distance and the side of a pin from the line that its slider runs along."""
    path = file_path_of_link(slide.slider, "slides.offset")
    name, size = offset_name(slide, text.problem), text.size(slide.offset, path)
    return GivenFact(f"{name} = {size} ({side})", {path: slide.offset})


def _offset_side(slide: Slide) -> str:
    """Return on which side of a guide of the frame the pin is, a key of words."""
    return direction_key(slide.angle + (90.0 if slide.offset > 0 else -90.0))


def _through_point(guide: str, through: str, text: StatedNumbers) -> Iterator[GivenFact]:
    """Yield how a guide runs that passes through a fixed point, or beside it."""
    problem, note = text.problem, text.language.note
    path = f"frame.guides.{segment(guide)}"
    angle = problem.guides[guide][2]
    key, phrase = _inclination(angle, path, text)
    data: dict[str, object] = {f"{path}.through": through, f"{path}.angle": angle}
    places = {"guide": problem.guide_name(guide), "point": point_name(through), "angle": phrase}
    beside = offset_slide(guide, problem)
    if beside is None:
        yield GivenFact(note["given_through"][key].format(**places), data)
        return
    own = file_path_of_link(beside.slider, "slides.offset")
    way = note["given_ways"][_offset_side(beside)]
    yield GivenFact(
        note["given_beside"][key].format(offset=text.size(beside.offset, own), way=way, **places),
        {**data, own: beside.offset},
    )


def _inclination(angle: float, path: str, text: StatedNumbers) -> tuple[str, str]:
    """Return the inclination of a line as a key of words (level, upright, angled), and its text."""
    key = {0.0: "level", 90.0: "upright"}.get(angle, "angled")
    return key, text.number(angle, "deg", f"{path}.angle")


def third_point_facts(link: str, body: Body, text: StatedNumbers) -> Iterator[GivenFact]:
    """Yield how a link's further points are given, where its lengths do not determine them."""
    note = text.language.note
    named = {name for of, name, _ in text.problem.lengths if of == link}
    lying: dict[str, tuple[list[str], dict[str, object]]] = {}
    for point, form in body.forms.items():
        path = file_path_of_link(link, segment(point))
        start = start_of_form(form)
        if form.kind == "side":
            side = note.given_left if form.left else note.given_right
            phrase = side.format(point=point_name(point), line=line_name(*form.line))
            sense = "left" if form.left else "right"
            yield GivenFact(phrase, {f"{path}.side": f"{sense} of {''.join(form.line)}"})
        elif form.kind == "vertex":
            angle = text.number(form.angle, "deg", f"{path}.angle")
            data: dict[str, object] = {
                f"{path}.vertex": start,
                f"{path}.ray": "".join(form.line),
                f"{path}.angle": form.angle,
            }
            yield GivenFact(f"∠{line_name(form.line[1], start)}{point_name(point)} = {angle}", data)
            if form.distance is not None:
                distance = text.metres(form.distance, f"{path}.distance")
                own: dict[str, object] = {f"{path}.distance": form.distance}
                yield GivenFact(f"l_{{{start}{point}}} = {distance}", own)
        elif form.lateral_offset or (form.kind == "from" and body.axis is None):
            yield _offset_point(link, point, text)
        else:
            axis = form.line if form.kind == "on" else body.axis or ()
            place: dict[str, object] = {f"{path}.{form.kind}": "".join(form.line) or start}
            if not {f"{start}{point}", f"{point}{start}"} & named:
                at = text.size(form.at, f"{path}.at")
                yield GivenFact(f"l_{{{start}{point}}} = {at}", {f"{path}.at": form.at})
            template = note.given_beyond if form.at < 0 else note.given_on
            phrase = template.format(
                points="{points}", line=line_name(*axis), start=point_name(start)
            )
            if point in axis:  # the line is named by the point itself
                phrase = ""
            points, keys = lying.setdefault(phrase, ([], {}))
            points.append(point_name(point))
            keys |= place
    for phrase, (points, keys) in lying.items():
        yield GivenFact(phrase.replace("{points}", ", ".join(points)), keys)
    for key, degrees in body.angles.items():
        angle = text.number(degrees, "deg", f"{file_path_of_link(link, 'angle')}.{key}")
        letters = [point_name(name) for name in split_names(key)]
        phrase = "".join(letters)
        if len(letters) == 4:
            phrase = f"({''.join(letters[:2])}, {''.join(letters[2:])})"
        yield GivenFact(
            f"∠{phrase} = {angle}", {f"{file_path_of_link(link, 'angle')}.{segment(key)}": degrees}
        )


def start_of_form(form: PointForm) -> str:
    """Return the point that a third point is measured from."""
    return form.point or form.line[0]


def _offset_point(link: str, point: str, text: StatedNumbers) -> GivenFact:
    """Return where a point is along a line of its link and beside it, or along its own guide."""
    problem, note = text.problem, text.language.note
    body, path = problem.bodies[link], file_path_of_link(link, segment(point))
    form, ways = body.forms[point], note["given_ways"]
    start = start_of_form(form)
    axis = form.line if form.kind == "on" else body.axis
    data: dict[str, object] = {
        f"{path}.{form.kind}": "".join(form.line) or start,
        f"{path}.at": form.at,
        f"{path}.across": form.lateral_offset,
    }
    turn = axis_angle(link, problem)
    across = text.size(form.lateral_offset, f"{path}.across")
    if turn is None or axis is not None:
        line = line_name(*axis) if axis else _own_axis_name(link, text)
        at, way = text.metres(form.at, f"{path}.at"), ""
        side = str(note["given_sides"]["left" if form.lateral_offset > 0 else "right"]).format(
            line=line
        )
    else:
        line, at = _own_axis_name(link, text), text.size(form.at, f"{path}.at")
        way = f" {ways[direction_key(turn if form.at >= 0 else turn + 180.0)]}" if form.at else ""
        side = ways[direction_key(turn + (90.0 if form.lateral_offset > 0 else -90.0))]
    if not form.lateral_offset:
        along = note.given_along_line if form.at >= 0 else note.given_along_back
        told = way.strip() or along.format(line=line)
        at = text.size(form.at, f"{path}.at")
        return GivenFact(f"l_{{{start}{point}}} = {at} ({told})", data)
    places = {"point": point_name(point), "start": point_name(start), "line": line, "at": at + way}
    return GivenFact(note.given_along.format(across=f"{across} {side}", **places), data)


def axis_angle(link: str, problem: Problem) -> float | None:
    """Return the direction of a slider's own axis, degrees from +x; None where it turns."""
    turn = 0.0
    while link != FRAME:
        slide = problem.slides.get(link)
        if slide is None:
            return None
        turn, link = turn + slide.angle, slide.host
    return turn


def _own_axis_name(link: str, text: StatedNumbers) -> str:
    """Return the name of a link's axis that has no letters: that of its slide's line."""
    problem = text.problem
    slides = [s for s in problem.slides.values() if link in (s.slider, s.host)]
    slide = min(slides, key=lambda s: s.slider != link)
    told = track_direction(slide, problem)
    if told.guide:
        return told.guide
    if told.relation is Relation.PARALLEL:
        return line_name(*told.points)
    return text.language.note.given_way.format(link=slide.host)


def line_name(start: str, end: str) -> str:
    """Return the letters of a line by two of its points."""
    return f"{point_name(start)}{point_name(end)}"


def slide_line_facts(slide: Slide, text: StatedNumbers) -> Iterator[GivenFact]:
    """Yield the position of a slide's line on its link, or on the frame."""
    problem, note = text.problem, text.language.note
    host, path = problem.bodies[slide.host], file_path_of_link(slide.slider, "slides")
    pin, beside = (
        point_name(slide.pin),
        note["given_sides"]["left" if slide.offset > 0 else "right"],
    )
    if slide.towards is not None and slide.through is not None:
        line = line_name(slide.through, slide.towards)
        data: dict[str, object] = {f"{path}.along": f"{slide.through}{slide.towards}"}
        yield GivenFact(note.given_slides.format(point=pin, line=line), data)
        if slide.offset:
            yield _offset(slide, beside.format(line=line), text)
        return
    assert slide.through is not None, "a line of a link goes through a point of it"
    turn = axis_angle(slide.host, problem)
    angle = slide.angle if turn is None else (slide.angle + turn + 180.0) % 360.0 - 180.0
    data = {f"{path}.through": slide.through, f"{path}.angle": angle}
    on_line = problem.letters.line_letter(slide.host, slide.pin)
    line = slot_name(slide) if slide.offset else line_name(slide.through, on_line)
    if slide.offset:
        phrase = note.given_slot.format(
            guide=line, link=problem.mechanism.called(slide.host), slider=slide.slider,
            point=point_name(slide.through),
        )  # fmt: skip
        yield GivenFact(phrase, {f"{path}.through": slide.through})
    told = text.number(angle, "deg", f"{path}.angle")
    if turn is not None:
        key, _ = _inclination(angle, path, text)
        yield GivenFact(note["given_runs"][key].format(line=line, angle=told), data)
    elif host.axis is None:
        first = next(s for s in problem.slides.values() if slide.host in (s.host, s.slider))
        if slide is first and not slide.angle:
            slides = note.given_slides_on.format(slider=slide.slider, host=slide.host, line=line)
            yield GivenFact(slides, data)
        else:
            yield GivenFact(f"∠({_own_axis_name(slide.host, text)}, {line}) = {told}", data)
    elif angle % 180 == 90:
        yield GivenFact(f"{line} ⊥ {line_name(*host.axis)}", data)
    elif angle % 180:
        yield GivenFact(f"∠({line_name(*host.axis)}, {line}) = {told}", data)
    elif slide.offset or slide.through not in host.axis:
        yield GivenFact(f"{line} ∥ {line_name(*host.axis)}", data)
    else:
        yield GivenFact(note.given_slides.format(point=pin, line=line_name(*host.axis)), data)
    if slide.offset:
        if turn is not None:
            way = note["given_ways"][direction_key(angle + (90.0 if slide.offset > 0 else -90.0))]
        elif host.axis is None or angle % 90:
            way = beside.format(line=line)
        else:
            turned = note.given_turned.format(line=line_name(*host.axis), angle=told)
            way = beside.format(line=turned if angle else line_name(*host.axis))
        yield _offset(slide, way, text)


def coordinate_facts(name: str, place: complex, text: StatedNumbers, path: str) -> list[GivenFact]:
    """Return the coordinates of a fixed point, and of the path in the file that states it."""
    facts = []
    for index, (letter, metres) in enumerate((("x", place.real), ("y", place.imag))):
        value, stated = metres * UNITS[text.problem.unit], f"{path}[{index}]"
        phrase = text.metres(metres, stated)
        # A computed coordinate has more digits than can be drawn.
        if stated not in text.problem.stated and trimmed(value) != trimmed(value, 6):
            short = text.notation.number(trimmed(value, DRAWN))
            phrase = with_unit(short, text.notation.units[text.problem.unit])
        spelled = text.sizes.get((letter, name))
        symbol = f"{letter}_{{{name}}}" + (f" = {spelled}" if spelled else "")
        told = f"{symbol} = {phrase}"
        facts.append(GivenFact(told, {stated: metres}))
    return facts


def _guide(name: str, base: complex, angle: float, text: StatedNumbers) -> Iterator[GivenFact]:
    """Yield where a guide is: by one coordinate when it runs along an axis."""
    shown, path = text.problem.guide_name(name), f"frame.guides.{segment(name)}"
    x, y = coordinate_facts(shown, base, text, f"{path}.through")
    if angle % 180 == 0 or angle % 180 == 90:
        told = x if angle % 180 == 90 else y
        level: dict[str, object] = {f"{path}.angle": angle}
        yield replace(told, data={**told.data, **(level if angle in (0, 90) else {})})
        if angle not in (0, 90):
            yield GivenFact(f"∠({shown}) = {text.number(angle, 'deg', f'{path}.angle')}", level)
        return
    yield x
    yield y
    phrase = f"∠({shown}) = {text.number(angle, 'deg', f'{path}.angle')}"
    yield GivenFact(phrase, {f"{path}.angle": angle})


def direction_key(angle: float) -> str:
    """Return the direction of a line as a key of words: right, up, left or down."""
    x, y = rotation(angle).real, rotation(angle).imag
    if y == 0:
        return "right" if x > 0 else "left"
    return "up" if y > 0 else "down"
