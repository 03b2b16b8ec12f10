"""Captions of frame and title block in English (рамка и основная надпись по-английски)."""

from planmethod.note.wording.sheet_model import FrameWording

FRAME = FrameWording(
    captions={
        "change": "Rev.",
        "changed": "Sheet",
        "document": "Doc. No.",
        "signature": "Sign.",
        "date": "Date",
        "approver": "Appr.",
        "norm_control": "Norm.",
        "t_control": "Tech.",
        "checker": "Check.",
        "author": "Drawn",
        "letter": "Let.",
        "mass": "Mass",
        "scale": "Scale",
        "sheet": "Sheet",
        "sheets": "Sheets",
        "inventory": "Orig. inv. No.",
        "signed": "Sign. and date",
        "inventory_instead": "Repl. inv. No.",
        "inventory_copy": "Dupl. inv. No.",
        "first_use": "First used in",
        "reference": "Ref. No.",
    },
    copied="Copied by",
    format="Format {paper}",
    paper="A",
    portrait="{paper}:portrait",
)
