"""The chapter on forces: loads, groups, lever, reactions, friction (силовой расчёт)."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from math import isfinite

import numpy as np
from msgspec.structs import replace

from planmethod.construct.steps import Name
from planmethod.note.accounts.voice import chain, displayed, sentences
from planmethod.note.compared import percent_text, sigma_text
from planmethod.note.document import (
    Chapter,
    Equations,
    Node,
    Part,
    Table,
    closed,
    table_of_columns,
)
from planmethod.note.formula import Rich, fraction
from planmethod.note.narrate.forces.lever import LeverNarrator, thrust_lines
from planmethod.note.narrate.forces.loads import (
    ForceContext,
    FrictionNarrator,
    LoadNarrator,
    balance_equation,
    bearing_text,
    headed,
    undetermined,
)
from planmethod.note.narrate.forces.moments import MomentNarrator, MomentText
from planmethod.note.narrate.forces.plan import ForcePlanNarrator
from planmethod.note.narrate.forces.springs import SpringNarrator
from planmethod.note.narrate.forces.statement import plan_title
from planmethod.note.narrate.naming import direction_text, mark, scale_inscription
from planmethod.note.numbers import format_column
from planmethod.note.series import balance_series, size_series
from planmethod.note.tables.forces import driven_by, rubbed
from planmethod.note.tables.results import lead_columns
from planmethod.note.wording import MessageTable
from planmethod.plans.forces.board import GivenLoad
from planmethod.plans.forces.polygons import ForcePlan, LoadKind, Moments
from planmethod.plans.model import PlanKind
from planmethod.project.report.context import Report, figure
from planmethod.project.report.drivers import balances
from planmethod.project.report.position import has_turn
from planmethod.render.forces.cut import cut_picture, inner_picture, loads_picture
from planmethod.render.forces.friction import friction_picture
from planmethod.render.forces.polygon import drawn_edges, lever_picture, polygon_picture
from planmethod.render.layout.block import Block, Row
from planmethod.solved.cycle_forces import cycle_forces_of
from planmethod.solved.forces.friction import rubbed_reading
from planmethod.solved.forces.reading import force_reading
from planmethod.solved.forces.statics import bearings_of, statics_of


def friction_part(report: Report, context: ForceContext) -> Iterator[Node]:
    """Yield the friction of the calculated position, and the efficiency of the cycle."""
    if not rubbed(report.one.problem):
        return
    narrator, reading = FrictionNarrator(context, sizes=True), rubbed_reading(report.one, 0)
    texts = narrator.texts
    yield Part(texts.title)
    yield sentences(texts.order, texts.note_sizes)
    yield from chain(
        text
        for pair in narrator.friction.pairs
        for text in (narrator.reach(pair), narrator.size(pair))
    )
    figures = [f"\\ref{{friction_{number}}}" for number in range(len(reading.plans))]
    yield sentences(texts.see_figures.format(figures=report.listed(figures)))
    for number, plan in enumerate(reading.plans):
        yield figure(
            partial(_picture, report, number),
            texts.figure.format(what=plan_title(reading, plan, report.language)),
            f"friction_{number}",
        )
    yield sentences(texts.see_table.format())
    table = narrator.table()
    head = tuple(map(headed, table.head))
    yield replace(table, head=head, name=texts.table, key="friction_table")
    yield sentences(*narrator.results(), *narrator.cycle_lines())


def _picture(report: Report, number: int, letter: float) -> Block:
    return friction_picture(rubbed_reading(report.one, 0), number, letter, report.notation)


GAP = 10.0
"""Between two pictures in a row, mm."""


KINETOSTATICS = (
    "Σ_{i} F_{ix} + Φ_{ix} = 0",
    "Σ_{i} F_{iy} + Φ_{iy} = 0",
    "Σ_{i} M_{O}(\\bar{F}) + Σ_{i} M_{i} + M_{O}(\\bar{Φ}_{i}) + M_{Φi} = 0",
)
"""Equations of equilibrium of a link with its inertia force and couple."""


class ForceChapter:
    """Tells the forces of the calculated position."""

    def __init__(self, report: Report) -> None:
        self.report, self.said = report, report.texts["forces"]
        self.reading = force_reading(report.one, 0)
        self.context = ForceContext(self.reading, report.formulas)
        self.context.texts = report.language.forces
        self.drive = report.one.problem.drive.link
        self.find = report.notation.computed

    def nodes(self) -> Iterator[Node]:
        """Yield the chapter."""
        self.reading.statics.si  # noqa: B018 - errors of drawing come before anything else
        texts: MessageTable = self.said
        yield Chapter(texts.title.format())
        yield Part(texts.loads.format())
        yield from self._loads()
        yield from self._plans()
        yield from self._reactions()
        yield Part(texts.lever.format())
        yield from self._lever()
        yield from friction_part(self.report, self.context)
        if self.report.is_series:
            yield from self._every()

    # Loads ---------------------------------------------------------------------------------------

    def _loads(self) -> Iterator[Node]:
        texts: MessageTable = self.said
        reading, report = self.reading, self.report
        own = report.one.problem.scales.mu_F is None
        scale = scale_inscription(
            reading.scale, report.one.problem.scales.convention, report.notation
        )
        template = texts.about_own if own else texts.about
        yield sentences(template.format(position=report.for_position, scale=scale))
        yield sentences(texts.statics.format())
        yield from map(displayed, closed(KINETOSTATICS))
        yield sentences(texts.statics_vector.format())
        yield figure(
            lambda letter: loads_picture(reading, letter, report.notation),
            texts.loads_figure.format(),
            "loads",
        )
        narrator = LoadNarrator(self.context)
        given = [one for one in reading.statics.board.given if self._acts(one)]
        by_kind = {kind: [one for one in given if one.applied.kind is kind] for kind in LoadKind}
        if by_kind[LoadKind.WEIGHT]:
            yield sentences(texts.weights.format())
            yield from chain(map(narrator.formula, by_kind[LoadKind.WEIGHT]))
        yield from self._inertia(narrator, by_kind[LoadKind.INERTIA])
        couples = by_kind[LoadKind.INERTIA_COUPLE]
        if couples:
            yield sentences(texts.couples.format())
            yield from chain(map(narrator.formula, couples))
            yield sentences(self._senses(couples))
        springs = SpringNarrator(report.one.problem, report.language).equations(report.one, 0)
        if springs:
            yield sentences(report.language.springs.law.format())
            yield from chain(springs)
        for one in reading.statics.board.given:
            if one.applied.kind is LoadKind.EXTERNAL:
                yield sentences(self._external(one))
        dynamics = report.one.problem.dynamics
        links = report.one.problem.mechanism.links
        massless = [link for link in links if dynamics and link not in dynamics.masses]
        if massless and dynamics and dynamics.masses:
            form = texts["massless"]["one" if len(massless) == 1 else "many"]
            yield sentences(form.format(links=report.listed(massless)))

    def _senses(self, couples: list[GivenLoad]) -> Rich:
        """Return the senses of the inertia couples."""
        texts: MessageTable = self.said
        senses: dict[Rich, list[Rich]] = {}
        for one in couples:
            sense = self.context.sense(float(one.applied.couple[0]))
            senses.setdefault(sense, []).append(one.applied.name)
        if len(senses) == 1:
            form = texts["couple_alike"]["one" if len(couples) == 1 else "many"]
            return str(form).format(sense=next(iter(senses)))
        told: list[Rich] = []
        for sense, symbols in senses.items():
            form = "others" if told else "one" if len(symbols) == 1 else "many"
            template = str(texts["couple_sense"][form])
            told.append(template.format(symbols=self.report.listed(symbols), sense=sense))
        return f"{', '.join(told)}."

    def _inertia(self, narrator: LoadNarrator, forces: list[GivenLoad]) -> Iterator[Node]:
        texts: MessageTable = self.said
        shifts = self.reading.statics.board.shifts
        if not forces:
            return
        shifted = any(one.applied.link in shifts for one in forces)
        yield sentences((texts.inertia_shifted if shifted else texts.inertia).format())
        lines = []
        for one in forces:
            lines.append(narrator.formula(one))
            shift = shifts.get(one.applied.link)
            if shift is not None and shift.moment.couple[0]:
                lines += narrator.shifted(one, shift)
        yield from chain(lines)

    def _acts(self, one: GivenLoad) -> bool:
        return bool(one.applied.force[0] or one.applied.couple[0])

    def _external(self, one: GivenLoad) -> Rich:
        texts: MessageTable = self.said
        applied, units = one.applied, self.context.units
        if applied.point is None:
            couple = float(applied.couple[0])
            if not couple:
                return texts.absent_couple.format(symbol=applied.name)
            size = f"{self.find(abs(couple))} {units['N·m']}"
            return texts.couple.format(
                link=self.report.link(applied.link, "on"),
                symbol=applied.name,
                size=size,
                sense=self.context.sense(couple),
            )
        force = complex(applied.force[0])
        if not force:
            return texts.absent.format(symbol=applied.name)
        return texts.force.format(
            link=self.report.link(applied.link, "on"),
            point=applied.point,
            symbol=applied.name,
            size=f"{self.find(abs(force))} {units['N']}",
            way=self.context.direction_phrase(force),
        )

    # Groups --------------------------------------------------------------------------------------

    def _plans(self) -> Iterator[Node]:
        for number, plan in enumerate(self.reading.plans):
            yield from self._plan(plan, number)

    def _plan(self, plan: ForcePlan, number: int) -> Iterator[Node]:
        texts: MessageTable = self.said
        narrator = ForcePlanNarrator(self.context, plan, number)
        moments = MomentNarrator(self.context, plan)
        links = "–".join(plan.links)
        driver = plan.links in {(link,) for link in self.report.one.problem.drive.links}
        yield Part(texts.driver.format(link=links) if driver else texts.group.format(links=links))
        if not number:
            yield sentences(texts.order.format(), *thrust_lines(self.context))
        yield sentences(*narrator.freed())
        if narrator.is_unloaded:
            yield sentences(texts.nothing.format())
            return
        drawn = bool(drawn_edges(self.reading, number))
        keys = {"cut": f"cut_{number}", "plan": f"force_plan_{number}"}
        yield sentences((texts.see if drawn else texts.see_cut).format(**keys))
        yield self._cut(number, links, keys["cut"], driver=driver)
        if not self._readable(*(end for edge in plan.polygon for end in edge.ends)):
            yield sentences(texts.unreadable.format())
            return
        for equation in plan.moments:
            couple = equation.couple
            before = equation.force is not None or (
                couple is None or couple.moment in self.reading.statics.driving_balances
            )
            if before:
                yield from self._moment_equation(moments, equation)
        for balance in plan.balances:
            template = texts["balance"]["one" if len(balance.links) == 1 else "many"]
            yield sentences(template.format(links="–".join(balance.links)))
            summed = balance_equation(
                balance,
                self.context,
                partial(direction_text, notation=self.report.language.notation),
            )
            yield Equations((summed,), numbered=True)
        *steps, _ = narrator.steps()
        form = texts["plan"]["one" if len(plan.balances) == 1 else "many"]
        yield sentences(form.format(), *(line for step in steps for line in step))
        inverse = self.report.names.is_inverse_scale()
        yield sentences((texts.found_inverse if inverse else texts.found).format())
        yield from chain(narrator.force_text(edge) for edge in plan.reactions)
        for _, lines in moments.guides():
            yield sentences(*self._of_guide(lines))
        if drawn:
            yield self._polygon(number, links, keys["plan"], driver=driver)

    def _readable(self, *names: Name) -> bool:
        hand = self.reading.statics.ruler_reading
        return all(hand.has(name)[0] for name in names)

    @staticmethod
    def _of_guide(lines: list[Rich]) -> list[Rich]:
        """Return the sentences on the place of a guide's force, each ended."""
        return [line if line.endswith((".", ":", ",", ";")) else f"{line}." for line in lines]

    def _moment_equation(self, narrator: MomentNarrator, equation: Moments) -> Iterator[Node]:
        texts: MessageTable = self.said
        equation_text: MomentText | None = narrator.equation_text(equation)
        if equation_text is None:
            return
        template = texts.moments if len(equation.links) == 1 else texts.moments_links
        yield sentences(template.format(point=equation.about, links=", ".join(equation.links)))
        whose = f"Σ_{{{','.join(equation.links)}}}M"  # it is in the sentence before
        summed, _, zero = equation_text.equation.replace(whose, "ΣM", 1).partition(": ")
        yield displayed(f"{summed}.")
        if zero:  # the equation without moments
            yield sentences(texts.no_moments.format(point=equation.about))
            yield from chain([zero])
        lead = texts.hence.format()
        if equation_text.arms:
            arms = texts.arms if len(equation_text.arms) > 1 else texts.arms_one
            lead = arms.format(arms="; ".join(equation_text.arms))
        if equation_text.length:
            yield sentences(texts.length.format(length=equation_text.length))
        if equation_text.result:
            yield sentences(lead)
            yield from chain([equation_text.result.replace(whose, "ΣM", 1)])
        if equation.force is None and equation.couple is None:
            yield sentences(self.context.texts.in_balance)

    def _cut(self, number: int, links: Rich, key: str, *, driver: bool) -> Node:
        reading, notation = self.reading, self.report.notation

        def picture(letter: float) -> Block:
            whole = cut_picture(reading, number, letter, notation)
            inner = inner_picture(reading, number, letter, notation)
            return whole if inner is None else Row([whole, inner[1]], GAP, "centre")

        caption = self.said["figure_cut_driver" if driver else "figure_cut"]
        return figure(picture, caption.format(links=links, link=links), key, height=150.0)

    def _polygon(self, number: int, links: Rich, key: str, *, driver: bool) -> Node:
        reading, notation = self.reading, self.report.notation
        scale = scale_inscription(
            reading.plan_scale(number), self.report.one.problem.scales.convention, notation
        )
        caption = self.said["figure_plan_driver" if driver else "figure_plan"]
        return figure(
            lambda letter: polygon_picture(reading, number, letter, notation),
            caption.format(links=links, link=links, scale=scale),
            key,
            height=120.0,
        )

    # Results -------------------------------------------------------------------------------------

    def _reactions(self) -> Iterator[Node]:
        said: MessageTable = self.said
        report, statics, notation = self.report, self.reading.statics, self.report.notation
        rows = [
            (
                mark(joint.joint),
                series.symbol,
                *notation.numbers(
                    one.read_text, one.exact_text, one.percent_text(2), one.sigma_text
                ),
            )
            for joint in statics.reactions
            for series in [size_series(statics, joint)]
            for one in [series[0]]
        ]
        yield Part(said.table_part.format())
        yield sentences(said.reactions.format())
        yield Table(
            tuple(text.format() for text in said["columns_reactions"]),
            tuple(rows),
            2,
            name=said.reactions_table.format(position=report.in_position),
            key="reactions",
        )
        yield from report.mark_note(rows)
        yield from map(sentences, self._out_of_plane())
        words = report.language.note
        yield from map(sentences, driven_by(report.one.problem, words))
        balancing, unit = self.reading.balancing, report.unit(self.reading.balancing.unit)
        balance, thrust = balance_series(statics), statics.thrust
        drive = report.one.problem.drive
        template = said.balancing_thrust if thrust else said["balancing"][balancing.quantity]
        one, two = drive.motor or ("", "")
        template = said.balancing_motor if statics.motor is not None else template
        if drive.other_drives and thrust is None and statics.motor is None:
            template = said["balancing_of"][balancing.quantity]
        yield sentences(
            str(template).format(
                link=drive.link,
                line="" if thrust is None else "".join(map(mark, thrust.ends)),
                one=one,
                two=two,
                symbol=self.context.symbol(balance.symbol),
                value=f"{self.find(abs(balance.read[0]))} {unit}",
                exact=f"{self.find(abs(balance.exact[0]))} {unit}",
            ),
            *(
                str(said["balancing_of"][other.balancing.quantity]).format(
                    link=other.link,
                    symbol=symbol,
                    value=f"{self.find(abs(read))} {report.unit(other.balancing.unit)}",
                    exact=f"{self.find(abs(exact))} {report.unit(other.balancing.unit)}",
                )
                for other, symbol, read, exact in balances(report, self.reading)
            ),
        )

    def _out_of_plane(self) -> Iterator[Rich]:
        """Yield the loads of the bearings, and the indeterminate out-of-plane forces."""
        solution, texts = self.report.one, self.report.language.note
        for joint in self.reading.statics.reactions:
            if (shared := bearings_of(self.reading.statics, joint)) is not None:
                yield bearing_text(solution, joint, shared, abs(complex(joint.force[0])), texts)
        yield from undetermined(reversed(solution.structure.groups), texts)

    # Lever ---------------------------------------------------------------------------------------

    def _lever(self) -> Iterator[Node]:
        texts: MessageTable = self.said
        report, reading, statics = self.report, self.reading, self.reading.statics
        lever = statics.lever_at(reading.index)
        if lever is None:
            yield sentences(texts.lever_stands.format())
            return
        if not self._readable(lever.balance):
            yield sentences(texts.unreadable.format())
            return
        narrator = LeverNarrator(self.context)
        template = texts.lever_about if reading.balancing.turns else texts.lever_about_force
        template = template if statics.thrust is None else texts.lever_about_thrust
        template = template if statics.motor is None else texts.lever_about_motor
        about = template.format(pole=report.names.pole(PlanKind.VELOCITY))
        others = [one.link for one in report.one.problem.drive.other_drives]
        known = texts.lever_others.format(links=report.listed(others)) if others else ""
        yield sentences(about, known, *narrator.larger())
        yield figure(
            lambda letter: lever_picture(reading, letter, report.notation),
            texts.lever_figure.format(position=report.in_position),
            "lever",
        )
        if not narrator.lever.forces and not narrator.lever.couples:
            symbol = self.context.symbol(reading.balancing_symbol)
            yield sentences(texts.lever_no_work.format(symbol=symbol))
            return
        segments = narrator.segments()
        yield sentences(
            texts.lever_pairs.format(segments="; ".join(segments)) if segments else "",
            texts.lever_equation.format(),
        )
        yield displayed(f"{narrator.equation()}.")
        for shift in narrator.lever.shifts:
            yield from chain([narrator.shift(shift)])
        arms = narrator.arms()
        yield sentences(texts.lever_arms.format(arms=arms) if arms else texts.hence.format())
        yield from chain([narrator.result()])
        yield from self._compared(narrator)

    def _compared(self, narrator: LeverNarrator) -> Iterator[Node]:
        texts: MessageTable = self.said
        notation, both = self.report.notation, narrator.compared
        symbol, unit = narrator.balancing, narrator.unit
        plans, lever = (self.find(abs(value)) for value in (both.exact, both.read))
        found = {"plans": f"{plans} {unit}", "lever": f"{lever} {unit}"}
        yield sentences(texts.lever_found.format(symbol=symbol, **found))
        if both.percent is not None:
            share_of = fraction(f"|{lever} − {plans}|", plans)
            sides = f"{share_of}·100 % = {notation.number(percent_text(both.percent_size))} %"
            yield displayed(f"Δ = {sides}.")
        if isfinite(both.sigma):
            text = f"{notation.number(sigma_text(both.sigma))} {unit}"
            if both.expected is not None:
                part = notation.number(percent_text(both.expected))
                yield sentences(texts.lever_expected.format(sigma=text, share=part))
            else:
                yield sentences(texts.lever_expected_alone.format(sigma=text))

    # All positions -------------------------------------------------------------------------------

    def _every(self) -> Iterator[Node]:
        texts: MessageTable = self.said
        report, every = self.report, self.report.every
        statics = statics_of(every)
        if not statics.closes.all():
            return
        lead = lead_columns(every.problem, report.project.positions, report.language.note)
        columns: list[list[Rich]] = []
        for joint in statics.reactions:
            sizes = format_column(np.abs(joint.force).tolist())
            columns.append([report.reaction(joint), *map(report.notation.number, sizes)])
        drive = every.problem.drive
        symbol = self.context.symbol(every.problem.balancer.symbol)
        balance = [report.notation.number(text) for text in format_column(statics.balance.tolist())]
        columns.append([f"{symbol}, {report.unit(drive.balancing.unit)}", *balance])
        yield Part(texts.all.format())
        quantity = drive.balancing.quantity
        rubs = rubbed(report.every.problem)
        without = texts.all_without.format() if rubs else ""
        yield sentences(str(texts["all_text"][quantity]).format(without=without))
        table = table_of_columns([*lead, *columns], repeated=len(lead))
        name = str(texts["all_table"][quantity]).format()
        yield Table(table.head, table.rows, 0, len(lead), name=name, key="all_reactions")
        yield sentences(*largest_reactions(report))


def largest_reactions(report: Report) -> Iterator[Rich]:
    """Yield the largest reaction of the positions, and that of the cycle, as sheets have it."""
    statics = statics_of(report.every)
    if not report.is_series or not statics.closes.all():
        return
    texts: MessageTable = report.texts["forces"]
    find, unit = report.notation.computed, report.unit("N")
    sizes = {report.reaction(joint): np.abs(joint.force) for joint in statics.reactions}
    symbol = max(sizes, key=lambda one: float(sizes[one].max()))
    k = int(sizes[symbol].argmax())
    value = find(float(sizes[symbol][k]))
    facts = {"symbol": symbol, "value": f"{value} {unit}", "number": k}
    if not has_turn(report):
        yield texts.all_peaks.format(**facts)
        return
    curves = cycle_forces_of(report.every)
    peaks = [curves.peak(number) for number in range(len(curves.joints))]
    number = max(range(len(peaks)), key=lambda one: peaks[one].size)
    most, whose = peaks[number], report.reaction(curves.joints[number])
    if (whose, find(most.size)) == (symbol, value):
        yield texts.cycle_peaks.format(**facts)
        return
    yield texts.all_peaks.format(**facts)
    yield (texts.between_limit if most.is_limit else texts.between).format(
        symbol=whose, value=f"{find(most.size)} {unit}", place=_between(most.position, report)
    )


def _between(position: float, report: Report) -> Rich:
    """Return the positions that enclose a position of the crank, with its angle."""
    places = report.project.positions
    step = places[1] - places[0]
    before = int((position - places[0]) / step % len(places))
    angle = f"{report.coordinate} = {report.degrees(round(position % 360.0) % 360)}"
    facts = {"one": before, "other": (before + 1) % len(places), "angle": angle}
    return str(report.texts["forces"]["between_positions"]).format(**facts)
