"""The formats that are read, and how a file of them becomes a mechanism (импорт)."""

from __future__ import annotations

import stat
from collections.abc import Callable
from pathlib import Path

from msgspec import Struct
from msgspec.structs import replace

from planmethod.arguments import text as words
from planmethod.errors import ArgumentError
from planmethod.languages import translate
from planmethod.peers.foreign import SIZE_LIMIT, ForeignMechanism, reject
from planmethod.peers.linkage2 import is_linkage2, read_linkage2
from planmethod.peers.pmks import is_pmks, read_pmks
from planmethod.peers.pylinkage import is_pylinkage, read_pylinkage
from planmethod.peers.pyslvs import is_pyslvs, read_pyslvs
from planmethod.peers.table import problem_table
from planmethod.problem.names import UNITS
from planmethod.scripting.mechanism import Mechanism

Reader = Callable[[str, str], ForeignMechanism]

FORMATS: dict[str, tuple[Callable[[str], bool], Reader]] = {
    "Linkage": (is_linkage2, read_linkage2),
    "pylinkage": (is_pylinkage, read_pylinkage),
    "Pyslvs": (is_pyslvs, read_pyslvs),
    "PMKS+": (is_pmks, read_pmks),
}
"""How a text of each program is recognised and read."""

UNITLESS = ("pylinkage", "Pyslvs")
"""Programs whose files have no unit of lengths."""


class Imported(Struct, frozen=True):
    """A mechanism of another program (импортированный механизм).

    Attributes
    ----------
    mechanism : Mechanism
        It has the coordinates of the file in ``[drawn] points``.
    program : str
    remarks : tuple of str
        What was not understood, or assumed.
    """

    mechanism: Mechanism
    program: str
    remarks: tuple[str, ...]


def load(path: str | Path, *, units: str | None = None) -> Imported:
    """Read a file of another program: PMKS+, Linkage, pylinkage or Pyslvs (импорт).

    Parameters
    ----------
    units : str, optional
        Unit of the lengths of a file that has none: ``m``, ``cm``, ``mm``, ``in``. Default: that of
        the program.

    Raises
    ------
    ProblemError
        The file is damaged, is of no known program, or has a mechanism that planmethod lacks.
    """
    path = Path(path)
    return loads(read_text(path), name=path.stem, units=units, source=str(path))


def read_text(path: Path) -> str:
    """Return the text of a file.

    Raises
    ------
    ProblemError
        It cannot be read, or is too large.
    """
    try:
        if not stat.S_ISREG(path.stat().st_mode):
            reject(str(path), "this is not an ordinary file")
        with path.open("rb") as stream:
            data = stream.read(SIZE_LIMIT + 1)
    except (OSError, ValueError) as error:
        reject(str(path), "the file cannot be read: {}", getattr(error, "strerror", error))
    if data.startswith(b"\x89HDF"):
        reject(str(path), "this is HDF5", hint="Save the project of Pyslvs as YAML.")
    if len(data) > SIZE_LIMIT:
        reject(str(path), "the file is larger than {} bytes", SIZE_LIMIT)
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("latin-1")  # Linkage writes the code page of Windows


def loads(
    text: str, *, name: str = "mechanism", units: str | None = None, source: str | None = None
) -> Imported:
    """Read the same from a text, also a share link of PMKS+.

    Raises
    ------
    ProblemError
        As of `load`.
    """
    source = source or name
    if len(words("text", text)) > SIZE_LIMIT:
        reject(source, "the file is larger than {} bytes", SIZE_LIMIT)
    program = next((one for one, (is_of, _) in FORMATS.items() if is_of(text)), None)
    if program is None:
        known = ", ".join(FORMATS)
        reject(source, "this is a file of none of these programs: {}", known)
    _, read = FORMATS[program]
    return _imported(read(text, source), program, name, units, source)


def _imported(
    mechanism: ForeignMechanism, program: str, name: str, units: str | None, source: str
) -> Imported:
    if units is not None:
        if units not in UNITS:
            raise ArgumentError("units: expected one of {}, got {!r}.", ", ".join(UNITS), units)
        if program not in UNITLESS:
            raise ArgumentError("units: a file of {} has its own unit.", program)
        mechanism = replace(mechanism, unit=units)
    elif program in UNITLESS:
        message = "the file has no unit: lengths are read as {}"
        mechanism = replace(
            mechanism, remarks=(*mechanism.remarks, translate(message, mechanism.unit))
        )
    table, remarks = problem_table(mechanism, source)
    return Imported(Mechanism.from_dict(table, name=name), program, tuple(remarks))
