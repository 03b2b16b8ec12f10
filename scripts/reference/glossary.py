"""The terms of the program and of the theory of mechanisms, in both languages."""

from __future__ import annotations

from scripts.reference.markdown import data, table, words


def glossary_page(lang: str) -> str:
    """Return the terms by section, those of the language first; the code's are in English only."""
    said = words("glossary", lang)
    glossary = data("glossary")
    omitted = set() if lang == "en" else set(glossary["code"])
    parts = []
    for section in glossary["sections"]:
        rows = [
            (one, other, symbol, about) if lang == "en" else (other, one, symbol, about_ru)
            for one, other, symbol, about, about_ru in section["terms"]
            if one not in omitted
        ]
        parts += [f"## {section[lang]}", table(said["heads"], rows)]
    return "\n\n".join(parts)
