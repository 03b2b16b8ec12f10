"""Single values of a composition file: their bounds and the wording of their faults."""

from __future__ import annotations

from typing import Any

from planmethod.errors import LayoutError
from planmethod.languages import translate
from planmethod.problem.fields import Faults, read_number, read_text
from planmethod.problem.names import nearest_name_hint
from planmethod.render.ink.style import HEIGHTS
from planmethod.render.ink.typeset import SMALLEST, typeset

TITLE_LIMIT = 200
TEXT_LIMIT = 4000
BRACE_DEPTH = 8


def read_line(faults: Faults, path: str, value: object, limit: int = TITLE_LIMIT) -> str:
    """Read a plain line; empty after a fault."""
    return read_text(faults, path, value, limit=limit) or ""


def read_markup(faults: Faults, path: str, value: object) -> str | None:
    """Read a line of rich text."""
    text = read_text(faults, path, value, limit=TITLE_LIMIT)
    return text if text is not None and _is_markup(faults, path, text) else None


def _is_markup(faults: Faults, path: str, text: str) -> bool:
    depth = deepest = 0
    for sign in text:
        depth += (sign == "{") - (sign == "}")
        deepest = max(deepest, depth)
    if deepest > BRACE_DEPTH:
        faults.add(
            path, translate("braces are nested {} deep, the limit is {}", deepest, BRACE_DEPTH)
        )
        return False
    try:
        for line in text.split("\n"):
            typeset(line, SMALLEST)
    except LayoutError as error:
        what, _, hint = str(error).partition("). ")
        faults.add(path, f"{what[:1].lower()}{what[1:]})", hint)
        return False
    return True


def read_paragraph(faults: Faults, path: str, value: object) -> str:
    r"""Read rich text of several lines; ``\n`` starts a new one."""
    if not isinstance(value, str):
        faults.expected(path, "a string", value, "Put it in quotes.")
        return ""
    if len(value) > TEXT_LIMIT:
        faults.add(
            path,
            translate("the text has {} characters, the limit is {}", len(value), TEXT_LIMIT),
            "Shorten it.",
        )
        return ""
    lines = [read_line(faults, path, line, TEXT_LIMIT) for line in value.strip("\n").split("\n")]
    text = "\n".join(lines)
    if not text.strip():
        faults.add(path, "the text is empty", "Write a text, or leave the block out.")
        return ""
    return text if _is_markup(faults, path, text) else ""


def read_switch(faults: Faults, path: str, value: object) -> bool:
    """Read true or false; false after a fault."""
    if isinstance(value, bool):
        return value
    faults.expected(path, "true or false", value)
    return False


def read_choice(faults: Faults, path: str, value: object, known: tuple[str, ...]) -> str | None:
    """Read one of the known words."""
    if isinstance(value, str) and value in known:
        return value
    faults.expected(
        path,
        translate("one of {}", ", ".join(known)),
        value,
        nearest_name_hint(value, known) if isinstance(value, str) else "",
    )
    return None


def read_size(
    faults: Faults, path: str, value: object, noun: str, low: float, high: float
) -> float | None:
    """Read a size within bounds, mm."""
    number = read_number(faults, path, value, noun)
    if number is not None and not low <= number <= high:
        faults.add(
            path,
            translate("expected {} from {:g} to {:g}, got {:g}", noun, low, high, number),
            "Sizes are in millimetres.",
        )
        return None
    return number


def read_height(faults: Faults, path: str, value: object) -> float | None:
    """Read a letter height of GOST 2.304, mm."""
    known = [height for height in HEIGHTS if SMALLEST <= height <= 20.0]
    number = read_number(faults, path, value, "a letter height in mm")
    if number is None or number in known:
        return number
    listed = ", ".join(f"{height:g}" for height in known)
    closest = min(known, key=lambda height: abs(height - number))
    faults.add(
        path,
        translate("expected a height of GOST 2.304 ({}), got {:g}", listed, number),
        translate("Take {:g}.", closest),
    )
    return None


def read_heights(faults: Faults, path: str, value: object) -> tuple[float, ...]:
    """Read one height, or several to try."""
    many = value if isinstance(value, list) else [value]
    if not 1 <= len(many) <= 4:
        faults.expected(path, "one to four letter heights", value)
        return ()
    paths = [f"{path}[{k}]" for k in range(len(many))] if isinstance(value, list) else [path]
    read = [read_height(faults, *pair) for pair in zip(paths, many, strict=True)]
    return tuple(height for height in read if height is not None)


def read_list(faults: Faults, path: str, value: object, noun: str, limit: int) -> list[Any]:
    """Read a list that is neither empty nor too long; empty after a fault."""
    if isinstance(value, list) and 1 <= len(value) <= limit:
        return value
    faults.expected(
        path, translate("a list of {}, one to {} of them", translate(noun), limit), value
    )
    return []
