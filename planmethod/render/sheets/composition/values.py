"""Single values of a composition file: their bounds and the wording of their faults."""

from __future__ import annotations

from planmethod.errors import LayoutError
from planmethod.languages import translate
from planmethod.problem.file_node import FileNode
from planmethod.problem.names import nearest_name_hint
from planmethod.render.ink.style import HEIGHTS
from planmethod.render.ink.typeset import SMALLEST, typeset

TITLE_LIMIT = 200
TEXT_LIMIT = 4000
BRACE_DEPTH = 8


def read_line(node: FileNode) -> str:
    """Read a plain line."""
    return node.text(TITLE_LIMIT)


def read_markup(node: FileNode) -> str:
    """Read a line of rich text."""
    return _checked(node, node.text(TITLE_LIMIT))


def _checked(node: FileNode, text: str) -> str:
    """Return rich text that can be set."""
    depth = deepest = 0
    for sign in text:
        depth += (sign == "{") - (sign == "}")
        deepest = max(deepest, depth)
    if deepest > BRACE_DEPTH:
        node.reject("braces are nested {} deep, the limit is {}", deepest, BRACE_DEPTH)
    try:
        for line in text.split("\n"):
            typeset(line, SMALLEST)
    except LayoutError as error:
        what, _, hint = str(error).partition("). ")
        node.reject(f"{what[:1].lower()}{what[1:]})", hint=hint)
    return text


def read_paragraph(node: FileNode) -> str:
    r"""Read rich text of several lines; ``\n`` starts a new one."""
    if not isinstance(node.value, str):
        node.reject_value("a string", "Put it in quotes.")
    if len(node.value) > TEXT_LIMIT:
        message = "the text has {} characters, the limit is {}"
        node.reject(message, len(node.value), TEXT_LIMIT, hint="Shorten it.")
    text = node.value.strip("\n")
    for line in text.split("\n"):
        node.check_text(line, TEXT_LIMIT)
    if not text.strip():
        node.reject("the text is empty", hint="Write a text, or leave the block out.")
    return _checked(node, text)


def read_switch(node: FileNode) -> bool:
    """Read true or false."""
    if not isinstance(node.value, bool):
        node.reject_value("true or false")
    return node.value


def read_choice(node: FileNode, known: tuple[str, ...]) -> str:
    """Read one of the known words."""
    word = node.value
    if not isinstance(word, str) or word not in known:
        hint = nearest_name_hint(word, known) if isinstance(word, str) else ""
        node.reject_value(translate("one of {}", ", ".join(known)), hint)
    return word


def read_size(node: FileNode, noun: str, low: float, high: float) -> float:
    """Read a size within bounds, mm."""
    return node.number(noun, low, high, hint="Sizes are in millimetres.")


def read_height(node: FileNode) -> float:
    """Read a letter height of GOST 2.304, mm."""
    known = [height for height in HEIGHTS if SMALLEST <= height <= 20.0]
    number = node.number("a letter height in mm")
    if number not in known:
        listed = ", ".join(f"{height:g}" for height in known)
        closest = min(known, key=lambda height: abs(height - number))
        message = "expected a height of GOST 2.304 ({}), got {:g}"
        node.reject(message, listed, number, hint=translate("Take {:g}.", closest))
    return number


def read_heights(node: FileNode) -> tuple[float, ...]:
    """Read one height, or several to try."""
    if isinstance(node.value, list):
        node.array("one to four letter heights", low=1, high=4)
    return node.read_one_or_all(read_height)


def require_list(node: FileNode, noun: str, limit: int) -> None:
    """Make sure that a list is neither empty nor too long."""
    expected = translate("a list of {}, one to {} of them", translate(noun), limit)
    node.array(expected, low=1, high=limit)
