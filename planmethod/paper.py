"""Paper (форматы листов: GOST 2.301): basic and elongated formats, portrait and landscape.

A format is called ``A3``, an elongated one ``A4x3``. A4 is portrait, the others are landscape;
``A3:portrait`` (``А3:книжная``) is the portrait sheet.
"""

# Cyrillic letters: names of formats that files and options may write in them

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from functools import lru_cache
from types import MappingProxyType
from typing import NoReturn, TypeAlias

from msgspec import Struct

from planmethod.errors import LayoutError

Box: TypeAlias = tuple[float, float, float, float]
"""xmin, ymin, xmax, ymax in mm."""

FRAME_LEFT = 20.0
"""Distance from the left edge of the sheet to the frame, mm (binding margin)."""
FRAME_OTHER = 5.0
"""Distance from the other edges to the frame, mm."""
STAMP_WIDTH, STAMP_HEIGHT = 185.0, 55.0
"""Title block of form 1, mm."""


class Format(Struct, frozen=True):
    """Paper format (формат), mm; ``name`` in Latin letters, as on the command line.

    Attributes
    ----------
    name : str
        ``A3``, ``A4x3``, ``A3:portrait``.
    size : str
        The same without the orientation: the text after "Формат" under the frame.
    like : str
        Basic format as high as an elongated landscape one (as wide as a portrait one), and so with
        the same letter heights and sizes of views; the largest, A0, is like itself.
    """

    name: str
    width: float
    height: float
    size: str = ""
    like: str = ""

    @property
    def inner(self) -> Box:
        """Inside of the frame, mm."""
        right, top = self.width - FRAME_OTHER, self.height - FRAME_OTHER
        return (FRAME_LEFT, FRAME_OTHER, right, top)

    @property
    def stamp(self) -> Box:
        """Title block of form 1, mm: the lower right corner inside the frame."""
        right = self.width - FRAME_OTHER
        return (right - STAMP_WIDTH, FRAME_OTHER, right, FRAME_OTHER + STAMP_HEIGHT)

    @property
    def is_portrait(self) -> bool:
        """True if the short side is horizontal, with the title block along it."""
        return self.width < self.height

    def written(self, letter: str) -> str:
        """Return the name as a sheet writes it, with a language's letter: ``A3``, ``A4×3``."""
        return (self.size or self.name).replace("A", letter).replace("x", "×")


# GOST 2.301, table 1: short and long side.
_BASIC: Mapping[str, tuple[int, int]] = MappingProxyType(
    {"A4": (210, 297), "A3": (297, 420), "A2": (420, 594), "A1": (594, 841), "A0": (841, 1189)}
)
# GOST 2.301, table 2: multiple of the short side, and the resulting length. The multiples
# are those of the exact sides (A0 is a square metre), so that they differ from the whole ones of
# table 1 by a millimetre or two.
_ELONGATED: Mapping[str, Mapping[int, int]] = MappingProxyType(
    {
        "A4": {3: 630, 4: 841, 5: 1051, 6: 1261, 7: 1471, 8: 1682, 9: 1892},
        "A3": {3: 891, 4: 1189, 5: 1486, 6: 1783, 7: 2080},
        "A2": {3: 1261, 4: 1682, 5: 2102},
        "A1": {3: 1783, 4: 2378},
        "A0": {2: 1682, 3: 2523},
    }
)


def _formats() -> Iterator[Format]:
    """Yield every format: the basic ones, the elongated ones, then the portrait ones."""
    names = tuple(_BASIC)
    lying = [Format(name, long, short, name, name) for name, (short, long) in _BASIC.items()]
    for number, (name, (_, side)) in enumerate(_BASIC.items()):
        like = names[min(number + 1, len(names) - 1)]
        lying += [
            Format(f"{name}x{times}", long, side, f"{name}x{times}", like)
            for times, long in _ELONGATED[name].items()
        ]
    standing = [
        Format(f"{fmt.name}:portrait", fmt.height, fmt.width, fmt.size, fmt.like) for fmt in lying
    ]
    a4 = standing.pop(0)  # GOST 2.301: A4 is portrait
    yield Format("A4", a4.width, a4.height, a4.size, a4.like)
    yield from (*lying[1:], *standing)


BASIC = tuple(_BASIC)
"""Basic formats, from A4 to A0."""

DEFAULT_SERIES = ("A3", "A2", "A1")
"""Formats that are tried in turn when none is requested."""

FORMATS: Mapping[str, Format] = MappingProxyType({fmt.name: fmt for fmt in _formats()})
"""All formats by name, the basic ones first, from A4 to A0."""

_LATIN = str.maketrans("АаaХхX×*", "AAAxxxxx")
_NAME = r"(A[0-4])(?:x([0-9]+))?"
_TURNS = MappingProxyType(
    {
        "portrait": True,
        "книжная": True,
        "книжный": True,
        "landscape": False,
        "альбомная": False,
        "альбомный": False,
    }
)


@lru_cache(maxsize=128)
def paper_format(name: str) -> Format:
    """Return the format called ``name``.

    Parameters
    ----------
    name : str
        ``A3``, ``A4x3``, also with Cyrillic ``А`` or ``х`` and in any case; with ``:portrait`` or
        ``:landscape`` (``:книжная``, ``:альбомная``) after it for the other orientation.

    Raises
    ------
    LayoutError
        Unknown format, or landscape A4.
    """
    size, colon, turn = (part.strip() for part in name.partition(":"))
    match = re.fullmatch(_NAME, size.translate(_LATIN))
    if match is None:
        basic = ", ".join(_BASIC)
        raise LayoutError(
            "Unknown paper format {!r}. Choose {}, an elongated one such as A4x3, or a "
            "portrait one such as A3:portrait.",
            name,
            basic,
        )
    base, times = match[1], match[2]
    if times is not None and int(times) not in _ELONGATED[base]:
        _reject_times(base, times)
    if colon and turn.casefold() not in _TURNS:
        raise LayoutError(
            "Unknown orientation {0!r} of the paper {1!r}. Write {2}:portrait (книжная) "
            "or {2}:landscape (альбомная).",
            turn,
            name,
            size,
        )
    plain = match[0]
    stands = _TURNS[turn.casefold()] if colon else plain == "A4"
    if plain == "A4":
        if not stands:
            raise LayoutError(
                "A4 must be portrait by GOST 2.301, with the title block along the short "
                "side. Choose A4, or a landscape A3."
            )
        return FORMATS["A4"]
    return FORMATS[f"{plain}:portrait" if stands else plain]


def _reject_times(base: str, times: str) -> NoReturn:
    known = ", ".join(f"{base}x{number}" for number in _ELONGATED[base])
    raise LayoutError(
        "GOST 2.301 has no paper format {0}x{1}. {0} can be elongated to {2}.",
        base,
        times,
        known,
    )
