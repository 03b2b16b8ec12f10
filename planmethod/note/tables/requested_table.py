"""The results of a list in many positions, as a document (заказанные результаты)."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from planmethod.note.document import Document, Node, Paragraph, computed_text, table_of_columns
from planmethod.note.formula import escape
from planmethod.note.tables.results import heading_of, lead_columns
from planmethod.note.wording import Language, MessageTable
from planmethod.solved.many.gapped import GappedSweep


def requested_document(swept: GappedSweep, language: Language) -> Document:
    """Return the requested results as a table, a row for each position, four digits."""
    return Document.of(_requested_nodes(swept, language.note))


def _requested_nodes(swept: GappedSweep, texts: MessageTable) -> Iterator[Node]:
    count = len(swept.positions)
    yield Paragraph(heading_of(swept.problem))
    columns = lead_columns(swept.problem, swept.positions.tolist(), texts)
    values = swept.fill(np.empty((len(swept.names), count)), slice(0, count))
    for name, row in zip(swept.names, values, strict=True):
        columns.append([escape(name), *(computed_text(float(value), texts) for value in row)])
    yield table_of_columns(columns, repeated=2)
    yield from (Paragraph(escape(sentence)) for sentence in swept.gaps.sentences)
    yield Paragraph(texts.sense_note)
