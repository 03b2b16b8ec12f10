"""Parsing of a file or a text to a TOML table, within bounds; likely meanings of typos."""

from __future__ import annotations

import codecs
import re
import stat
import tomllib
from collections.abc import Mapping, Sequence
from functools import lru_cache
from pathlib import Path
from typing import Any

from planmethod.errors import Fault, ProblemError
from planmethod.languages import translate, typed
from planmethod.problem.formula import FormulaError, evaluate_arithmetic
from planmethod.problem.names import describe_lookalikes, fold, listed, looks_latin, nearest_name

_COMMA = r"[^#\"\[{=]*=\s*([-+]?\d+),(\d+)"
"""A number with a decimal comma (десятичная запятая) after its key."""

_NUMBER = r"[-+]?\d+(?:\.\d+)?"

_REPAIRS = (
    (r"[«»“”„‟]", '"'),
    (r"[−–—](?=\s*[\d.])", "-"),
    (r"\s//.*|;\s*$", ""),
    (r"^(\s*[\w.'\"-]+)\s*+:\s*+(?=[^=]*$)", r"\1 = "),
    (r"=\s*=", "="),
    (r"(?<=\d),(?=0\d)", "."),
    (rf"=\s*\(\s*({_NUMBER})\s*[,;]\s*({_NUMBER})\s*\)", r"= [\1, \2]"),
    (
        rf"=\s*({_NUMBER})(?::|\.\.+)({_NUMBER}):({_NUMBER})\s*$",
        r"= { from = \1, to = \2, step = \3 }",
    ),
    (rf"=\s*({_NUMBER}(?:\s*[,;]\s*{_NUMBER})+)\s*$", r"= [\1]"),
    (rf"=\s*({_NUMBER})\s*°", r"= \1"),
    (r"(?<=[\[,])(\s*)([^\W\d]\w*'*)(?=\s*[,\]])", r'\1"\2"'),
)
"""Ways in which beginners write, and TOML: pattern and replacement, one after the other."""


_SIGN = "The sign of omega, n or v gives the direction: minus is clockwise, or against the guide."

INSTEAD = {
    **dict.fromkeys(("clockwise", "cw", "ccw", "counterclockwise", "direction", "sense"), _SIGN),
    **dict.fromkeys(("rpm", "rev", "frequency"), "Revolutions per minute are n = 60."),
}
"""Keys of ``[driver]`` that people expect, and their equivalents."""


def line_hint(message: str, lines: Sequence[str], number: int, column: int) -> str:
    """Guess the likely cause of a syntax error, and return a hint.

    Parameters
    ----------
    message : str
        Message of the TOML parser, in English.
    number, column : int
        Its place, from 1.
    """
    line = lines[number - 1] if number <= len(lines) else ""
    code = line.split("#", 1)[0].strip()
    if hint := _key_hint(code):
        return hint
    if "immutable" in message and (listing := re.fullmatch(r"\[\[\s*(\w+)\s*\]\]", code)):
        return translate("The file lists them already: add {{ ... }} to {} = [ ... ].", listing[1])
    comma = re.match(_COMMA, code)
    if comma and not re.match(r"\s*,", code[comma.end() :]):
        text = translate("Write {0}.{1} with a decimal point, not {0},{1}.", comma[1], comma[2])
        others = [str(n) for n, other in enumerate(lines, 1) if re.match(_COMMA, other)]
        others.remove(str(number))
        return translate("{} The same in lines: {}.", text, listed(others)) if others else text
    if (meant := _repaired(code)) and meant != code:
        return translate("Write: {}", meant)
    if code.count('"') % 2:
        return "The closing quote is missing."
    if code.count("{") > code.count("}"):
        return "The closing brace is missing: a table in braces must be on one line."
    opened = [n for n in range(1, number + 1) if lines[n - 1].count("[") > lines[n - 1].count("]")]
    if opened and "rray" in message:
        return translate("The bracket that is opened in line {} is not closed.", opened[-1])
    if code.count("[") > code.count("]"):
        return "The closing bracket is missing."
    if re.match(r"[^=]*=\s*[-+]?[\d.]+\s*[^\W\d_]", code):
        return 'Write the number without its unit: units = "mm" sets the unit of all lengths.'
    if "=" not in code and not code.startswith("["):
        return "A line must be 'key = value' or '[table]'."
    if "overwrite" in message or "twice" in message:
        return "The same key or table appears above; keep one of them."
    if re.search(r"=\s*$", code):
        return "A value is missing after '='."
    if re.search(r"=\s*[^\W\d]", code) and "true" not in code and "false" not in code:
        return "Text must be in quotes."
    return translate("Check this line near column {}: {}", column, code[:60]) if code else ""


def _key_hint(code: str) -> str:
    """Return the hint for a key, or the name of a table, with non-Latin letters."""
    header = re.match(r"\[+([^\]\"']*)\]*", code)
    key = (header[1] if header else re.split("[=:]", code, maxsplit=1)[0]).strip()
    if re.search(r"\w\s+\w", key) and key.casefold() not in typed():
        return "A line must be 'key = value' or '[table]'; a comment begins with #."
    for part in (key, *re.split(r"[.\s]+", key)):
        if part.isascii() or not part:
            continue
        if (meant := typed().get(part.casefold())) and not (len(part) == 1 and part.isupper()):
            return translate("Keys are Latin: {} for {}.", key.replace(part, meant[0]), part)
        if "." in part or any(c in part for c in "\"'"):
            continue
        if looks_latin(part):
            return translate(
                "{}. Type '{}' in the Latin layout.", describe_lookalikes(part), fold(part)
            )
        quoted = key.replace(part, f'"{part}"')
        shown = f"[{quoted}]" if header else f"{quoted} = ..."
        return translate("A key with letters other than Latin must be in quotes: {}", shown)
    return ""


def _repaired(code: str) -> str:
    """Return the intended line of TOML; empty if none is found."""
    for pattern, put in _REPAIRS:
        code = re.sub(pattern, put, code).strip()
    try:
        return code if tomllib.loads(code) else ""
    except RecursionError:  # the parser of the file has not come to these brackets
        return ""
    except tomllib.TOMLDecodeError:
        pass
    key, _, value = (part.strip() for part in code.partition("="))
    value = re.sub(r"(?<=\d)\s*(?=[π√(]|pi|sqrt)", "*", value)
    try:
        return f'{key} = "{value}"' if evaluate_arithmetic(value) else ""
    except FormulaError:
        return ""


def value_hint(value: object) -> str:
    """Return a hint for a text where numbers are expected; empty if none."""
    if not isinstance(value, str):
        return ""
    text = value.strip(" °[]()").replace("−", "-")
    if re.fullmatch(r"[-+]?\d+[,.]\d+|[-+]?\d+", text):
        return translate("Write {} without quotes.", text.replace(",", "."))
    if span := re.fullmatch(rf"({_NUMBER})(?::|\.\.+)({_NUMBER})(?::({_NUMBER}))?", text):
        told = f"{{ from = {span[1]}, to = {span[2]}, step = {span[3] or 30} }}"
        return translate("Write {} without quotes.", told)
    if re.fullmatch(rf"{_NUMBER}(\s*[,;]\s+{_NUMBER})+|{_NUMBER}(\s*;\s*{_NUMBER})+", text):
        numbers = ", ".join(re.findall(_NUMBER, text))
        return translate("Write {} without quotes.", f"[{numbers}]")
    said = re.fullmatch(r"[-+]?\d+(?:[.,]\d+)?\s*([^\W\d_][^\d]*)", text)
    if said is None or said[1].startswith(("π", "pi", "sqrt")):
        return ""
    return translate("Units are {}; {} is not one of them.", _UNITS, said[1].strip())


_UNITS = "mm, cm, m, in, ft, °, rad, 1/s, rad/s, rpm, N, kN, kg, g, Pa, MPa, bar"
"""Some of those that a number may have."""


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
        raise _fail(name, "this file does not exist", _nearby(path)) from None
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


_DEPTH_HINT = "The deepest key is links.2.D.at."


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
