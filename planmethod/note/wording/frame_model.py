"""What a language must be able to say in frame and title block (надписи форм ГОСТ 2.104)."""

from __future__ import annotations

from collections.abc import Mapping

from planmethod.record import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class FrameWording:
    """Captions of the forms of GOST 2.104 in one language.

    Attributes
    ----------
    captions : mapping
        By the names in `planmethod.render.frame`.
    copied, format : str
        Graphs 31 and 32, below the frame.
    paper, portrait : str
        The letter of the formats, and a format that stands.
    """

    captions: Mapping[str, str]
    copied: str
    format: str
    paper: str
    portrait: str
