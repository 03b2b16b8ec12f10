"""The page of a camshaft that turns: all cams, and the cyclogram with a cursor (кулачковый вал)."""

from __future__ import annotations

from planmethod.cams.live import LETTER, LiveDiagrams, cams_page
from planmethod.cams.shaft import Camshaft
from planmethod.cams.shaft_sheet import DEGREES, cyclogram_picture
from planmethod.note.wording import get_language


def live_page(shaft: Camshaft, lang: str) -> str:
    """Return the page of a camshaft, an HTML document.

    Raises
    ------
    ProblemError
        A cam cannot satisfy its requirements.
    """
    language, degree = get_language(lang), DEGREES[0]
    picture = cyclogram_picture(shaft, language, degree, LETTER)
    diagrams = LiveDiagrams(picture, language.cam.cyclogram, 1 / degree)
    return cams_page(shaft, lang, shaft.designs, diagrams)
