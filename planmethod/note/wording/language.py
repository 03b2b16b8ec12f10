"""What a language is made of: numbers and units, and the words of every subject (язык)."""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from planmethod.note.numbers import Notation
    from planmethod.note.wording.audit_model import AuditWording
    from planmethod.note.wording.check_model import CheckWording, FormWording
    from planmethod.note.wording.control_model import ControlWording
    from planmethod.note.wording.cycle_model import CycleWording
    from planmethod.note.wording.force_model import ForceWording
    from planmethod.note.wording.gear_model import GearWording, MeshingWording, TeethWording
    from planmethod.note.wording.live_model import LiveWording
    from planmethod.note.wording.machine_model import MachineWording
    from planmethod.note.wording.model import Wording
    from planmethod.note.wording.point_model import PointWording
    from planmethod.note.wording.sheet_model import FrameWording, SheetWording, StructureWording
    from planmethod.note.wording.specimen_model import SpecimenWording
    from planmethod.note.wording.synthesis_model import SynthesisWording

ELSEWHERE = {
    "say": ("numbers", "NOTATION"),
    "families": ("layouts", "FAMILIES"),
    "tasks": ("layouts", "TASKS"),
    "teeth": ("gears", "TEETH"),
}
"""Subjects that are not the constant of their name in the module of their name."""


class Language:
    """A language, handed down to all that write in it (язык).

    The words of a subject are imported when they are first asked for.

    Attributes
    ----------
    lang : str
        Its name, that of its folder.
    say : Notation
        Numbers, units, symbols.
    note, forces : Wording, ForceWording
        Protocol and tables, and those of the force analysis.
    sheets, structure, frame : SheetWording, StructureWording, FrameWording
        Sheets of the plans, the structural sheet, frame and title block.
    control : ControlWording
        The norm control.
    specimens : SpecimenWording
    audit : AuditWording
    check : CheckWording
        The checking of works.
    form : FormWording
        The form to fill in, and what cannot be read in works.
    point : PointWording
        The moving point.
    cycle : CycleWording
        The turn of a crank.
    gears, teeth, meshing : GearWording, TeethWording, MeshingWording
        Gear trains, the choice of their teeth, two wheels in mesh.
    machine : MachineWording
        A machine and its flywheel.
    synthesis : SynthesisWording
        Syntheses.
    live : LiveWording
        The page of a moving mechanism.
    layouts : mapping
        Names and comments of the shipped layouts, by the places of their files.
    families : mapping
        What the families of ready problem files are.
    tasks : mapping
        Of the list of shipped tasks.
    """

    lang: str
    say: Notation
    note: Wording
    forces: ForceWording
    sheets: SheetWording
    structure: StructureWording
    frame: FrameWording
    control: ControlWording
    specimens: SpecimenWording
    audit: AuditWording
    check: CheckWording
    form: FormWording
    point: PointWording
    gears: GearWording
    cycle: CycleWording
    machine: MachineWording
    meshing: MeshingWording
    synthesis: SynthesisWording
    teeth: TeethWording
    live: LiveWording
    layouts: Mapping[str, str]
    families: Mapping[str, str]
    tasks: Mapping[str, str]

    def __init__(self, lang: str) -> None:
        self.lang = lang

    if not TYPE_CHECKING:  # what is not declared above is no subject

        def __getattr__(self, subject: str) -> Any:
            """Import the words of a subject."""
            if subject == "lang" or subject not in Language.__annotations__:
                raise AttributeError(f"a language has no {subject!r}")
            module, name = ELSEWHERE.get(subject, (subject, subject.upper()))
            found = getattr(import_module(f"{__package__}.{self.lang}.{module}"), name)
            setattr(self, subject, found)
            return found
