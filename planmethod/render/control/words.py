"""What the norm control calls a thing that letters lie on, or a line by itself."""

from __future__ import annotations

from planmethod.note.wording.control_model import ControlWording
from planmethod.render.ink.drawing import Pen


def thing_text(name: str, words: ControlWording) -> str:
    """Return what an inscription lies on (``stroke main``), or a line by itself (``line axis``)."""
    kind, _, rest = name.partition(" ")
    # The names of pens may have a space, as may what follows them.
    pen = max((p for p in Pen if f"{rest} ".startswith(f"{p.value} ")),
              key=lambda p: len(p.value), default=None)  # fmt: skip
    tag = rest if pen is None else rest[len(pen.value) :].strip()
    told = f" ({tag})" if tag else ""
    if kind == "line":
        assert pen is not None, f"a line without a pen: {name}"
        return words.lines[pen.value] + told
    return words.things[kind].format(pen="" if pen is None else words.pens[pen.value]) + told
