"""Russian (русский язык)."""

from planmethod.note.wording.language import Language
from planmethod.note.wording.ru.audit import AUDIT
from planmethod.note.wording.ru.check import CHECK
from planmethod.note.wording.ru.control import CONTROL
from planmethod.note.wording.ru.cycle import CYCLE
from planmethod.note.wording.ru.forces import FORCES
from planmethod.note.wording.ru.form import FORM
from planmethod.note.wording.ru.frame import FRAME
from planmethod.note.wording.ru.gears import GEARS
from planmethod.note.wording.ru.layouts import FAMILIES, LAYOUTS, TASKS
from planmethod.note.wording.ru.live import LIVE
from planmethod.note.wording.ru.machine import MACHINE
from planmethod.note.wording.ru.meshing import MESHING
from planmethod.note.wording.ru.note import NOTE
from planmethod.note.wording.ru.numbers import NOTATION
from planmethod.note.wording.ru.point import POINT
from planmethod.note.wording.ru.sheets import SHEETS
from planmethod.note.wording.ru.specimens import SPECIMENS
from planmethod.note.wording.ru.structure import STRUCTURE
from planmethod.note.wording.ru.synthesis import SYNTHESIS
from planmethod.note.wording.ru.teeth import TEETH

LANGUAGE = Language(
    lang="ru",
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
