"""Driving links in the note: one, or several with their superposition (начальные звенья)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from msgspec.structs import replace

from planmethod.mechanism.model import FRAME
from planmethod.mechanism.structure import pairs
from planmethod.note.accounts.voice import sentences
from planmethod.note.document import Node, Part
from planmethod.note.formula import Rich
from planmethod.note.tables.superposition import superposition_table
from planmethod.note.wording import MessageTable
from planmethod.plans.model import PlanKind
from planmethod.problem.model import Drive
from planmethod.project.report.context import PictureDrawer, Report, figure
from planmethod.render.layout.block import Block
from planmethod.render.pictures.planview import PictureStyle, plan_picture
from planmethod.solved.forces.reading import ForceReading
from planmethod.solved.solution import Solution
from planmethod.solved.superposition import parts_by_driver


def named_links(report: Report) -> Rich:
    """Return the numbers of all driving links: ``1 and 4``."""
    return report.listed(report.one.problem.drive.links)


def given_motion(report: Report) -> Rich:
    """Return the sentence on the driving links, whose motions determine all others."""
    texts: MessageTable = report.texts["structure"]
    links, structure = report.one.problem.mechanism.drivers, report.one.structure
    if structure.mobility - structure.local_mobility == 1:
        template: Rich = texts.one_driver
        return template.format(role=report.role(links[0]), link=links[0])
    template = texts.drivers
    return template.format(w=structure.mobility, links=report.listed([*map(report.link, links)]))


def primary_mechanisms(report: Report) -> Rich:
    """Return the sentence on the drivers without the groups (первичный механизм)."""
    texts: MessageTable = report.texts["structure"]
    mechanism, rest = report.one.problem.mechanism, texts["rest"]
    named = []
    for link in mechanism.drivers:
        ends = {FRAME, link}
        kind = next(pair.kind for pair in pairs(mechanism) if set(pair.links) == ends)
        facts = {"role": report.role(link), "link": link, "frame": report.project.frame}
        named.append(rest["primary"].format(pair=texts["pair"][kind.value], **facts))
    form = "one" if len(report.one.structure.groups) == 1 else "many"
    form = form if len(named) == 1 else "drivers"
    return str(rest[form]).format(primary="; ".join(named))


def beginning(report: Report, drives: Sequence[Drive], kind: PlanKind) -> list[Rich]:
    """Return the sentences with which a plan begins: whose motion is given, and how."""
    texts: MessageTable = report.texts["plan"]
    drive = drives[0]
    if len(drives) > 1:
        lead: list[Rich] = [texts.drivers.format(links=named_links(report))]
    else:
        lead = [(texts.driver if drive.is_crank else texts.driver_slider).format(link=drive.link)]
    even = [one for one in drives if one.is_crank and not one.accelerates]
    if kind is PlanKind.ACCELERATION and even:
        several = [texts.constant_of.format(link=one.link) for one in even]
        lead += several if len(drives) > 1 else [texts.constant.format()]
    return lead


def superposition_part(report: Report) -> Iterator[Node]:
    """Yield the velocities as sums of those that each driver alone gives (наложение)."""
    solution = report.one
    if not solution.problem.drive.other_drives:
        return
    texts: MessageTable = report.texts["superposition"]
    parts = parts_by_driver(solution)
    keys = {link: f"velocity_of_{link}" for link in parts}
    told = [texts.shown.format(link=link, key=key) for link, key in keys.items()]
    yield Part(texts.part.format())
    yield sentences(texts.about.format(), texts.figures.format(figures=report.listed(told)))
    for link, part in parts.items():
        alone = part.drawn_at(solution.scales)
        caption = texts.figure.format(link=link, scale=report.scale(PlanKind.VELOCITY))
        yield figure(_plan_of(alone), caption, keys[link])
    table = superposition_table(solution, report.language.note, 0)
    yield sentences(texts.summed.format())
    name = texts.table.format(position=report.in_position)
    yield replace(table, name=name, key="superposition")


def _plan_of(solution: Solution) -> PictureDrawer:
    """Return the function that draws the velocity plan of a solution."""

    def draw(letter: float) -> Block:
        return plan_picture(solution, PlanKind.VELOCITY, 0, PictureStyle(letter))

    return draw


def balances(report: Report, reading: ForceReading) -> Iterator[tuple[Drive, Rich, float, float]]:
    """Yield each other driver with the letter of its balance: as read by hand, and exact."""
    problem, statics = report.one.problem, reading.statics
    for other, driving in zip(problem.drive.other_drives, statics.other_driving, strict=True):
        exact = float(statics.other_balances[other.link][reading.index])
        symbol = report.notation.symbol(problem.balancer_of(other))
        yield other, symbol, reading.read_number(driving.balance), exact
