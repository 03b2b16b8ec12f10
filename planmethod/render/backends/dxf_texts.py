"""Texts of a DXF as CAD programs show them unchanged: control codes, indices as stacks."""

from __future__ import annotations

import re
from cmath import exp
from collections.abc import Sequence
from math import radians

from planmethod.render.ink.drawing import Text

_NOT_TEXT = "[\x00-\x1f\x7f-\x9f]"


def escaped(text: str) -> str:
    """Return a text that a CAD program shows unchanged: control codes are escaped."""
    return clean(text).replace("^", "^ ").replace("%%", "%%%%%%")


def _coded(text: str) -> str:
    """Return a text of several heights that is shown unchanged: control codes are escaped."""
    return re.sub(r"([\\{}])", r"\\\1", clean(text)).replace("^", "^ ")


def _stacked(text: str) -> str:
    """Return an index whose stack separators are escaped as letters."""
    return re.sub(r"([#/;])", r"\\\1", _coded(text))


def clean(text: str) -> str:
    """Return a text without control characters."""
    return re.sub(_NOT_TEXT, "�", text)


def phrase_of(runs: Sequence[Text]) -> str:
    """Return the runs of one inscription as one text of several heights, with its indices."""
    whole, turn = max(runs, key=lambda run: run.height), exp(1j * radians(runs[0].angle))
    phrase = ""
    for run in runs:
        if run.height == whole.height:
            phrase += _coded(run.text)
            continue
        is_above = ((run.at - whole.at) / turn).imag > 0.0
        index = f"{_stacked(run.text)}^ " if is_above else f"^ {_stacked(run.text)}"
        phrase += f"{{\\H{run.height / whole.height:.3g}x;\\S{index};}}"
    return phrase
