"""Likely meanings of lines and values that cannot be read, as hints (описки)."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Sequence

from planmethod.languages import translate, typed
from planmethod.problem.formula import FormulaError, evaluate_arithmetic
from planmethod.problem.names import describe_lookalikes, fold, listed, looks_latin

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
        return translate("Write it so: {}", meant)
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
        return 'Write the number without its unit: units = "mm" says it once for all lengths.'
    if "=" not in code and not code.startswith("["):
        return "A line must be 'key = value' or '[table]'."
    if "overwrite" in message or "twice" in message:
        return "The same key or table appears above; keep one of them."
    if re.search(r"=\s*$", code):
        return "A value is missing after '='."
    if re.search(r"=\s*[^\W\d]", code) and "true" not in code and "false" not in code:
        return "Text must be in quotes."
    return translate("Look at this line near column {}: {}", column, code[:60]) if code else ""


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
    return translate("Units are {}; {} is none of them.", _UNITS, said[1].strip())


_UNITS = "mm, cm, m, in, ft, °, rad, 1/s, rad/s, rpm, N, kN, kg, g, Pa, MPa, bar"
"""Some of those that a number may have."""
