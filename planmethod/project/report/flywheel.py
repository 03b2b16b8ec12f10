"""Chapters on the flywheel and on static balancing (маховик, уравновешивание)."""

from __future__ import annotations

from collections.abc import Iterator

from msgspec.structs import replace

from planmethod.note.accounts.machine import MachineAccount, machine_narrator
from planmethod.note.accounts.voice import NOTE, sentences
from planmethod.note.document import Chapter, Figure, Node
from planmethod.note.formula import Rich
from planmethod.note.narrate.balancing import BalancingNarrator
from planmethod.note.narrate.machine import MachineNarrator
from planmethod.note.numbers import in_heads
from planmethod.note.wording import MessageTable
from planmethod.project.report.context import PictureDrawer, Report, figure, of_sheet
from planmethod.project.settle import SPEED_TOLERANCE, quick_shaft
from planmethod.render.pictures.flywheel import construction_picture

TEXT_WIDTH = 240.0
"""Width of the texts of the sheet, which its diagrams are measured by, mm."""

WHEEL_TEXT_WIDTH = 130.0
"""Width of the texts beside the flywheel, mm."""

HEIGHTS = {"machine_diagrams": 190.0}
"""Greatest heights of figures, mm; of others 90."""


def machine_of(report: Report) -> MachineNarrator:
    """Return the narrator of the machine of a project."""
    return machine_narrator(report.every, report.language)


def flywheel_chapter(report: Report) -> Iterator[Node]:
    """Yield the chapter."""
    narrator = machine_of(report)

    def illustrate(key: str, caption: Rich) -> Figure:
        return figure(_drawer(report, narrator, key), caption, key, height=HEIGHTS.get(key, 90.0))

    account = MachineAccount(narrator, replace(NOTE, illustrate=illustrate))
    yield from account.chapter(_quick_shaft(report, narrator))


def _drawer(report: Report, narrator: MachineNarrator, key: str) -> PictureDrawer:
    """Return what draws the figure of a key of the account."""
    if key == "machine_diagrams":
        return lambda letter: construction_picture(narrator.drawing, narrator, letter)
    kinds = {
        "load": ("load-diagram", TEXT_WIDTH),
        "speed": ("speed-diagram", TEXT_WIDTH),
        "wheel": ("flywheel", WHEEL_TEXT_WIDTH),
    }
    kind, column = kinds[key]
    return of_sheet(kind, report.every, report.language, column=column)


def _quick_shaft(report: Report, narrator: MachineNarrator) -> tuple[str, float] | None:
    """Return the fast shaft of the train with its speed ratio, where the flywheel is not on it."""
    shaft = quick_shaft(report.project)
    if shaft is None:
        return None
    ratio = shaft[1] / narrator.flywheel.machine.wheel.ratio
    return None if abs(ratio - 1.0) <= SPEED_TOLERANCE else shaft


BALANCING_TEXT_WIDTH = 180.0
"""Width of the texts of the sheet, mm."""


def balancing_chapter(report: Report) -> Iterator[Node]:
    """Yield the chapter."""
    texts: MessageTable = report.texts["weights"]
    narrator = BalancingNarrator(report.every, report.language)
    first, *others = narrator.lines()
    yield Chapter(texts.title.format())
    yield sentences(texts.about.format(), f"{first}.")
    for line in others[:-2]:
        yield sentences(f"{line}.")
    for kind in ("balanced-scheme", "mass-polygons"):
        made = of_sheet(kind, report.every, report.language, column=BALANCING_TEXT_WIDTH)
        yield figure(made, str(texts["figures"][kind]).format(), kind.replace("-", "_"))
    yield sentences(texts.weights_text.format(), *(f"{line}." for line in others[-2:]))
    (_, unit, links), *numbers = narrator.weights()
    weights = [(texts.link.format(), unit, links), *numbers]
    heads = in_heads(weights, report.notation)
    yield from NOTE.table(heads, narrator.texts.weights_table, "weights", repeated=1)
    yield sentences(texts.forces_text.format())
    heads = in_heads(narrator.columns(), report.notation)
    yield from NOTE.table(heads, narrator.texts.forces_table, "inertia", repeated=2)
    made = of_sheet(
        "inertia-hodographs", report.every, report.language, column=BALANCING_TEXT_WIDTH
    )
    yield figure(made, texts.hodographs.format(), "inertia_hodographs", height=90.0)
