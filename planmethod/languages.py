"""Languages of all that is written (языки): the folders of `planmethod.note.wording`."""

from __future__ import annotations

from pathlib import Path

_FOLDERS = (Path(__file__).parent / "note" / "wording").glob("*/__init__.py")

LANGUAGES = tuple(
    sorted((path.parent.name for path in _FOLDERS), key=lambda lang: (lang != "ru", lang))
)
"""Their names; the first is the one where none is asked for."""
