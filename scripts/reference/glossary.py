"""The terms of the program and of the theory of mechanisms, in both languages."""

from __future__ import annotations

from scripts.reference.markdown import data, table, words


def glossary_page(lang: str) -> str:
    """Return the terms by section, those of the language first."""
    said = words("glossary", lang)
    parts = []
    for section in data("glossary")["sections"]:
        rows = [
            (one, other, symbol, about) if lang == "en" else (other, one, symbol, about_ru)
            for one, other, symbol, about, about_ru in section["terms"]
        ]
        parts += [f"## {section[lang]}", table(said["heads"], rows)]
    return "\n\n".join(parts)
