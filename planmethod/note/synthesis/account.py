"""The account of a synthesis: sizes by formulas, construction, measurements (изложение синтеза)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from planmethod.note.accounts.voice import STEPS, Voice, VoiceForm, sentences
from planmethod.note.document import (
    Chapter,
    Item,
    Node,
    Paragraph,
    Part,
    Table,
    Title,
    steps_of,
    table_of,
)
from planmethod.note.formula import Rich, inlined
from planmethod.note.narrate.statement import unbroken
from planmethod.note.narrate.synthesis import given_data, point_name
from planmethod.note.numbers import with_unit
from planmethod.note.synthesis.drawing import Drawn, construction_of
from planmethod.note.synthesis.formulas import SynthesisFormulas
from planmethod.note.synthesis.text import SynthesisNarrator, check_rows, size_rows
from planmethod.note.synthesis.verification import measured_on
from planmethod.note.wording import Language
from planmethod.solved.solution import Solution


class SynthesisAccount:
    """The synthesis of a mechanism, in a voice (синтез).

    Parameters
    ----------
    drawn : Drawn
    checks : mapping
        Values measured on the mechanism (`planmethod.note.synthesis.verification`).
    language : Language
    voice : Voice
    """

    def __init__(
        self, drawn: Drawn, checks: Mapping[str, Any], language: Language, voice: Voice
    ) -> None:
        self.drawn, self.checks, self.language, self.voice = drawn, checks, language, voice
        self.texts = language.synthesis

    @classmethod
    def of(cls, solution: Solution, language: Language, voice: Voice) -> SynthesisAccount:
        """Return the account of ``[synthesis]`` of a problem, which it must have."""
        return cls(construction_of(solution), measured_on(solution), language, voice)

    @property
    def title(self) -> str:
        """Name of the synthesis."""
        return str(self.texts["titles"][self.drawn.synthesis.kind])

    def chapter(self) -> Iterator[Node]:
        """Yield the chapter."""
        yield Chapter(self.title)
        yield Part(self.texts.by_formulas)
        yield from self.formulas()
        yield Part(self.texts.construction)
        yield from self.construction()
        yield Part(self.texts.measured)
        yield from self.measurements()

    def formulas(self) -> Iterator[Node]:
        """Yield the sizes by formulas with numbers."""
        lines = SynthesisFormulas(self.drawn, self.language).lines
        lead = f"{self.texts['leads'][self.drawn.synthesis.kind]}{self._chosen()}"
        points = {letter: point_name(letter, self.drawn.shown_letters) for letter in "OABC"}
        yield from self.voice.statement(f"{lead.format(**points)}:", lines, numbered=True)

    def _chosen(self) -> Rich:
        """Return how a size is chosen that the given data leave open."""
        made = self.drawn.synthesis
        given = {name for name, value in made.options.items() if value is not None}
        notation, sizes = self.language.notation, made.metres()
        if made.kind == "slider-crank" and given == {"stroke", "K_v"}:
            key, value = "offset", with_unit(notation.short(sizes["e"]), notation.units["m"])
        elif made.kind == "slider-crank" and given == {"stroke", "pressure", "offset"}:
            key, value = "pressure", notation.short(sizes["OA"] / sizes["AB"])
        elif made.kind == "crank-rocker" and given <= {"K_v", "swing", "rocker"}:
            key, value = "beta", f"{notation.short(made.facts['beta_deg'])}°"
        else:
            return ""
        return f" {self.texts['chosen'][key].format(value=value)}"

    def construction(self) -> Iterator[Node]:
        """Yield the steps of the construction, its picture and the sizes read from it."""
        drawn, notation = self.drawn, self.language.notation
        hand = self.texts.ruler.format(
            ruler=notation.as_input(drawn.profile.ruler), scale=notation.as_input(drawn.mu)
        )
        told = SynthesisNarrator(drawn, self.language).sentences()
        table = table_of(self.texts["columns"], size_rows(drawn, self.language))
        if self.voice.form is VoiceForm.NOTE:
            yield sentences(self.texts.drawn.format(hand=hand))
            yield from (Item(inlined(text), f"{k})") for k, text in enumerate(told, 1))
            yield from self.voice.figure("synthesis", self.title)
            yield Table(table.head, table.rows, name=self.texts.lengths, key="synthesis_sizes")
        else:
            yield from steps_of((f"{hand[:1].upper()}{hand[1:]}.", *told))
            yield table

    def measurements(self) -> Iterator[Node]:
        """Yield the measurements on the mechanism itself."""
        rows = [f"{name}: {value}" for name, value in check_rows(self.checks, self.language)]
        if self.voice.form is VoiceForm.NOTE:  # a list of a document has its punctuation
            rows = [f"{row};" for row in rows[:-1]] + [f"{rows[-1]}."]
        yield from map(Item, rows)


def synthesis_document(
    drawn: Drawn, checks: Mapping[str, Any], language: Language
) -> Iterator[Node]:
    """Yield what ``synthesize`` prints: the given data, and the account."""
    account, made = SynthesisAccount(drawn, checks, language, STEPS), drawn.synthesis
    given = unbroken(text for _, text in given_data(made.kind, made.options, language))
    yield Title(account.title)
    yield Paragraph(language.note.given.format(given=given))
    _, *rest = account.chapter()
    yield from (Chapter(node.title) if isinstance(node, Part) else node for node in rest)
