"""Documents of linkages as the commands print them."""

from __future__ import annotations

from collections.abc import Sequence

from doors import (
    Document,
    GradedSubmission,
    Key,
    Language,
    Mechanism,
    Solution,
    Structure,
    compared_document,
    cycle_steps,
    cycle_tables,
    get_language,
    key_document,
    plain_document,
    protocol_document,
    referee_document,
    results_document,
    structure_document,
)


def protocol(solution: Solution, *, lang: str = "ru", position: int = 0) -> str:
    words = get_language(lang)
    return plain_document(protocol_document(solution, words, position), words) + "\n"


def result_tables(solution: Solution, lang: str = "ru", *, sigma: bool = False) -> str:
    words = get_language(lang)
    return plain_document(results_document(solution, words, sigma=sigma), words)


def referee_tables(solution: Solution, digits: int, lang: str = "ru") -> str:
    words = get_language(lang)
    return plain_document(referee_document(solution, digits, words), words)


def structure_text(mechanism: Mechanism, structure: Structure, lang: str = "ru") -> str:
    words = get_language(lang)
    return plain_document(structure_document(mechanism, structure, words), words)


def cycle_protocol(solution: Solution, lang: str) -> str:
    words = get_language(lang)
    nodes = [*cycle_tables(solution, words), *cycle_steps(solution, words)]
    return plain_document(Document.of(nodes), words)


def key_text(keys: Sequence[Key], words: Language) -> str:
    return plain_document(key_document(keys, words), words) + "\n"


def compared_text(checked: Sequence[GradedSubmission], words: Language) -> str:
    return plain_document(compared_document(checked, words), words) + "\n"
