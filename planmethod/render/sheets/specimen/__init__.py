"""Specimen sheets (листы образцов): the elements of drawings at working size.

A specimen is a function that takes the fields of the title block and a language and returns a
framed sheet; to add one, add a line to `SPECIMENS`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import TypeAlias

from planmethod.note.wording import Language
from planmethod.render.ink.drawing import Drawing
from planmethod.render.sheets.specimen.lines import lettering_sheet, lines_sheet
from planmethod.render.sheets.specimen.symbols import symbols_sheet

Specimen: TypeAlias = Callable[[Mapping[str, str], Language], Drawing]

SPECIMENS: Mapping[str, Specimen] = MappingProxyType(
    {
        "symbols": symbols_sheet,
        "lines": lines_sheet,
        "lettering": lettering_sheet,
    }
)
"""Specimen sheets by the names of the command line."""
