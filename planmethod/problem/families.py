"""Ready problem files of the common families of mechanisms, for ``planmethod new``."""

from __future__ import annotations

import re

from planmethod.languages import catalogue

MACHINES = ("shaper", "press", "crusher", "conveyor", "engine")
"""Names of those that have loads, a cycle and a flywheel, too."""

FAMILIES = (
    "slider-crank", "four-bar", "slotted-link", "swinging-block", "sine", "six-link",
    "driving-slider", "RRR+RRP", "RRP+RPR", "RRP+PRP", "RPR+RPP", "RRR+RPR", "RRR+RRR",
    "moving-guide", "whitworth", "toggle-press", "v-engine", "oscillating-cylinder",
    "pantograph", "watt", "stephenson", *MACHINES, "project",
)  # fmt: skip
"""Names of those of linkages; their meanings are in `planmethod.note.wording`."""

OTHER_FAMILIES = (
    "ordinary-train",
    "planetary-train",
    "differential-train",
    "meshing",
    "moving-point",
    "cam",
    "cam-oscillating",
)
"""Names of those of the other kinds of problem."""


SOURCE_LANGUAGE = "ru"
"""Language that the templates are written in."""


def template(family: str, lang: str = SOURCE_LANGUAGE) -> str:
    """Return a commented problem file of a family in a language, ready to edit.

    Raises
    ------
    KeyError
        The family is none of these.
    """
    if family not in (*FAMILIES, *OTHER_FAMILIES):
        raise KeyError(family)
    from importlib.resources import files  # not for those who only read

    source = files("planmethod.problem") / "templates" / f"{family}.toml"
    text = source.read_text(encoding="utf-8")
    return text if lang == SOURCE_LANGUAGE else _translated(text, lang)


def _translated(text: str, lang: str) -> str:
    """Return a template with its comments and texts in another language."""
    phrases = catalogue(lang, "templates")

    def line_of(line: re.Match[str]) -> str:
        keys, comment = line["keys"], line["comment"]
        keys = re.sub(r'"([^"]*)"', lambda text: f'"{phrases.get(text[1], text[1])}"', keys)
        return f"{keys}{line['sign']}{phrases.get(comment, comment)}"

    return re.sub(
        r'^(?P<keys>(?:[^#"\n]|"[^"\n]*")*)(?P<sign>#? ?)(?P<comment>.*)$',
        line_of,
        text,
        flags=re.M,
    )


def schema_text(lang: str) -> str:
    """Return the JSON Schema of problem files, with descriptions in a language (схема файла)."""
    from importlib.resources import files

    name = "schema.json" if lang == "en" else f"schema.{lang}.json"
    return (files("planmethod.problem") / name).read_text(encoding="utf-8")
