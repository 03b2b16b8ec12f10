"""Construction of a cam, step by step, in the words of the explanatory note (протокол)."""

from __future__ import annotations

from collections.abc import Iterator
from math import degrees

from planmethod.cams.construction import CamConstruction, construct
from planmethod.cams.design import CamDesign
from planmethod.cams.divisions import CamNode, motion_in_division
from planmethod.cams.model import CamProblem, Contact
from planmethod.cams.readings import CamReadings
from planmethod.cams.sheet import sheet_scales
from planmethod.cams.text import MM, checks, head, positions, sizes
from planmethod.construct import steps
from planmethod.construct.drafting import Profile
from planmethod.construct.steps import NumberName, Step
from planmethod.note.document import (
    Caption,
    Chapter,
    Item,
    Node,
    Paragraph,
    steps_of,
    table_of,
)
from planmethod.note.formula import Rich, escape
from planmethod.note.narrate.narrator import Line, Reading, StepNarrator
from planmethod.note.wording import Language

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
        construct(CamDesign(problem), sheet_scales(problem)), language, profile
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
        yield from _region(built, drawn, language)
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
    yield Paragraph(text[:1].upper() + text[1:] + ".")
    yield Paragraph(texts.divided.format(parts=problem.parts, count=len(built.nodes)))
    yield Paragraph(texts.integrated)
    yield from steps_of([texts.poles.format(pole_a=pole_a, pole_v=pole_v)])
    narrator = CamNarrator(built, drawn, language)
    for node in built.nodes[1 : DETAILED_PARTS + 1]:
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


def _region(built: CamConstruction, drawn: CamReadings, language: Language) -> Iterator[Node]:
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
    plate = problem.contact is Contact.FLAT
    key = "oscillating" if problem.oscillates else "flat" if plate else "translating"
    node = built.nodes[problem.parts // 2]
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
    yield from steps_of([texts["inverted"][key].format(**fields)])
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
                assert isinstance(chord, steps.Parallel)
                start = chord.through
                if not start.startswith(letter):
                    start = steps.PointName(f"O_{letter.lower()}")
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
