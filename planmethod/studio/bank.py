"""What a page offers to start from: shipped tasks, found by words, and templates (банк задач)."""

# Cyrillic letters: endings of Russian words, which a search leaves out

from __future__ import annotations

import re
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Any
from unicodedata import combining, normalize

from msgspec.structs import asdict

from planmethod.languages import LANGUAGES
from planmethod.note.wording import get_language
from planmethod.problem import FAMILIES, OTHER_FAMILIES, template
from planmethod.problem.tasks import ShippedTask, tasks, text_for

SIX_LINK = 2
"""Groups of a six-link mechanism."""

_ENDING = "аеиоуыэюяь"
"""Letters at the end of a Russian word in its cases; an accented letter is without its accent."""

_FAMILY_OF = {
    "RRR": "four-bar", "RRP": "slider-crank", "RPR": "slotted-link", "RPP": "sine",
    "cam": "cam", "point": "moving-point", "meshing": "meshing",
}  # fmt: skip
"""Templates that say in a language what a structure or a kind of problem is."""

MAX_QUERY = 200


def find_tasks(query: str, lang: str) -> list[dict[str, Any]]:
    """Return the shipped tasks, or those of a search, with titles and structure in a language."""
    return [
        {**asdict(task), "about": about(task, lang)}
        for task in tasks()
        if matches(task, query[:MAX_QUERY])
    ]


def matches(task: ShippedTask, query: str) -> bool:
    """Return whether a task has every word of a search.

    A word is of its name, its title, its source or a comment, or a name of its structure in any
    language: ``four-bar``, ``поршень``.
    """
    words = [word.rstrip(_ENDING) or word for word in _folded(query).split()]
    return all(word in _phrase(task) for word in words)


def about(task: ShippedTask, lang: str) -> str:
    """Return what kind of mechanism a task has, in a language."""
    language = get_language(lang)
    families, kinds = language.families, language.tasks
    structure = task.structure or task.kind
    family = structure if structure in families else _FAMILY_OF.get(structure)
    if family is not None:
        return str(families[family])
    of = "six_link" if len(task.groups) == SIX_LINK else task.kind
    return str(kinds[of]) if of in kinds else str(language.studio["search"]["about_six_link"])


@cache
def _phrase(task: ShippedTask) -> str:
    """Return all that a search reads of a task."""
    comments = re.findall(r"#(.*)", task.text)
    parts = [task.name, task.title, task.source, task.structure, *comments]
    for lang in LANGUAGES:
        words = get_language(lang).studio["search"]
        named = [task.kind, *task.groups, *(["six_link"] * (len(task.groups) == SIX_LINK))]
        parts += [about(task, lang), *(words[one] for one in dict.fromkeys(named) if one in words)]
    return _folded(" ".join(parts))


def _folded(text: str) -> str:
    """Return a text in lower case without accents."""
    return "".join(c for c in normalize("NFD", text.casefold()) if not combining(c))


def start_of(name: str, variant: str | None, lang: str) -> dict[str, str] | None:
    """Return the text of a task, of a variant of it, or of a template; None of any other name.

    A template is in the language of the page.
    """
    if name in (*FAMILIES, *OTHER_FAMILIES):
        return {"name": name, "text": template(name, lang)}
    task = next((task for task in tasks() if task.name == name), None)
    if task is None or (variant is not None and variant not in task.variants):
        return None
    return {"name": name, "text": text_for(task, variant)}


def pictured_files() -> dict[str, str]:
    """Return the file that a picture is drawn of, by the name of a task or a template.

    That of a task is below the folder of the tasks; that of a template is a whole path.
    """
    folder = Path(str(files("planmethod.problem") / "templates"))
    return {task.name: task.file for task in tasks()} | {
        name: str(folder / f"{name}.toml") for name in (*FAMILIES, *OTHER_FAMILIES)
    }
