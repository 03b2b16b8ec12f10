"""Outputs of a cam: students' quantities, motion of the follower, construction by steps."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cached_property, partial
from math import degrees, isfinite

import numpy as np
from msgspec.structs import replace

from planmethod.cams.construction import CamConstruction, CamReadings, construct
from planmethod.cams.design import CamDesign, CamNode, design_of, motion_in_division
from planmethod.cams.model import (
    ArmSense,
    CamPhase,
    CamProblem,
    Contact,
    MotionOrder,
    motions_of,
)
from planmethod.cams.reader import PLACED, SIZE_NAMES, read_cam
from planmethod.cams.sheet import sheet_scales
from planmethod.cams.text import MM, checks, head, motion_facts, positions, sizes
from planmethod.construct import steps
from planmethod.construct.drafting import Profile
from planmethod.construct.steps import NumberName, Step
from planmethod.errors import ProblemError
from planmethod.note.document import (
    Caption,
    Chapter,
    GivenFact,
    Item,
    Node,
    Paragraph,
    steps_of,
    table_of,
)
from planmethod.note.formula import Rich, capitalized, escape
from planmethod.note.narrate.narrator import Line, Reading, StepNarrator
from planmethod.note.wording import Language
from planmethod.problem.file_node import FileNode
from planmethod.problem.model import CamDrive, LawPiece
from planmethod.problem.records import AnswerValue, Mistaken, QuantityReader, Relations

SYMBOLS = {
    "r_min": "r_{min}", "e": "e", "centre_distance": "a", "roller": "r_{p}", "theta_max": "ϑ_{max}",
    "theta_max_return": "ϑ_{max}", "rho_min": "ρ_{min}", "s": "s", "v_q": "v_{q}", "a_q": "a_{q}",
    "theta": "ϑ",
}  # fmt: skip
SIGNED = ("e", "v_q", "a_q", "theta")
PER_DEGREE = np.pi / 180
POWERS = {"v_q": 1, "a_q": 2}


class CamQuantities:
    """Quantities of a cam for questions (`QuestionQuantities`)."""

    def __init__(self, problem: CamProblem) -> None:
        self.problem, self.count = problem, problem.count
        self.design = design_of(problem)
        self.names = tuple(n for n in (*SIZE_NAMES, *PLACED) if self._of(n, 0) is not None)

    def quantity(self, name: str, position: int) -> AnswerValue | None:
        """Return a quantity by its name in ``[[answers]]``."""
        value = self._of(name, position)
        if value is None:
            return None
        unit = "deg" if name.startswith("theta") else "m"
        return AnswerValue(SYMBOLS[name], unit, value, signed=name in SIGNED)

    def _of(self, name: str, position: int) -> float | None:
        return value_of(self.design, name, position)

    @cached_property
    def built(self) -> CamConstruction:
        """The construction at the scales of the sheet."""
        return construct(self.design, sheet_scales(self.problem))

    def read_off(self, name: str, position: int, profile: Profile) -> tuple[float, float] | None:
        """Return its segment on the drawing, mm, and one sigma of the reading."""
        built, value = self.built, self._of(name, position)
        if value is None:
            return None
        if name in built.results:
            per_mm, of = built.scales.region, str(built.results[name])
            return abs(value) / per_mm, self._sigma(profile)[of]
        if name not in ("s", "v_q"):
            return None
        phi = self.problem.angles()[position]
        node = min(built.nodes, key=lambda one: abs(one.phi - phi))
        per_mm = float(getattr(built.scales, name[0]))
        return abs(value) / per_mm, per_mm * self._sigma(profile)[f"{name[0]}_{{{node.number}}}"]

    def _sigma(self, profile: Profile) -> Mapping[str, float]:
        if profile not in self._sigmas:
            self._sigmas[profile] = self.built.sigma(profile)
        return self._sigmas[profile]

    @cached_property
    def _sigmas(self) -> dict[Profile, Mapping[str, float]]:
        return {}

    def mistaken(self) -> Iterator[Mistaken]:
        """Yield the usual mistakes: limits, dwell, law, sign of e, degrees."""
        one = self.problem
        rise, back = one.allowed
        if back is not None and back != rise:
            yield from self._another_cam("Q1", replace(one, allowed=(back, rise)))
        if one.length(CamPhase.UPPER) > 0 and (orders := _without_dwell(one)):
            yield from self._another_cam("Q2", replace(one, motions=motions_of(orders)))
        if len(set(one.laws)) > 1:
            ruled = tuple(m if m.law is None else replace(m, law=one.laws[0]) for m in one.motions)
            yield from self._another_cam("Q3", replace(one, motions=ruled))
        if not one.oscillates and self.design.pitch_geometry.e and one.contact is not Contact.FLAT:
            given = replace(
                one, r_min=self.design.pitch_geometry.r_min, offset=-self.design.pitch_geometry.e
            )
            yield from self._another_cam("Q4", given)
        yield Mistaken("Q5", "", self._in_degrees)

    def _another_cam(self, code: str, problem: CamProblem) -> Iterator[Mistaken]:
        """Yield a mistake that results in another cam, if that exists."""
        take: QuantityReader = partial(value_of, design_of(problem))
        try:
            take("r_min", 0)
        except ProblemError:
            return
        yield Mistaken(code, "", take)

    def _in_degrees(self, name: str, position: int) -> float | None:
        value = self._of(name, position)
        return None if value is None else value * PER_DEGREE ** POWERS.get(name, 0)

    def relations(self, names: Sequence[str], position: int) -> Relations:
        """Return none: no number of a cam follows from another one alone."""
        return Relations()


def _without_dwell(problem: CamProblem) -> list[MotionOrder]:
    """Return the motions of a turn without its first upper dwell, which its end gains."""
    phases = [one.phase for one in problem.motions]
    skipped = problem.motions[phases.index(CamPhase.UPPER)]
    kept = [one for one in problem.motions if one is not skipped]
    orders = [MotionOrder(one.length, one.after - one.before, one.law) for one in kept]
    if problem.last_dwell is None:
        return [*orders, MotionOrder(skipped.length, 0.0)]
    return [*orders[:-1], orders[-1]._replace(length=orders[-1].length + skipped.length)]


def value_of(design: CamDesign, name: str, position: int) -> float | None:
    """Return a quantity of a cam, m or degrees; None if it is unknown."""
    problem, geometry = design.problem, design.geometry
    if name in PLACED:
        phi = problem.angles()[position : position + 1]
        moved = problem.at(phi)
        if name == "theta":
            flat = problem.contact is Contact.FLAT
            return None if flat else degrees(float(geometry.points(phi, moved).pressure[0]))
        return float(moved[("s", "v_q", "a_q").index(name), 0])
    flat = problem.contact is Contact.FLAT
    phase = CamPhase.RISE if name == "theta_max" else CamPhase.RETURN
    found: dict[str, Callable[[], float | None]] = {
        "r_min": lambda: geometry.r_min,
        "e": lambda: None if problem.oscillates or flat else geometry.e,
        "centre_distance": lambda: geometry.centre or None,
        "roller": lambda: geometry.roller or None,
        "rho_min": lambda: design.rho_min.value if isfinite(design.rho_min.value) else None,
        "theta_max": lambda: None if flat else degrees(design.pressure(phase).value),
        "theta_max_return": lambda: None if flat else degrees(design.pressure(phase).value),
    }
    return found[name]() if name in found else None


class CamFollower(CamDrive, frozen=True, kw_only=True):
    """Follower that drives a linkage, with its cam.

    Attributes
    ----------
    cam : CamProblem
    """

    cam: CamProblem

    def given_facts(self, language: Language) -> list[GivenFact]:
        """Return the given facts of the follower's motion: its law."""
        return motion_facts(self.cam, language)


def read_follower_drive(file: FileNode) -> CamDrive:
    """Return the motion that the follower gives the driving link over a turn of the cam."""
    cam = file["cam"]
    problem = CamProblem(name="", **read_cam(cam))
    if not problem.n:
        hint = "Give the speed of the cam that drives, rev/min: n = 120."
        cam["n"].reject("missing", hint=hint)
    return follower_drive(problem)


def follower_drive(problem: CamProblem) -> CamDrive:
    """Return the motion of the follower from its lowest position.

    The displacement of a translating follower grows with the rise; during the rise an oscillating
    one turns in the sense of the cam, or against it.
    """
    per_metre = 1.0
    if problem.oscillates:
        per_metre = problem.mirror * (1 if problem.sense is ArmSense.SAME else -1) / problem.arm
    pieces = tuple(_pieces(problem, per_metre))
    return CamFollower(problem.oscillates, problem.n or 0.0, pieces, cam=problem)


def _pieces(problem: CamProblem, per_metre: float) -> Iterator[LawPiece]:
    """Yield the smooth parts of the turn: the displacement of the link per metre of the follower's.

    ``per_metre`` is 1, or the angle of an arm.
    """
    for stretch in problem.stretches:
        one = stretch.motion
        before, change = (x * per_metre for x in (one.before, one.after - one.before))
        if one.law is None:
            yield LawPiece(stretch.start, (before,))
            continue
        powers, wave, rate, phase = one.law.terms(stretch.bit)
        lengthened = [change * factor / one.length**k for k, factor in enumerate(powers)]
        lengthened[0] += before
        yield LawPiece(stretch.start, tuple(lengthened), change * wave, rate / one.length, phase)


DETAILED_PARTS = 2
"""Number of parts of the diagrams that are described in full."""


def protocol_document(problem: CamProblem, language: Language, profile: Profile) -> Iterator[Node]:
    """Yield the construction of a cam; the scales are those of the sheet.

    Raises
    ------
    ProblemError
        No cam satisfies the requirements.
    LayoutError
        The sheet cannot be drawn.
    """
    yield from head(problem, language)
    if problem.source:
        yield Paragraph(language.note.source.format(source=escape(problem.source)))
    yield Paragraph(language.note.ruler.format(ruler=language.notation.as_input(profile.ruler)))
    yield from construction_nodes(
        construct(design_of(problem), sheet_scales(problem)), language, profile
    )


def construction_nodes(
    built: CamConstruction, language: Language, profile: Profile
) -> Iterator[Node]:
    """Yield the chapters of a construction, the exact solution after it."""
    texts, drawn = language.cam, CamReadings(built, language, profile)
    yield Chapter(texts["chapters"]["diagrams"], numbered=False)
    yield from _diagrams(built, drawn, language)
    if built.results:
        yield Chapter(texts["chapters"]["region"], numbered=False)
        yield from region_nodes(built, drawn, language)
    yield Chapter(texts["chapters"]["profile"], numbered=False)
    yield from _profile(built, drawn, language)
    yield Chapter(texts["chapters"]["exact"], numbered=False)
    yield sizes(built.design, language)
    yield from map(Item, checks(built.design, language))
    yield positions(built.design, language)


def _diagrams(built: CamConstruction, drawn: CamReadings, language: Language) -> Iterator[Node]:
    """Yield the integration of the diagrams: the first parts in full, the others as a table."""
    texts, notation, scales = language.cam, language.notation, built.scales
    problem = built.design.problem
    fields = {name: notation.as_input(MM * getattr(scales, name)) for name in "sva"}
    pole_a, pole_v = notation.short(scales.pole_a, 4), notation.short(scales.pole_v, 4)
    text = texts.scales.format(
        degree=notation.as_input(scales.degree), phi=notation.short(scales.phi, 4), pole_a=pole_a,
        pole_v=pole_v, **fields,
    )  # fmt: skip
    yield Paragraph(f"{capitalized(text)}.")
    yield Paragraph(texts.divided.format(parts=problem.parts, count=len(built.nodes)))
    yield Paragraph(texts.integrated)
    yield from steps_of([texts.poles.format(pole_a=pole_a, pole_v=pole_v)])
    narrator = CamNarrator(built, drawn, language)
    for node in [node for node in built.nodes if not node.starts][:DETAILED_PARTS]:
        for step in narrator.part(node):
            yield from steps_of(narrator.narrate(step))
    yield Paragraph(texts.likewise)
    rows, path = [], drawn.path()
    for row, node in enumerate(built.nodes):
        k, one = node.number, path[row]
        v, s = (drawn.number(f"{name}_{{{k}}}") + 0.0 for name in "vs")
        rows.append(
            (
                str(k),
                notation.as_input(round(degrees(node.phi), 2)),
                notation.measured(v),
                notation.measured(s),
                *notation.numbers(f"{one.read:.2f}", f"{one.exact:.2f}", one.sigma_text),
            )
        )
    yield table_of(texts["diagram_heads"], rows, names=0)


def region_nodes(built: CamConstruction, drawn: CamReadings, language: Language) -> Iterator[Node]:
    """Yield the region of permissible axes."""
    texts, notation, problem = language.cam, language.notation, built.design.problem
    plate = problem.contact is Contact.FLAT
    arm, level = (
        (texts.told_swung, texts.told_plate) if plate else (texts.told_arm, texts.told_region)
    )
    text = arm if problem.oscillates else level
    yield from steps_of([text.format(scale=notation.as_input(MM * built.scales.region))])
    for number, k in built.drawn.items():
        point = f"D_{{{k}}}"
        if plate:
            line = texts.swung_line if problem.oscillates else texts.plate_line
            yield from steps_of([line.format(point=point)])
            if problem.oscillates and problem.min_radius:
                yield from steps_of([texts.swung_aside.format(point=point)])
            if problem.oscillates:
                yield from steps_of([texts.swung_axis])
            continue
        bound = built.bounds[number]
        limit = problem.limit(bound.phase) or 0.0
        angle = notation.as_input(round(90.0 - degrees(limit), 6))
        phase = texts["limit_of"][bound.phase.value]
        yield from steps_of([texts.limit_line.format(point=point, angle=angle, phase=phase)])
    if not plate:
        yield from steps_of([texts.found_axis])
    yield Caption(
        language.point.read_title.format(profile=language.note["profiles"][drawn.profile.name])
    )
    yield drawn.table()


def _profile(built: CamConstruction, drawn: CamReadings, language: Language) -> Iterator[Node]:
    """Yield the profile by inverted motion: one position in full, the others as a table."""
    texts, notation, design = language.cam, language.notation, built.design
    problem, mm = design.problem, built.scales.profile
    listed = "; ".join(
        f"{row[1]} = {row[2]} {notation.units['mm']}" for row in sizes(design, language).rows
    )
    yield Paragraph(texts.told_profile.format(sizes=listed, scale=notation.as_input(MM * mm)))
    node = built.nodes[problem.parts // 2]
    yield from steps_of([inverted_sentence(built, drawn, node, language)])
    if problem.contact is Contact.ROLLER:
        yield from steps_of([texts.envelope])
    rows, radii = [], drawn.radii()
    for row, node in enumerate(built.nodes):
        one = radii[row]
        rows.append(
            (
                str(node.number),
                notation.as_input(round(degrees(node.phi), 2)),
                *notation.numbers(f"{one.read:.2f}", f"{one.exact:.2f}", one.sigma_text),
            )
        )
    yield table_of(texts["profile_heads"], rows, names=0)
    yield Paragraph(drawn.deviation())


def inverted_sentence(
    built: CamConstruction, drawn: CamReadings, node: CamNode, language: Language
) -> Rich:
    """Return how a point of the profile is found by inverted motion."""
    notation, design, problem = language.notation, built.design, built.design.problem
    plate = problem.contact is Contact.FLAT
    key = "oscillating" if problem.oscillates else "flat" if plate else "translating"
    k = node.number
    fields: dict[str, Rich] = {
        "k": str(k), "phi": notation.as_input(round(-degrees(node.phi), 4)), "point": f"B_{{{k}}}",
        "radius": notation.measured(drawn.number(f"R_{{{k}}}")),
    }  # fmt: skip
    if problem.oscillates:
        rest = design.geometry.delta0 + float(motion_in_division(problem, node)[0]) / problem.arm
        fields["delta"] = notation.short(degrees(rest), 4)
    elif not plate:
        fields["s"] = notation.short(drawn.number(f"s {k}, mm"), 4)
    text: Rich = language.cam["inverted"][key].format(**fields)
    return text


class CamNarrator(StepNarrator):
    """Narrator of the steps that integrate the diagrams (рассказчик)."""

    def __init__(self, built: CamConstruction, drawn: CamReadings, language: Language) -> None:
        self.built, self.drawn, self.language, self.texts = built, drawn, language, language.cam
        self.step = {step.out: step for step in built.program.steps}

    def part(self, node: CamNode) -> list[Step]:
        """Return the steps of the part that ends at a division."""
        k = node.number
        wanted = (f"m_{{{k}}}", f"v_{{{k}}}")
        outs = [step.out for step in self.built.program.steps]
        first, last = (outs.index(NumberName(name)) for name in wanted)
        read = outs.index(NumberName(f"s_{{{k}}}"))
        return list(self.built.program.steps[first : max(last, read) + 1])

    def _format(self, value: float) -> Rich:
        return self.language.notation.short(value + 0.0, 4)

    def describe_laid_off_length(self, step: steps.LayOffLength) -> list[Rich]:
        """Describe the mean ordinate of a part."""
        if not step.out.startswith("m_"):
            return []
        size, k = self.drawn.number(step.length), step.out[3:-1]
        return [
            self.texts.ordinate.format(
                part=f"{int(k) - 1}–{k}", length=self._format(size), point=step.out
            )
        ]

    def describe_line(self, step: Line) -> list[Rich]:
        """Describe a ray from a pole."""
        if isinstance(step, steps.Join):
            return [self.texts.ray.format(ray=step.tail + step.head)]
        return []

    def describe_intersection(self, step: steps.IntersectLines) -> list[Rich]:
        """Describe the end of a chord, its middle, and that on the axis of ordinates."""
        letter, _, rest = step.out.partition("_")
        k = rest[1:-1]
        match letter:
            case "V" | "S" if rest and not rest.endswith("axis"):
                chord = self.step[step.first]
                if not isinstance(chord, steps.Parallel):
                    return []  # carried over from the motion before
                start = chord.through
                if not start.startswith(letter):  # a division of the axis of angles
                    number = start.partition("{")[2].partition("}")[0]
                    origin = f"O_{letter.lower()}"
                    start = steps.PointName(number if int(number) else origin)
                return [self.texts.chord.format(start=start, k=k, point=step.out)]
            case "M":
                return [self.texts.half.format(point=step.out)]
            case "n":
                return [self.texts.across.format(point=step.out)]
            case _:
                return []

    def describe_measured_segment(self, step: Reading) -> list[Rich]:
        """Describe an ordinate that is read."""
        exact = self.language.notation.number(
            f"{self.drawn.number(step.out, exact=True) + 0.0:.2f}"
        )
        length = self.language.notation.measured(self.drawn.number(step.out) + 0.0)
        return [self.texts.read_ordinate.format(symbol=step.out, length=length, exact=exact)]
