"""A camshaft as a calculation: each cam, then the lifts by angles of the shaft (расчёт вала)."""

# no messages: formulas

from __future__ import annotations

from math import degrees

import numpy as np

from planmethod.cams.calculation import CamChapter
from planmethod.cams.model import TURN
from planmethod.cams.shaft import Camshaft, motion_on_shaft, phase_of
from planmethod.note.calculation.expression import Call, Name, Number, Operation
from planmethod.note.calculation.model import CalculationBuilder
from planmethod.note.wording import Language


def camshaft_chapters(shaft: Camshaft, builder: CalculationBuilder, language: Language) -> None:
    """Write a chapter for each cam, whose names end with that of the cam, and the cyclogram.

    Raises
    ------
    ProblemError
        A cam cannot satisfy its requirements.
    """
    texts, chapters = language.calculation, dict[str, CamChapter]()
    for cam, design in zip(shaft.cams, shaft.designs, strict=True):
        title = language.cam.one_cam.format(name=cam.name)
        builder.enter(cam.name, title)
        chapters[cam.name] = CamChapter(design, builder, language)
        chapters[cam.name].write(title)
    builder.enter("")
    angles = shaft.angles()
    shown = np.round(np.degrees(angles), 9).tolist()
    turned = builder.value("φ", shown, "°", texts.of_shaft.format(), is_input=True)
    for cam in shaft.cams:
        builder.enter(cam.name)
        builder.symbols[turned.symbol] = turned.name
        builder.add_heading(language.cam.one_cam.format(name=cam.name))
        phase = round(degrees(phase_of(cam)), 9)
        start = builder.add_input("φ_{0}", phase, "°", texts.phase_on_shaft.format())
        own = np.round((angles - phase_of(cam)) % TURN, 12) % round(TURN, 12)
        turn = Call("mod", (Operation("-", Name(turned.name), Name(start.name)), Number(360.0)))
        builder.row("φ_{c}", turn, np.degrees(own).tolist(), "°", texts.angle_of_cam.format())
        chapters[cam.name].lift_at("φ_{c}", own, motion_on_shaft(cam, angles)[0])
    builder.enter("")
    heads = [texts.position.format(number=number) for number in range(shaft.count)]
    builder.close(language.cam.cyclogram, heads)
