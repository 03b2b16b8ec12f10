"""Decisions of a course project (курсовой проект): ``[project]``."""

from __future__ import annotations

from pathlib import PurePath

from planmethod.languages import translate
from planmethod.problem.cycle_records import PROJECT_PARTS, ProjectTask
from planmethod.problem.file_node import FileNode
from planmethod.problem.names import nearest_name_hint, short

_EXAMPLE = '[project] calculated = 4, gears = "train.toml"'


def read_project(node: FileNode) -> ProjectTask:
    """Read ``[project]``."""
    node.table(_EXAMPLE)
    file, parts = _read_file_name, _read_parts
    found = node.record(ProjectTask, gears=file, meshing=file, cam=file, parts=parts)
    return node.build(ProjectTask, found)


def _read_file_name(node: FileNode) -> str:
    """Read the name of a problem file in the same folder."""
    name = node.value
    if isinstance(name, str) and PurePath(name).name == name and name.endswith(".toml"):
        return name
    hint = translate('For example: {} = "train.toml", beside this file.', node.key)
    shown = short(name) if isinstance(name, str) else name
    return node.reject("expected the name of a problem file, got '{}'", shown, hint=hint)


def _read_parts(node: FileNode) -> tuple[str, ...]:
    parts = node.value
    if not isinstance(parts, list) or not parts or not all(isinstance(v, str) for v in parts):
        node.reject_value("a list of parts", 'For example: ["kinematics", "note"].')
    for name in parts:
        if name not in PROJECT_PARTS:
            hint = translate("There are {}.", ", ".join(PROJECT_PARTS))
            hint = nearest_name_hint(name, PROJECT_PARTS, hint)
            node.reject("unknown part '{}'", short(name), hint=hint)
    return tuple(dict.fromkeys(parts))
