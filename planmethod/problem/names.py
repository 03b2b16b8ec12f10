"""Names of points, links, guides and variants: allowed forms, and common mistakes.

Point names are a Latin (or unmistakably Greek) letter with digits and primes, so a pair of names
written together (``AB``, ``O3A``, ``CS3``) splits in one way only.
"""

# Cyrillic letters: letters that look like Latin ones, in names of problem files

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from types import MappingProxyType

from planmethod.languages import translate, typed
from planmethod.mechanism.model import FRAME

UNITS: Mapping[str, float] = MappingProxyType(
    {"m": 1.0, "cm": 100.0, "mm": 1000.0, "in": 1.0 / 0.0254}
)
"""Units in which a file may give its lengths: how many of them a metre has."""

POINT_NAME_LIMIT = 8
NAME_LIMIT = 24
TITLE_LIMIT = 300

LOOKALIKES: dict[str, str] = {
    **dict(zip("АВЕКМНОРСТУХІЈЅаекорсухіјѕһԛԝ", "ABEKMHOPCTYXIJSaekopcyxijshqw", strict=True)),
    **dict(zip("ΑΒΕΖΗΙΚΜΝΟΡΤΥΧο", "ABEZHIKMNOPTYXo", strict=True)),
    "З": "3",
    "′": "'",
    "’": "'",
}
"""Letters that look like a Latin letter (or a digit) and are not; primes are made equal."""

_PRIMES = "'′’"
_FOLD = str.maketrans(LOOKALIKES)
_LETTER = r"[A-Za-zΓΔΘΛΞΠΣΦΨΩα-νξπ-ω]"
_POINT = rf"{_LETTER}[0-9]{{0,3}}'{{0,3}}"
_POINT_RE = rf"{_POINT}\Z"
_POINTS_RE = rf"(?:{_POINT})+\Z"
_PAIR_RE = rf"({_POINT})({_POINT})\Z"
_LABEL_RE = r"[^\W_]+(?:[- ][^\W_]+)*'{0,3}\Z"


_LENGTHS = {"m": "{} m", "cm": "{} cm", "mm": "{} mm", "in": "{} in"}


def format_length(metres: float, unit: str, digits: int = 4) -> str:
    """Return a length for a message, in the unit of its file: ``190 mm``."""
    return translate(_LENGTHS[unit], f"{metres * UNITS[unit]:.{digits}g}")


def format_place(place: complex, unit: str) -> str:
    """Return coordinates in the unit of its file, as in the file: ``310, 120``."""
    z = place * UNITS[unit]
    return f"{z.real:.4g}, {z.imag:.4g}"


def fold(text: str) -> str:
    """Replace every look-alike letter by the Latin one (and any prime by the straight one)."""
    return text.translate(_FOLD)


def lookalikes(text: str) -> tuple[str, ...]:
    """Look-alike letters of a text, each once, in order (буквы-двойники)."""
    return tuple(dict.fromkeys(c for c in text if c in LOOKALIKES and c not in _PRIMES))


def _letter(c: str) -> str:
    """Name of a look-alike letter."""
    greek = "Ͱ" <= c <= "Ͽ"
    phrase = "the Greek letter {} (U+{:04X})" if greek else "the Cyrillic letter {} (U+{:04X})"
    return translate(phrase, c, ord(c))


def describe_lookalikes(text: str) -> str:
    """Return the message that names the non-Latin letters of a name."""
    letters = lookalikes(text)
    first = letters[0]
    digit = LOOKALIKES[first].isdigit()
    kind = "expected the digit{0:||s} {1}" if digit else "expected the Latin letter{0:||s} {1}"
    wanted = translate(kind, len(letters), ", ".join(f"'{LOOKALIKES[c]}'" for c in letters))
    phrase = "'{}' is {}, {}" if text == first else "'{}' has {}, {}"
    return translate(phrase, short(text), translate(" and ").join(map(_letter, letters)), wanted)


def is_point_name(text: str) -> bool:
    """Return whether a text (already folded) may name a point."""
    return len(text) <= POINT_NAME_LIMIT and re.match(_POINT_RE, text) is not None


def split_pair(text: str) -> tuple[str, str] | None:
    """Split two point names written together, ``O3A`` into ``O3`` and ``A``; None if they are not.

    Examples
    --------
    >>> split_pair("CS3")
    ('C', 'S3')
    """
    match = re.match(_PAIR_RE, text)
    return (match.group(1), match.group(2)) if match else None


def split_names(text: str) -> tuple[str, ...]:
    """Split any number of point names written together; nothing if they are not.

    Examples
    --------
    >>> split_names("AO3D")
    ('A', 'O3', 'D')
    """
    return tuple(re.findall(_POINT, text)) if re.match(_POINTS_RE, text) else ()


def angle_lines(letters: str) -> tuple[tuple[str, str], tuple[str, str]] | None:
    """Return the two lines that the letters of an angle name, from the first to the second.

    None where they are neither three points nor four, or a line has one point twice.

    Examples
    --------
    >>> angle_lines("AOD"), angle_lines("ABCD")
    ((('O', 'A'), ('O', 'D')), (('A', 'B'), ('C', 'D')))
    """
    match split_names(letters):
        case (a, vertex, b) if vertex not in (a, b):
            return (vertex, a), (vertex, b)
        case (a, b, c, d) if a != b and c != d:
            return (a, b), (c, d)
    return None


def is_label(text: str) -> bool:
    """Return whether a text may name a link, guide or variant: letters and digits, any alphabet."""
    return 0 < len(text) <= NAME_LIMIT and re.match(_LABEL_RE, text) is not None


def looks_latin(text: str) -> bool:
    """Return whether a name would be Latin throughout but for look-alikes: ``2а``, ``у-у``.

    A word such as ``шатун`` has letters unlike any Latin ones and is left unchanged.
    """
    return bool(lookalikes(text)) and fold(text).isascii()


def nearest_name(name: str, known: Iterable[str]) -> str | None:
    """Return the nearest of the known names, or None when none is close (ближайшее имя)."""
    from difflib import get_close_matches

    choices = list(dict.fromkeys(known))
    words = (name.casefold(), name.casefold().rstrip("_0123456789₀₁₂₃₄₅₆"))
    for choice in (key for word in words for key in typed().get(word, ())):
        if choice in choices:
            return choice
    folded = fold(name).casefold()
    for choice in choices:
        if choice.casefold() == folded:
            return choice
    found = get_close_matches(fold(name), choices, 1, 0.6)
    return found[0] if found else None


def nearest_name_hint(name: str, known: Iterable[str], otherwise: str = "") -> str:
    """Return the hint that names the nearest of the known names, else another one."""
    guess = nearest_name(name, known)
    return translate("Did you mean '{}'?", guess) if guess else otherwise


def listed(names: Iterable[str], *, limit: int = 12) -> str:
    """Names in one line for a message, cut when there are many."""
    every = list(names)
    text = ", ".join(every[:limit])
    return translate("{}, ... ({} in all)", text, len(every)) if len(every) > limit else text


def indexed(name: str) -> str:
    """Return the letter of a load with its index: ``F3`` is ``F_{3}``, ``Fрез`` is ``F_{рез}``."""
    return re.sub(_INDEX, lambda found: "{}_{{{}}}".format(*filter(None, found.groups())), name)


_INDEX = r"\A(?:([A-Z])(\d*[а-яё]+\d*)|([^\W\d_]+)(\d+))(?='*\Z)"
"""Small Cyrillic letters behind a Latin one, or a number behind letters."""


def short(text: str, limit: int = 40) -> str:
    """Cut an untrusted text to a length that fits a message."""
    return text if len(text) <= limit else text[: limit - 3] + "..."


def segment(key: str) -> str:
    """One part of a dotted path, in quotes unless it is letters and digits."""
    shown = short(key, 60)
    if shown and all(c.isalnum() or c in "_-'′" for c in shown):
        return shown
    plain = (c if c.isprintable() and c not in '"\\' else f"\\u{ord(c):04x}" for c in shown)
    return '"' + "".join(plain) + '"'


def joined(*parts: str) -> str:
    """Dotted path of keys; empty parts are left out."""
    return ".".join(part for part in parts if part)


def pair_name(joint: str, one: str, second: str) -> str:
    """Return the name of a kinematic pair: its joint and its links, the frame last.

    Examples
    --------
    >>> pair_name("B", "0", "3"), pair_name("B", "3", "2")
    ('B 3-0', 'B 2-3')
    """
    first, last = sorted((one, second), key=lambda link: (link == FRAME, link))
    return f"{joint} {first}-{last}"
