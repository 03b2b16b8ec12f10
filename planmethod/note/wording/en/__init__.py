"""English (английский язык)."""

from planmethod.note.wording.en.audit import AUDIT
from planmethod.note.wording.en.check import CHECK
from planmethod.note.wording.en.control import CONTROL
from planmethod.note.wording.en.cycle import CYCLE
from planmethod.note.wording.en.forces import FORCES
from planmethod.note.wording.en.form import FORM
from planmethod.note.wording.en.frame import FRAME
from planmethod.note.wording.en.gears import GEARS
from planmethod.note.wording.en.layouts import FAMILIES, LAYOUTS, TASKS
from planmethod.note.wording.en.live import LIVE
from planmethod.note.wording.en.machine import MACHINE
from planmethod.note.wording.en.meshing import MESHING
from planmethod.note.wording.en.note import NOTE
from planmethod.note.wording.en.numbers import NOTATION
from planmethod.note.wording.en.point import POINT
from planmethod.note.wording.en.sheets import SHEETS
from planmethod.note.wording.en.specimens import SPECIMENS
from planmethod.note.wording.en.structure import STRUCTURE
from planmethod.note.wording.en.synthesis import SYNTHESIS
from planmethod.note.wording.en.teeth import TEETH
from planmethod.note.wording.language import Language

LANGUAGE = Language(
    lang="en",
    say=NOTATION,
    note=NOTE,
    forces=FORCES,
    sheets=SHEETS,
    structure=STRUCTURE,
    frame=FRAME,
    control=CONTROL,
    specimens=SPECIMENS,
    audit=AUDIT,
    check=CHECK,
    form=FORM,
    point=POINT,
    gears=GEARS,
    cycle=CYCLE,
    machine=MACHINE,
    meshing=MESHING,
    synthesis=SYNTHESIS,
    teeth=TEETH,
    live=LIVE,
    layouts=LAYOUTS,
    families=FAMILIES,
    tasks=TASKS,
)
