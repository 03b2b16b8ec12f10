"""The velocity and the acceleration plan of the calculated position (планы скоростей, ускорений).

The steps of the construction are described group by group: the equations, the laid-off lengths
with their formulas, the lines that intersect, the measurements, and their results.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from msgspec.structs import replace

from planmethod.construct import steps
from planmethod.construct.steps import Compute, LineName, PointName, Step
from planmethod.mechanism.model import FRAME
from planmethod.note.accounts.voice import chain, displayed, lettered, sentences
from planmethod.note.document import Equations, Formula, Node, Paragraph, Part, input_text
from planmethod.note.formula import Rich, capitalized
from planmethod.note.narrate.equations import is_unjoined, known_directions
from planmethod.note.narrate.naming import (
    detail_view_letter,
    direction_text,
    view_name,
)
from planmethod.note.wording import MessageTable
from planmethod.plans.build import Section
from planmethod.plans.model import RATES, DimensionKind, PlanKind, Relation
from planmethod.plans.motion.legs import Relative
from planmethod.project.report.context import Report, figure
from planmethod.project.report.drivers import beginning
from planmethod.render.layout.block import Block
from planmethod.render.pictures.planview import PictureStyle, detail_pictures, plan_picture


class PlanChapter:
    """Tells one plan of the calculated position."""

    def __init__(self, report: Report, kind: PlanKind) -> None:
        self.report, self.kind = report, kind
        self.texts: MessageTable = report.texts["plan"]
        self.names, self.narrator, self.say = report.names, report.narrator, report.formulas
        self.plan = report.one.construction.plan(kind)
        self._drawing: list[Rich] = []
        self._measured: list[Rich] = []
        self._formulas: list[Rich] = []
        self._senses: list[Rich] = []
        self._keys: dict[PointName, str] = {}

    def nodes(self) -> Iterator[Node]:
        """Yield the part."""
        texts, kind, position = self.texts, self.kind.value, self.report.of_position
        scale = self.report.scale(self.kind)
        yield Part(str(texts["part"][kind]).format())
        assert self.plan.pole is not None
        fixed = self.names.further_letters(self.plan.pole)
        pole = self.names.pole(self.kind)
        form = texts["pole_one" if len(fixed) == 1 else "pole"][kind]
        text = str(form).format(pole=pole, points=self.report.listed(fixed or [""]))
        yield sentences(
            str(texts["scale"][kind]).format(position=position, scale=scale),
            text if fixed else texts.bare_pole.format(pole=pole),
        )
        yield from self._figures()
        sections = [s for s in self.report.one.construction.sections if s.kind is self.kind]
        for section in sections:
            yield from self._section(section)

    def _section(self, section: Section) -> Iterator[Node]:
        texts, drives = self.texts, self.report.one.problem.drive.every
        made = {PointName(step.out) for step in section.steps}
        if section.group is None:
            yield sentences(*beginning(self.report, drives, self.kind))
        else:
            lead = [texts.group.format(links="–".join(section.group.links))]
            yield sentences(*lead, *self._known_turning(section), *self._coincident(section))
            if is_unjoined(self.report.one.problem, section.group):
                links = "–".join(section.group.links)
                yield sentences(self.report.language.note.unjoined.format(links=links))
            yield from self._equations(made)
            if self.kind is PlanKind.ACCELERATION:
                without = self.narrator.motion.without_coriolis(made)
                if without:
                    yield sentences(*without)
        for step in section.steps:
            yield from self._step(step)
        yield from self._flush()
        undrawn = self.narrator.undrawn(section.steps)
        if undrawn:
            yield sentences(*undrawn)

    # Before the drawing --------------------------------------------------------------------------

    def _known_turning(self, section: Section) -> Iterator[Rich]:
        """Yield the known rotations of links of a group, with the velocities."""
        assert section.group is not None
        if self.kind is not PlanKind.VELOCITY:
            return
        omega = self.names.kinematics.omega
        own = {step.out for step in section.steps}
        for link in section.group.links:
            if link not in omega:
                yield self.texts.translating.format(link=link)
                continue
            other = self.names.owner(omega[link])
            if other != link and (omega[link] not in own or other in section.group.links):
                symbols = {"symbol": f"ω_{{{link}}}", "same": f"ω_{{{other}}}"}
                yield self.texts.shared.format(link=link, other=other, **symbols)

    def _coincident(self, section: Section) -> Iterator[Rich]:
        """Yield the coincident points of two links."""
        assert section.group is not None
        if self.kind is not PlanKind.VELOCITY:
            return
        for relative in self.names.kinematics.relatives.values():
            inside = {relative.of, relative.to} & {*section.group.links}
            if not inside:
                continue
            if relative.to == FRAME:
                yield from self._on_frame(relative)
                continue
            head, tail = (self._capital(point) for point in (relative.head, relative.start))
            if head and tail and head != tail:
                yield self.texts.coincident.format(
                    head=head, of=relative.of, tail=tail, to=relative.to
                )

    def _on_frame(self, relative: Relative) -> Iterator[Rich]:
        """Yield that a point moves along a fixed guide, and the name of the point under it."""
        for equation in self.plan.equations:
            for term in equation.right:
                ends = (term.tail, term.head)
                if ends == (relative.start, relative.head) and term.direction is not None:
                    index = term.symbol.partition("_{")[2].removesuffix("}")
                    tail = index.removeprefix(relative.point)
                    yield self.texts.on_frame.format(
                        head=relative.point,
                        of=relative.of,
                        guide=self.names.base(term.direction),
                        tail=lettered(tail),
                    )
                    return

    def _capital(self, point: PointName) -> Rich:
        """Return a point of the mechanism by its letter on the plan: ``a_{3}`` for A3."""
        if self.names.point(point) == self.names.pole(self.kind):
            return ""
        return capitalized(self.names.point(point).replace("′", ""))

    def _equations(self, drawn_heads: set[PointName]) -> Iterator[Node]:
        found = [one for one in self.names.stated(self.kind) if one.head in drawn_heads]
        if not found:
            return
        heads = list(dict.fromkeys(self._capital(one.head) for one in found))
        form = "one" if len(found) == 1 else "pair" if len(heads) == 1 else "many"
        form = "joint" if len(found) == 1 and found[0].is_joint else form
        template = str(self.texts["equations"][self.kind.value][form])
        yield sentences(template.format(points=self.report.listed(heads)))
        directed = partial(direction_text, notation=self.report.language.notation)
        known = known_directions(self.names.construction, self.report.one.problem, self.kind)
        # A note has numbers of its own, one for a system.
        equations = tuple(replace(one, number=0).written(directed, known) for one in found)
        key = f"equations_{found[0].number}" if found[0].number else ""
        self._keys.update(dict.fromkeys((one.head for one in found), key))
        yield Equations(equations, numbered=True, key=key)
        if self.kind is PlanKind.VELOCITY and found[0].head == self._first:
            yield sentences(self.texts.legend.format())

    @property
    def _first(self) -> PointName | None:
        """The point after whose equations the underlines are explained."""
        sections = self.report.one.construction.sections
        own = {
            PointName(step.out)
            for section in sections
            if section.kind is self.kind and section.group is not None
            for step in section.steps
        }
        heads = (one.head for one in self.names.stated(self.kind))
        return next((head for head in heads if head in own), None)

    # Steps ---------------------------------------------------------------------------------------

    def _step(self, step: Step) -> Iterator[Node]:
        names = self.names
        if not self.say.readable(step.out) and not self.narrator.is_reading(step):
            lines = self.narrator.narrate(step)
            if lines:
                yield from self._flush()
                yield sentences(*lines)
            return
        match step:
            case steps.LayOffLength():
                yield from self._flush()
                yield from self._explain_lay_off(step)
            case steps.IntersectLines():
                yield from self._flush()
                yield sentences(self._meet(step))
            case steps.Similar():
                yield from self._flush()
                yield from self._similar(step)
            case steps.Measure() | steps.MeasureAlong():
                segment = names.segment(step.tail, step.head)
                on_plan = step.tail in names.letters
                read = input_text(abs(self.say.number(step.out)), self.report.language.note, 5)
                text = f"{segment} = {read}"
                text = f"{text} {self.report.unit('mm')}"
                (self._measured if on_plan else self._drawing).append(text)
            case Compute():
                yield from self._computed(step)
            case _:
                pass

    def _computed(self, step: Compute) -> Iterator[Node]:
        """Store a number computed from measurements."""
        found = self.narrator.motion.result_formulas(step)
        kind = next((k for k in RATES if step.out in self.names.kinematics.rates(k).values()), None)
        if kind is None:
            self._formulas += found
            return
        # The sense has a sentence of its own.
        self._formulas.append(found[0].rpartition(", ")[0] if self.say.number(step.out) else "")
        self._formulas = [text for text in self._formulas if text]
        read = self.names.kinematics.turnings[kind, self.names.owner(step.out)]
        segment, symbol = self.names.segment(read.start, read.head), self.names.symbol(step.out)
        value = self.say.number(step.out)
        if not value:
            self._senses.append(self.texts.zero.format(segment=segment, symbol=symbol))
            return
        note = self.report.language.note
        self._senses.append(
            str(self.texts["turning"][self.kind.value]).format(
                link=self.names.owner(step.out),
                segment=segment,
                place=read.place,
                joint=read.joint,
                sense=note.ccw if value > 0 else note.cw,
                symbol=symbol,
            )
        )
        yield from ()

    def _flush(self) -> Iterator[Node]:
        """Yield the stored measurements and their results, and clear them."""
        texts = self.texts
        if self._drawing:
            yield sentences(texts.on_drawing.format(segments=self.report.listed(self._drawing)))
        if self._measured:
            template = str(texts["on_plan" if self._formulas else "measured"][self.kind.value])
            yield sentences(template.format(segments=self.report.listed(self._measured)))
        elif self._formulas:
            yield sentences(texts.computed.format())
        yield from chain(self._formulas)
        if self._senses:
            yield sentences(*self._senses)
        for kept in (self._drawing, self._measured, self._formulas, self._senses):
            kept.clear()

    def _explain_lay_off(self, step: steps.LayOffLength) -> Iterator[Node]:
        *formulas, sentence = self.narrator.motion.describe_laid_off_length(step)
        vector = self.names.vector(step.origin, step.out)
        if formulas and vector is not None:
            kinds: MessageTable = self.texts["kinds"][self.kind.value]
            template = kinds.get(vector.kind.value, kinds.usual)
            towards = vector.direction
            ends = ("", "")
            if towards is not None and towards.relation is Relation.TOWARDS:
                ends = (towards.points[0], towards.points[1])
            yield sentences(template.format(symbol=vector.symbol, tail=ends[0], head=ends[1]))
        elif formulas:
            yield sentences(self.texts.computed.format())
        where = self._new_letters(step)
        for k, text in enumerate(formulas, 1):
            last = k == len(formulas)
            end = "," if last and where else "." if last else ","
            yield displayed(f"{text}{end}") if k == 1 else Formula(f"{text}{end}")
        if where:
            yield sentences(self.report.texts.where.format(facts="; ".join(where)))
        yield sentences(sentence)

    def _new_letters(self, step: steps.LayOffLength) -> list[Rich]:
        """Return explanations of the letters of a product that are new."""
        length = self.names.step[step.length]
        assert isinstance(length, Compute)
        made = self.names.step[length.powers[0][0]]
        if not isinstance(made, Compute):
            return []
        found, kinematics = [], self.names.kinematics
        dimensions = self.names.construction.draft.dimensions
        describe: MessageTable = self.texts["describe"]
        for name, _ in made.powers:
            symbol = self.names.symbol(name)
            if symbol in self.report.described:
                continue
            self.report.described.add(symbol)
            told = dimensions.get(name)
            if name in kinematics.omega.values():
                found.append(describe.omega.format(symbol=symbol, of=self.names.owner(name)))
            elif name in kinematics.epsilon.values():
                found.append(describe.epsilon.format(symbol=symbol, of=self.names.owner(name)))
            elif told is not None and told.kind is DimensionKind.LENGTH:
                of = symbol.partition("_{")[2].removesuffix("}")
                found.append(describe.length.format(symbol=symbol, of=lettered(of)))
            elif any(name == relative.speed for relative in kinematics.relatives.values()):
                found.append(describe.sliding.format(symbol=symbol))
        return found

    def _meet(self, step: steps.IntersectLines) -> Rich:
        first, second = (self._ray(line) for line in (step.first, step.second))
        met = self.texts.rays.format(
            first=first,
            second=second,
            point=self.names.point(step.out),
            coincide=self.narrator.coincide(step.out),
        )
        key = self._keys.get(step.out)
        return " ".join((met, *self.names.solved([f"(\\ref{{{key}}})"] if key else [])))

    def _ray(self, name: LineName) -> Rich:
        """Return a line that is drawn on the plan, and its vector."""
        step, texts = self.names.step[name], self.texts
        ray = self.names.ray(name)
        carried = "" if ray is None else texts.carried.format(symbol=ray.symbol)
        if isinstance(step, steps.Join):
            base = self.names.direction(name).base
            return texts.ray_join.format(base=base, carried=carried)
        assert isinstance(step, steps.Parallel | steps.Perpendicular | steps.AtAngle)
        base, angle = self.narrator.motion.direction(name, ray)
        line = texts["from"].format(of=self.names.of(step.through))
        if angle in (0.0, 180.0):
            return texts.ray.format(line=line, base=base, carried=carried)
        if abs(angle) == 90.0:
            return texts.ray_across.format(line=line, base=base, carried=carried)
        text = input_text(abs(angle), self.report.language.note)
        return texts.ray_angled.format(line=line, base=base, angle=text, carried=carried)

    def _similar(self, step: steps.Similar) -> Iterator[Node]:
        *formulas, sentence = self.narrator.motion.describe_similar_point(step)
        point = self.names.point(step.out)
        if formulas:
            parts = [text.rstrip(".,") for text in formulas]
            if len(parts) > 1:
                figures = " ∼ ".join(f"△{c}" for c in self.narrator.motion.triangles(step))
                yield sentences(self.texts.similar_triangle.format(point=point, figures=figures))
            else:
                yield sentences(self.texts.similar.format(point=point))
            yield from chain(parts)
        yield sentences(sentence)

    # Figures -------------------------------------------------------------------------------------

    def _figures(self) -> Iterator[Node]:
        solution, kind, language = self.report.one, self.kind, self.report.language
        knots = solution.detail_views_at(kind, 0)
        letters = tuple(detail_view_letter(detail_view, language) for detail_view in knots)
        by_hand = True

        def plan(letter: float) -> Block:
            return plan_picture(
                solution, kind, 0, PictureStyle(letter), use_ruler=by_hand, detail_letters=letters
            )

        scale, position = self.report.scale(kind), self.report.of_position
        caption = str(self.texts["figure"][kind.value]).format(position=position, scale=scale)
        yield figure(plan, caption, kind.value)
        if not knots:
            return
        views = [view_name(detail_view, language) for detail_view in knots]
        keys = [f"{kind.value}_{number}" for number in range(len(views))]
        told = [
            self.texts.enlarged_at.format(view=view, key=key)
            for view, key in zip(views, keys, strict=True)
        ]
        yield Paragraph(self.texts.enlarged_note.format(views=self.report.listed(told)))
        for number, view in enumerate(views):

            def enlarged(letter: float, number: int = number) -> Block:
                pictures = detail_pictures(
                    solution, kind, 0, letter_height=letter, use_ruler=by_hand
                )
                return pictures[number]

            yield figure(
                enlarged,
                str(self.texts["enlarged"][kind.value]).format(view=view),
                keys[number],
                height=80.0,
                grows=False,
            )
