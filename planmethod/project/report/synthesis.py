"""The chapter on synthesis: sizes by formulas and by construction (синтез механизма)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from planmethod.note.accounts.voice import Voice, VoiceForm
from planmethod.note.document import Figure, GivenFact, Node
from planmethod.note.formula import Rich
from planmethod.note.narrate.synthesis import given_data, size_symbol
from planmethod.note.numbers import with_unit
from planmethod.note.synthesis.account import SynthesisAccount
from planmethod.note.synthesis.drawing import construction_of
from planmethod.project.report.context import Report, figure
from planmethod.render.sheets.synthesis import construction_picture


def synthesis_chapter(report: Report) -> Iterator[Node]:
    """Yield the chapter."""
    drawn, language = construction_of(report.every), report.language

    def illustrate(key: str, caption: Rich) -> Figure:
        return figure(lambda letter: construction_picture(drawn, language, letter), caption, key)

    voice = Voice(VoiceForm.NOTE, illustrate)
    yield from SynthesisAccount.of(report.every, language, voice).chapter()


def datum_name(fact: GivenFact, texts: Mapping[str, Any]) -> Rich | None:
    """Return the name of a given number of a synthesis; None of another fact."""
    names: Mapping[str, Rich] = texts["quantities"]["synthesis"]
    keys = (key.removeprefix("synthesis.") for key in fact.data if key.startswith("synthesis."))
    return next((names[key] for key in keys if key in names), None)


def synthesis_result(report: Report) -> Rich:
    """Return the result of the synthesis for the conclusion."""
    problem, notation = report.one.problem, report.notation
    task, made = problem.synthesis, construction_of(report.every).synthesis
    assert task is not None
    told = given_data(
        task.kind, task.data, report.language, letters=task.letters, unit=problem.unit
    )
    used = {size: value for size, value in made.metres().items() if not _is_datum(size, report)}
    sizes = [
        f"{size_symbol(size, task.letters)} = "
        + with_unit(notation.computed(value), report.unit("m"))
        for size, value in used.items()
    ]
    template: Rich = report.texts["conclusion"]["synthesis"]
    return template.format(given=", ".join(text for _, text in told), sizes=report.listed(sizes))


def _is_datum(size: str, report: Report) -> bool:
    """Return whether a size is one of the given data of the synthesis."""
    from planmethod.synthesis import sizes_of

    task = report.one.problem.synthesis
    assert task is not None
    return any(name == size and task.data[key] for key, name in sizes_of(task.kind).items())
