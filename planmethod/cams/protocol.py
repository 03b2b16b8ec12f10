"""Construction of a cam, step by step, in the words of the explanatory note (протокол)."""

from __future__ import annotations

from collections.abc import Iterator
from math import degrees

import numpy as np

from planmethod.cams.construction import CamConstruction, construct
from planmethod.cams.design import CamDesign
from planmethod.cams.divisions import CamNode, moved_in
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
from planmethod.note.rounding import sigma_text
from planmethod.note.wording import Language

TOLD = 2
"""Number of parts of the diagrams that are described in full."""


def protocol_document(problem: CamProblem, words: Language, profile: Profile) -> Iterator[Node]:
    """Yield the construction of a cam; the scales are those of the sheet.

    Raises
    ------
    ProblemError
        No cam satisfies the requirements.
    LayoutError
        The sheet cannot be drawn.
    """
    yield from head(problem, words)
    if problem.source:
        yield Paragraph(words.note.source.format(source=escape(problem.source)))
    yield Paragraph(words.note.ruler.format(ruler=words.say.given(profile.ruler)))
    yield from construction_nodes(
        construct(CamDesign(problem), sheet_scales(problem)), words, profile
    )


def construction_nodes(built: CamConstruction, words: Language, profile: Profile) -> Iterator[Node]:
    """Yield the chapters of a construction, the exact solution after it."""
    said, drawn = words.cam, CamReadings(built, words, profile)
    yield Chapter(said["chapters"]["diagrams"], numbered=False)
    yield from _diagrams(built, drawn, words)
    if built.results:
        yield Chapter(said["chapters"]["region"], numbered=False)
        yield from _region(built, drawn, words)
    yield Chapter(said["chapters"]["profile"], numbered=False)
    yield from _profile(built, drawn, words)
    yield Chapter(said["chapters"]["exact"], numbered=False)
    yield sizes(built.design, words)
    yield from map(Item, checks(built.design, words))
    yield positions(built.design, words)


def _diagrams(built: CamConstruction, drawn: CamReadings, words: Language) -> Iterator[Node]:
    """Yield the integration of the diagrams: the first parts in full, the others as a table."""
    said, say, scales = words.cam, words.say, built.scales
    problem = built.design.problem
    fields = {name: say.given(MM * getattr(scales, name)) for name in "sva"}
    pole_a, pole_v = say.short(scales.pole_a, 4), say.short(scales.pole_v, 4)
    told = said.scales.format(
        degree=say.given(scales.degree), phi=say.short(scales.phi, 4), pole_a=pole_a,
        pole_v=pole_v, **fields,
    )  # fmt: skip
    yield Paragraph(told[:1].upper() + told[1:] + ".")
    yield Paragraph(said.divided.format(parts=problem.parts, count=len(built.nodes)))
    yield Paragraph(said.integrated)
    yield from steps_of([said.poles.format(pole_a=pole_a, pole_v=pole_v)])
    narrator = CamNarrator(built, drawn, words)
    for node in built.nodes[1 : TOLD + 1]:
        for step in narrator.part(node):
            yield from steps_of(narrator.tell(step))
    yield Paragraph(said.likewise)
    rows = []
    for node in built.nodes:
        k = node.number
        v, s = (drawn.number(f"{name}_{{{k}}}") for name in "vs")
        sigma = drawn.sigma[f"s_{{{k}}}"]
        rows.append(
            (
                str(k),
                say.given(round(degrees(node.phi), 2)),
                say.ruled(v + 0.0),
                say.ruled(s + 0.0),
                say.number(f"{MM * scales.s * s + 0.0:.2f}"),
                say.number(f"{MM * float(moved_in(problem, node)[0]) + 0.0:.2f}"),
                say.number(sigma_text(MM * scales.s * sigma)),
            )
        )
    yield table_of(said["diagram_heads"], rows, names=0)


def _region(built: CamConstruction, drawn: CamReadings, words: Language) -> Iterator[Node]:
    """Yield the region of permissible axes."""
    said, say, problem = words.cam, words.say, built.design.problem
    plate = problem.contact is Contact.FLAT
    arm, level = (said.told_swung, said.told_plate) if plate else (said.told_arm, said.told_region)
    told = arm if problem.oscillates else level
    yield from steps_of([told.format(scale=say.given(MM * built.scales.region))])
    for number, k in built.drawn.items():
        point = f"D_{{{k}}}"
        if plate:
            line = said.swung_line if problem.oscillates else said.plate_line
            yield from steps_of([line.format(point=point)])
            if problem.oscillates and problem.least:
                yield from steps_of([said.swung_aside.format(point=point)])
            if problem.oscillates:
                yield from steps_of([said.swung_axis])
            continue
        bound = built.bounds[number]
        limit = problem.limit(bound.phase) or 0.0
        angle = say.given(round(90.0 - degrees(limit), 6))
        phase = said["limit_of"][bound.phase.value]
        yield from steps_of([said.limit_line.format(point=point, angle=angle, phase=phase)])
    if not plate:
        yield from steps_of([said.found_axis])
    yield Caption(words.point.read_title.format(profile=words.note["profiles"][drawn.profile.name]))
    yield drawn.table()


def _profile(built: CamConstruction, drawn: CamReadings, words: Language) -> Iterator[Node]:
    """Yield the profile by inverted motion: one position in full, the others as a table."""
    said, say, design = words.cam, words.say, built.design
    problem, mm = design.problem, built.scales.profile
    listed = "; ".join(
        f"{row[1]} = {row[2]} {say.units['mm']}" for row in sizes(design, words).rows
    )
    yield Paragraph(said.told_profile.format(sizes=listed, scale=say.given(MM * mm)))
    plate = problem.contact is Contact.FLAT
    key = "oscillating" if problem.oscillates else "flat" if plate else "translating"
    node = built.nodes[problem.parts // 2]
    k = node.number
    fields: dict[str, Rich] = {
        "k": str(k), "phi": say.given(round(-degrees(node.phi), 4)), "point": f"B_{{{k}}}",
        "radius": say.ruled(drawn.number(f"R_{{{k}}}")),
    }  # fmt: skip
    if problem.oscillates:
        rest = design.geometry.delta0 + float(moved_in(problem, node)[0]) / problem.arm
        fields["delta"] = say.short(degrees(rest), 4)
    elif not plate:
        fields["s"] = say.short(drawn.number(f"s {k}, mm"), 4)
    yield from steps_of([said["inverted"][key].format(**fields)])
    if problem.contact is Contact.ROLLER:
        yield from steps_of([said.envelope])
    exact, rows = np.abs(built.exact_points()), []
    for node, radius in zip(built.nodes, exact, strict=True):
        name = f"R_{{{node.number}}}"
        read, sigma = MM * mm * drawn.number(name), MM * mm * drawn.sigma[name]
        rows.append(
            (
                str(node.number),
                say.given(round(degrees(node.phi), 2)),
                say.number(f"{read:.2f}"),
                say.number(f"{MM * mm * float(radius):.2f}"),
                say.number(sigma_text(sigma)),
            )
        )
    yield table_of(said["profile_heads"], rows, names=0)
    yield Paragraph(drawn.deviation())


class CamNarrator(StepNarrator):
    """Narrator of the steps that integrate the diagrams (рассказчик)."""

    def __init__(self, built: CamConstruction, drawn: CamReadings, words: Language) -> None:
        self.built, self.drawn, self.words, self.said = built, drawn, words, words.cam
        self.step = {step.out: step for step in built.program.steps}

    def part(self, node: CamNode) -> list[Step]:
        """Return the steps of the part that ends at a division."""
        k = node.number
        wanted = (f"m_{{{k}}}", f"v_{{{k}}}")
        outs = [step.out for step in self.built.program.steps]
        first, last = (outs.index(NumberName(name)) for name in wanted)
        read = outs.index(NumberName(f"s_{{{k}}}"))
        return list(self.built.program.steps[first : max(last, read) + 1])

    def _put(self, value: float) -> Rich:
        return self.words.say.short(value + 0.0, 4)

    def lay_off(self, step: steps.LayOff) -> list[Rich]:
        """Describe the mean ordinate of a part."""
        if not step.out.startswith("m_"):
            return []
        size, k = self.drawn.number(step.length), step.out[3:-1]
        return [
            self.said.ordinate.format(
                part=f"{int(k) - 1}–{k}", length=self._put(size), point=step.out
            )
        ]

    def line(self, step: Line) -> list[Rich]:
        """Describe a ray from a pole."""
        if isinstance(step, steps.Join):
            return [self.said.ray.format(ray=step.tail + step.head)]
        return []

    def meet(self, step: steps.MeetLines) -> list[Rich]:
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
                return [self.said.chord.format(start=start, k=k, point=step.out)]
            case "M":
                return [self.said.half.format(point=step.out)]
            case "n":
                return [self.said.across.format(point=step.out)]
            case _:
                return []

    def measure(self, step: Reading) -> list[Rich]:
        """Describe an ordinate that is read."""
        exact = self.words.say.number(f"{self.drawn.number(step.out, exact=True) + 0.0:.2f}")
        length = self.words.say.ruled(self.drawn.number(step.out) + 0.0)
        return [self.said.read_ordinate.format(symbol=step.out, length=length, exact=exact)]
