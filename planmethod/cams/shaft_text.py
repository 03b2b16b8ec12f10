"""Texts and the JSON record of a camshaft: given data, phases on the shaft, lifts."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from math import degrees, gcd
from typing import Any

import numpy as np

from planmethod.cams.model import TURN, CamProblem
from planmethod.cams.shaft import Camshaft, motion_on_shaft, phase_of, spans_of
from planmethod.cams.text import (
    MM,
    PROFILE_ROWS,
    angle_symbol,
    facts_paragraph,
    given_facts as facts_of_cam,
    hundredths,
    record as record_of_cam,
    result_nodes,
)
from planmethod.construct.drafting import Profile
from planmethod.construct.scale import series_near
from planmethod.note.document import (
    Caption,
    Chapter,
    GivenFact,
    Item,
    Node,
    Table,
    Title,
    table_of,
)
from planmethod.note.formula import Rich, escape
from planmethod.note.numbers import decimals_of, trimmed
from planmethod.note.records.legend import legend_record
from planmethod.note.records.spreadsheet import SpreadsheetRows
from planmethod.note.wording import Language

LIFT = 30.0
"""Height of the greatest lift on the cyclogram, mm, from which its scale is chosen."""


def timing_scale(shaft: Camshaft) -> float:
    """Return the scale of all lifts on the cyclogram, m/mm."""
    return series_near(max(cam.stroke for cam in shaft.cams) / LIFT, up=False)


# Records -----------------------------------------------------------------------------------------


def record(shaft: Camshaft, lang: str = "ru") -> dict[str, Any]:
    """Return one object for a camshaft: metres and degrees, full precision.

    Raises
    ------
    ProblemError
        A cam cannot satisfy its requirements.
    """
    told: dict[str, Any] = {"schema": 1, "problem": shaft.name, "kind": "camshaft"}
    if shaft.variant is not None:
        told["variant"] = shaft.variant
    phi = shaft.angles()
    lifts = [motion_on_shaft(cam, phi) for cam in shaft.cams]
    return {
        **told,
        "n": shaft.n,
        "cams": [_cam_record(cam, lang) for cam in shaft.cams],
        "positions": [
            {
                "phi_deg": 360.0 * k / shaft.count,
                **{
                    cam.name: dict(zip(("s", "v_q", "a_q"), map(float, moved[:, k]), strict=True))
                    for cam, moved in zip(shaft.cams, lifts, strict=True)
                },
            }
            for k in range(shaft.count)
        ],
        "legend": legend_record(
            (("phi_deg", "φ", "deg"), ("s", "s", "m"), ("v_q", "v_{q}", "m"), ("a_q", "a_{q}", "m"))
        ),
    }


def _cam_record(cam: CamProblem, lang: str) -> dict[str, Any]:
    """Return the record of a cam with its name, phase, key, and its motions on the shaft."""
    whole = record_of_cam(cam, lang)
    own = {key: value for key, value in whole.items() if key not in ("schema", "problem", "kind")}
    turned = degrees(phase_of(cam))
    return {
        "name": cam.name,
        "phase_deg": turned,
        # on the sheet of the cam, which shows it at the beginning of its turn
        "key_deg": 90.0 + cam.mirror * turned,
        "spans": [
            {
                "phase": one.motion.phase.value,
                "from_deg": degrees(one.start),
                "to_deg": degrees(one.end),
                "continued": one.is_continued,
            }
            for one in spans_of(cam)
        ],
        **own,
    }


def spreadsheet(shaft: Camshaft) -> SpreadsheetRows:
    """Return the lifts as a table: every half degree of the shaft, m."""
    count = PROFILE_ROWS * shaft.count // gcd(PROFILE_ROWS, shaft.count)
    phi = TURN * np.arange(count) / count
    lifts = [motion_on_shaft(cam, phi)[0] + 0.0 for cam in shaft.cams]
    values = np.array([360.0 * np.arange(count) / count, *lifts]).T.tolist()
    keys = ("phi_deg", *(f"s_{cam.name}" for cam in shaft.cams))
    return SpreadsheetRows(shaft, keys, len(values), partial(iter, [values]))


# Documents ---------------------------------------------------------------------------------------


def head(shaft: Camshaft, language: Language) -> Iterator[Node]:
    """Yield the title and the given data."""
    variant = f" ({shaft.variant})" if shaft.variant else ""
    title = escape((shaft.title or shaft.name) + variant)
    yield Title(language.cam.shaft_title.format(title=title))
    yield facts_paragraph(given_facts(shaft, language), language)


def given_facts(shaft: Camshaft, language: Language, *, numbered: bool = False) -> list[GivenFact]:
    """Return the given data of all cams, each after its name and phase."""
    found = list[GivenFact]()
    for k, cam in enumerate(shaft.cams):
        place = f"cams[{k}]"
        for fact in facts_of_cam(cam, language):
            data = {key.replace("cam", place, 1): value for key, value in fact.data.items()}
            found.append(GivenFact(fact.text, data))
    if numbered:
        found.append(GivenFact(language.cam.numbered_shaft.format(count=shaft.count), {}))
    return found


def solved_document(shaft: Camshaft, language: Language) -> Iterator[Node]:
    """Yield the given data, the phases and lifts on the shaft, then each cam.

    Raises
    ------
    ProblemError
    """
    texts = language.cam
    yield from head(shaft, language)
    yield Caption(texts.phases_title)
    yield phases_table(shaft, language)
    yield Caption(texts.lifts_title)
    yield lifts_table(shaft, language)
    yield Item(texts.key_told.format())
    for cam, design in zip(shaft.cams, shaft.designs, strict=True):
        yield Chapter(texts.one_cam.format(name=escape(cam.name)), numbered=False)
        yield from result_nodes(design, language)


def phases_table(shaft: Camshaft, language: Language) -> Table:
    """Return the phases of all cams by angles of the shaft."""
    texts, notation, rows = language.cam, language.notation, list[tuple[Rich, ...]]()
    for cam in shaft.cams:
        for number, span in enumerate(spans_of(cam)):
            ends = (notation.as_input(round(degrees(x), 6)) for x in (span.start, span.end))
            kind = texts["span_names"][span.motion.phase.value]
            symbol = angle_symbol(cam, span.motion, language)
            rows.append((escape(cam.name) if not number else "", f"{kind} {symbol}", *ends))
    return table_of(texts["phase_heads"], rows, names=2)


def lifts_table(shaft: Camshaft, language: Language, profile: Profile | None = None) -> Table:
    """Return the lifts of all followers in the positions of the shaft, mm.

    With a profile each has also the ordinate of the cyclogram that its ruler reads, mm.
    """
    notation, phi, scale = language.notation, shaft.angles(), timing_scale(shaft)
    lifts = [motion_on_shaft(cam, phi)[0] for cam in shaft.cams]
    angles = [trimmed(round(360.0 * k / shaft.count, 2)) for k in range(shaft.count)]
    decimals = max(map(decimals_of, angles))
    heads: list[Rich] = [language.note.number, "φ, °"]
    for cam in shaft.cams:
        heads.append(f"s_{{{escape(cam.name)}}}, {notation.units['mm']}")
        if profile is not None:
            heads.append(f"y_{{{escape(cam.name)}}}, {notation.units['mm']}")
    rows = []
    for k in range(shaft.count):
        cells: list[Rich] = [str(k), notation.number(f"{float(angles[k]):.{decimals}f}")]
        for lift in lifts:
            cells.append(hundredths(MM * float(lift[k]), language))
            if profile is not None:
                read = profile.ruler * round(float(lift[k]) / scale / profile.ruler)
                cells.append(notation.measured(read + 0.0))
        rows.append(tuple(cells))
    return table_of(heads, rows, names=0)
