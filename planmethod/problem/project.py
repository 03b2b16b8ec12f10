"""Decisions of a course project (курсовой проект): ``[project]``."""

from __future__ import annotations

from pathlib import PurePath

from planmethod.languages import translate
from planmethod.problem import fields
from planmethod.problem.cycle_records import PROJECT_PARTS, ProjectTask
from planmethod.problem.fields import Faults
from planmethod.problem.flat_tables import CustomReader, read_flat
from planmethod.problem.names import nearest_name_hint, short

_EXAMPLE = '[project] calculated = 4, gears = "train.toml"'


def read_project(faults: Faults, table: object) -> ProjectTask | None:
    """Read ``[project]``; None after a fault."""
    before = len(faults)
    entries = fields.read_table(faults, "project", table, _EXAMPLE)
    if entries is None:
        return None
    own: dict[str, CustomReader] = {
        "gears": _read_file_name,
        "meshing": _read_file_name,
        "cam": _read_file_name,
        "parts": _read_parts,
    }
    found = read_flat(faults, "project", entries, ProjectTask, own)
    return None if len(faults) > before else ProjectTask(**found)


def _read_file_name(faults: Faults, path: str, value: object) -> str | None:
    """Read the name of a problem file in the same folder."""
    if isinstance(value, str) and PurePath(value).name == value and value.endswith(".toml"):
        return value
    told = short(value) if isinstance(value, str) else value
    key = path.rpartition(".")[2]
    faults.add(
        path,
        translate("expected the name of a problem file, got '{}'", told),
        translate('For example: {} = "train.toml", beside this file.', key),
    )
    return None


def _read_parts(faults: Faults, path: str, value: object) -> tuple[str, ...] | None:
    if not isinstance(value, list) or not value or not all(isinstance(v, str) for v in value):
        faults.expected(path, "a list of parts", value, 'For example: ["kinematics", "note"].')
        return None
    for name in value:
        if name not in PROJECT_PARTS:
            listed = ", ".join(PROJECT_PARTS)
            faults.add(
                path,
                translate("unknown part '{}'", short(name)),
                nearest_name_hint(name, PROJECT_PARTS, translate("There are {}.", listed)),
            )
            return None
    return tuple(dict.fromkeys(value))
