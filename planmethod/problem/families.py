"""Ready problem files of the common families of mechanisms, for ``planmethod new``."""

from __future__ import annotations

MACHINES = ("shaper", "press", "crusher", "conveyor", "engine")
"""Names of those that have loads, a cycle and a flywheel, too."""

FAMILIES = (
    "slider-crank", "four-bar", "slotted-link", "swinging-block", "sine", "six-link",
    "driving-slider", "RRR+RRP", "RRP+RPR", "RRP+PRP", "RPR+RPP", "RRR+RPR", "RRR+RRR",
    "moving-guide", "whitworth", "toggle-press", "v-engine", "oscillating-cylinder",
    "pantograph", "watt", "stephenson", *MACHINES, "project",
)  # fmt: skip
"""Names of those of linkages; what they are stands in `planmethod.note.wording`."""

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


def template(family: str) -> str:
    """Return a commented problem file of a family, ready to edit.

    Raises
    ------
    KeyError
        The family is none of these.
    """
    if family not in (*FAMILIES, *OTHER_FAMILIES):
        raise KeyError(family)
    from importlib.resources import files  # not for those who only read

    source = files("planmethod.problem") / "templates" / f"{family}.toml"
    return source.read_text(encoding="utf-8")


def schema_text(lang: str) -> str:
    """Return the JSON Schema of problem files, with what keys mean in a language (схема файла)."""
    from importlib.resources import files

    name = "schema.json" if lang == "en" else f"schema.{lang}.json"
    return (files("planmethod.problem") / name).read_text(encoding="utf-8")
