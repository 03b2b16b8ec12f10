"""Parsing of a file or a text to a TOML table, within bounds."""

from __future__ import annotations

import codecs
import re
import stat
import tomllib
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from typing import Any

from planmethod.errors import Fault, ProblemError
from planmethod.languages import translate
from planmethod.problem.names import listed, nearest_name
from planmethod.problem.typos import line_hint

SIZE_LIMIT = 256 * 1024
TABLE_LIMIT = 1024 * 1024
LINE_LIMIT = 8192
"""Longest line, in characters; lists of numbers may be in a longer one."""

_BETWEEN_RE = r"[ \t\[\]]{0,99}"
_ITEM_RE = rf"{_BETWEEN_RE}[-+0-9.eE_]{{1,40}}{_BETWEEN_RE}"
_NUMBERS_RE = (
    rf"(?:[^=\[\]#\"']{{1,200}}=)?(?:{_ITEM_RE},)*(?:{_ITEM_RE}|{_BETWEEN_RE})(?:#.{{0,200}})?"
)
"""A line of numbers alone, or the list of numbers of a key; without many blanks in a row."""

DEPTH_LIMIT = 12

_WHERE_RE = r"(?s)^(?P<what>.*?) \(at (?P<where>line \d+, column \d+|end of document)\)$"
_STRINGS_RE = (
    r"(?s)#[^\n]*+"
    r'|"""(?:[^"\\]|\\.|"(?!""))*+(?:"{3,5}+|\Z)'
    r"|'''(?:[^']|'(?!''))*+(?:'{3,5}+|\Z)"
    r'|"(?:[^"\\\n]|\\[^\n])*+"?'
    r"|'[^'\n]*+'?"
)
"""Comments and strings; one that is not closed ends where the parser will stop."""

# the parser's time grows with the square of the parts of a key
_KEY_RE = rf"(?<![\w-])[\w-]++(?:[ \t]*+\.[ \t]*+[\w-]++){{{DEPTH_LIMIT},}}"
_BOMS = (
    (b"\xff\xfe", "UTF-16"),
    (b"\xfe\xff", "UTF-16"),
)


def read_source(path: Path) -> str:
    """Return the text of a problem file.

    Raises
    ------
    ProblemError
        The file cannot be read, is too large, or is not UTF-8 (a byte order mark is allowed).
    """
    name = str(path)
    try:
        mode = path.stat().st_mode
        if stat.S_ISDIR(mode):
            raise _fail(name, "this is a directory", "Name the file itself, *.toml.")
        if not stat.S_ISREG(mode):
            raise _fail(name, "this is not an ordinary file", "Name a file, *.toml.")
        with path.open("rb") as stream:
            data = stream.read(SIZE_LIMIT + 1)
    except FileNotFoundError:
        raise _fail(name, "there is no such file", _nearby(path)) from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise _fail(
            name,
            translate("the file cannot be read: {}", reason),
            "Check the path and the permissions.",
        ) from None
    if len(data) > SIZE_LIMIT:
        raise _too_large(name)
    for mark, encoding in _BOMS:
        if data.startswith(mark):
            raise _fail(
                name, translate("the file is in {}, expected UTF-8", encoding), "Save it as UTF-8."
            )
    try:
        text = data.decode("utf-8-sig")  # Notepad's mark at the start is skipped
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise _fail(
            name,
            translate("line {}: byte 0x{:02X} is not UTF-8", line, data[error.start]),
            "Save the file as UTF-8; Russian text is often saved as Windows-1251 by mistake.",
        ) from None
    _bounded(text, name)
    return text


def table_text(data: bytes) -> str:
    """Return the text of a table in UTF-8, UTF-16 with its mark, or cp1251."""
    if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        return data.decode("utf-16", "replace")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("cp1251", "replace")


@lru_cache(maxsize=2)
def parse(text: str, *, name: str) -> Mapping[str, Any]:
    """Parse TOML within bounds; the same text gives the same table, which must not be changed.

    Raises
    ------
    ProblemError
        A syntax error (with line and column and the likely cause), or a bound is exceeded.
    """
    if len(text.encode("utf-8", "replace")) > SIZE_LIMIT:
        raise _too_large(name)
    text = text.removeprefix("\ufeff")
    _bounded(text, name)
    text = re.sub(_VARIANT_HEADER, _quoted, text)
    try:
        table = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise ProblemError(name, [_syntax_fault(str(error), text.split("\n"))]) from None
    except RecursionError:
        raise _fail(name, "lists or tables are nested too deeply", _DEPTH_HINT) from None
    except ValueError as error:
        # Python bounds the digits of an integer, and dates are checked late
        raise _fail(name, translate("a value cannot be read: {}", str(error)[:180])) from None
    if _depth_exceeds(table, DEPTH_LIMIT):
        raise _fail(
            name, translate("tables are nested deeper than {} levels", DEPTH_LIMIT), _DEPTH_HINT
        )
    return table


def _bounded(text: str, name: str) -> None:
    """Reject text that is unsafe for the parser and the patterns."""
    for number, line in enumerate(text.split("\n"), 1):
        if len(line) > LINE_LIMIT and not re.fullmatch(_NUMBERS_RE, line):
            raise _fail(
                name,
                translate(
                    "line {} has {} characters, the limit is {}", number, len(line), LINE_LIMIT
                ),
                "Break it up; lists may span several lines.",
            )
    bare = re.sub(_STRINGS_RE, lambda one: "x" + "\n" * one[0].count("\n"), text)
    if deep := re.search(_KEY_RE, bare):
        number = bare.count("\n", 0, deep.start()) + 1
        raise _fail(
            name, translate("line {}: a key has over {} parts", number, DEPTH_LIMIT), _DEPTH_HINT
        )


_VARIANT_HEADER = r"(?m)^([ \t]*\[[ \t]*variants[ \t]*\.[ \t]*)([^\W\d_][\w-]*)"


def _quoted(header: re.Match[str]) -> str:
    """Quote a variant's Russian name: TOML's bare keys are Latin only, students' are not."""
    start, name = header.groups()
    return f"{start}{name}" if name.isascii() else f'{start}"{name}"'


_DEPTH_HINT = "No more is needed than links.2.D.at."


def _fail(name: str, message: str, hint: str = "") -> ProblemError:
    return ProblemError(name, [Fault("", message, hint)])


def _too_large(name: str) -> ProblemError:
    return _fail(
        name,
        translate("the file is larger than {} bytes ({} KiB)", SIZE_LIMIT, SIZE_LIMIT // 1024),
        "A few kilobytes are enough; is this the right file?",
    )


def _nearby(path: Path) -> str:
    """Hint for a missing file: the nearest names in its folder, or those that are there."""
    try:
        if not path.parent.is_dir():
            return translate("The folder '{}' does not exist either. Check the path.", path.parent)
        found = zip(range(1000), path.parent.glob("*.toml"), strict=False)
        names = sorted(p.name for _, p in found if p.is_file())  # no link that leads nowhere
    except (OSError, ValueError):
        names = []
    # The typed name may lack the extension, and a common extension would make all names similar.
    of_stem = {Path(name).stem: name for name in names}
    guess = of_stem.get(path.name) or of_stem.get(nearest_name(path.stem, of_stem) or "")
    if guess:
        return translate("Did you mean '{}'?", path.with_name(guess))
    if names:
        return translate("In '{}' there are {}.", path.parent, listed(names, limit=6))
    return "Check the path."


def _depth_exceeds(table: Mapping[str, Any], limit: int) -> bool:
    """Return whether values are nested deeper than a limit; a loop, as the input is untrusted."""
    level: list[Any] = [table]
    for _ in range(limit + 1):
        level = [
            child
            for value in level
            for child in (value.values() if isinstance(value, Mapping) else value)
            if isinstance(child, Mapping | list)
        ]
        if not level:
            return False
    return True


def _syntax_fault(message: str, lines: list[str]) -> Fault:
    match = re.match(_WHERE_RE, message)
    if match is None:
        return Fault("", translate("this is not TOML: {}", message))
    told, where = match["what"], match["where"]
    what = told
    if quoted := re.fullmatch(r"(.*?) ([('\"].*[)'\"])(.*)", told):
        what = translate(f"{quoted[1]} {{}}{quoted[3]}", quoted[2])
    if where == "end of document":
        return Fault(
            "", translate("{} at the end of the file", what), "Is a bracket or quote left open?"
        )
    number, column = map(int, re.findall(r"\d+", where))
    hint = line_hint(told, lines, number, column)
    where = translate("line {}, column {}", number, column)
    return Fault(where, translate("this is not TOML: {}", _lower(what)), hint)


def _lower(message: str) -> str:
    return message[:1].lower() + message[1:] if message[1:2].islower() else message
