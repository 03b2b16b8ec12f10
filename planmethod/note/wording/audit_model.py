"""What a language must be able to say of the audit of sources (слова сверки источников)."""

from __future__ import annotations

from collections.abc import Mapping

from msgspec import Struct


class AuditWording(Struct, frozen=True, kw_only=True):
    """What the document of the audit says in one language.

    ``verdicts`` and ``counted`` are by the values of `planmethod.note.audit.audit.Verdict`,
    ``chain_steps`` by those of `planmethod.note.audit.machine.chain`: what a step is, and what was
    wrong before it; ``whys`` by those of `planmethod.solved.selected.quantities.Why`.
    """

    title: str
    intro: tuple[str, ...]
    problem: str
    source: str
    values: str
    nothing: str
    summary: str
    columns: tuple[str, ...]
    verdicts: Mapping[str, str]
    counted: Mapping[str, str]
    whys: Mapping[str, str]
    chain: str
    chain_columns: tuple[str, ...]
    chain_steps: Mapping[str, tuple[str, str]]
