"""The results of a list in many positions, as a document (заказанные результаты)."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from planmethod.note.document import Document, Node, Paragraph, table_of_columns
from planmethod.note.formula import escape
from planmethod.note.plaintext import found
from planmethod.note.tables.results import heading_of, lead_columns
from planmethod.note.wording import Language, Words
from planmethod.solved.many.gaps import GappedSweep


def asked_document(swept: GappedSweep, words: Language) -> Document:
    """Return the requested results as a table, a row for each position, four digits."""
    return Document.of(_asked(swept, words.note))


def _asked(swept: GappedSweep, words: Words) -> Iterator[Node]:
    count = len(swept.positions)
    yield Paragraph(heading_of(swept.problem))
    columns = lead_columns(swept.problem, swept.positions.tolist(), words)
    values = swept.fill(np.empty((len(swept.names), count)), slice(0, count))
    for name, row in zip(swept.names, values, strict=True):
        columns.append([escape(name), *(found(float(value), words) for value in row)])
    yield table_of_columns(columns, repeated=2)
    yield from (Paragraph(escape(sentence)) for sentence in swept.gaps.sentences)
    yield Paragraph(words.sense_note)
