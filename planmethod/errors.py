"""Errors of the package: one root, one class per kind of trouble.

Every message names the problem, its place, with numbers, and the next action; the command line
prints it unchanged and turns `exit_code` into the exit code of the process.
"""

from __future__ import annotations

import copyreg
from collections.abc import Mapping, Sequence
from enum import IntEnum

from msgspec import Struct
from msgspec.structs import force_setattr

from planmethod.languages import translate


class ExitCode(IntEnum):
    """Exit codes of the command line (коды завершения)."""

    DONE = 0
    FINDINGS = 1
    USAGE = 2
    PROBLEM = 3
    ASSEMBLY = 4
    SELF_CHECK = 5


EXIT_CODES: Mapping[ExitCode, str] = {
    ExitCode.DONE: "The command has done its work.",
    ExitCode.FINDINGS: "The command has done its work and found something to correct.",
    ExitCode.USAGE: "The command line, a layout, a config file or an answer file is wrong, or the "
    "output cannot be made.",
    ExitCode.PROBLEM: "The problem file is faulty, or its links do not form a mechanism.",
    ExitCode.ASSEMBLY: "The mechanism cannot be assembled, or a plan cannot be closed, in a "
    "requested position.",
    ExitCode.SELF_CHECK: "A self-check failed: an internal error of planmethod. Please report it.",
}
"""Meanings of the exit codes; `FINDINGS` has one for each command that returns it."""


class PlanMethodError(Exception):
    """Root of all errors that the package raises on purpose: a sentence, and its facts."""

    exit_code: ExitCode = ExitCode.SELF_CHECK

    def __init__(self, message: str = "", *facts: object) -> None:
        super().__init__(translate(message, *facts))

    def __reduce__(self) -> tuple[object, ...]:
        """Return the parts to rebuild it in another process: translated message and facts."""
        return copyreg.__newobj__, (type(self), *self.args), vars(self)  # type: ignore[attr-defined]


class DoubtWarning(UserWarning):
    """Warning about results that a Python program still receives (сомнение)."""


class Fault(Struct, frozen=True):
    """One fault of a problem file (ошибка в файле задачи).

    ``path`` is the place, as ``links.2.slides.on``; ``expected`` and ``got`` describe the value
    there; ``hint`` is the next action, for instance the nearest name. ``choices`` are the allowed
    values, where the file must use one of them.
    """

    path: str
    message: str
    hint: str = ""
    choices: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        force_setattr(self, "message", translate(self.message))
        force_setattr(self, "hint", translate(self.hint))

    def __str__(self) -> str:
        text = f"{self.path}: {self.message}" if self.path else self.message
        return f"{text}. {self.hint}" if self.hint else text


class ProblemError(PlanMethodError):
    """A problem file is faulty; all its faults are in `faults`."""

    exit_code = ExitCode.PROBLEM
    head = "{0}: {1} fault{1:||s} in the problem file"

    def __init__(self, source: str, faults: Sequence[Fault]) -> None:
        self.source = source
        self.faults = tuple(faults)
        head = translate(self.head, source, len(self.faults))
        super().__init__("\n".join([head, *(f"  {fault}" for fault in self.faults)]))


class CompositionError(ProblemError):
    """A layout file of sheets is faulty (файл компоновки)."""

    exit_code = ExitCode.USAGE
    head = "{0}: {1} fault{1:||s} in the layout file"


class ConfigError(ProblemError):
    """The user's config file is faulty; all its faults are in `faults`."""

    exit_code = ExitCode.USAGE
    head = "{0}: {1} fault{1:||s} in the config file"


class ArgumentError(PlanMethodError, ValueError):
    """A Python program passes a value that a function does not accept."""

    exit_code = ExitCode.USAGE


class ProgramError(PlanMethodError):
    """A construction program is malformed: an internal error, never the user's."""


class AssemblyError(PlanMethodError):
    """The mechanism cannot be assembled, or a plan cannot be closed, in a requested position."""

    exit_code = ExitCode.ASSEMBLY


class LayoutError(PlanMethodError):
    """The blocks of a sheet do not fit the paper."""

    exit_code = ExitCode.USAGE


class OutputError(PlanMethodError):
    """A file cannot be written."""

    exit_code = ExitCode.USAGE


class StructureError(PlanMethodError):
    """The links and pairs do not make a mechanism that the stated driver moves definitely."""

    exit_code = ExitCode.PROBLEM
