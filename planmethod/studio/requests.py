"""Possible requests, their limits, and the location of a fault in a file."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from math import isfinite
from pathlib import Path
from typing import Annotated, Any

from msgspec import Meta, MsgspecError, Struct
from msgspec.json import Decoder

from planmethod.errors import ArgumentError, Fault
from planmethod.note.wording import get_language
from planmethod.problem import FAMILIES, OTHER_FAMILIES

MB = 1 << 20

NO_MEMORY = "This takes more memory than is available. Request less."
NESTING_TOO_DEEP = "This is nested too deep to be computed. Request less."
"""Reasons for a missing result, with a server or without."""


class StudioLimits(Struct, frozen=True, kw_only=True):
    """Limits of requests (пределы студии).

    Attributes
    ----------
    seconds, slow_seconds, trusted_seconds : float
        Processor time for one computation; for a note or a project; for a request of an
        instructor.
    memory : int or None
        Address space of a worker process, bytes; if the system can bound it.
    text, upload, uploads : int
        Bytes of a problem file with its request, of one submission, of all those of a session.
    written : int
        Bytes of a file that a computation writes.
    waiting, session_waiting : int
        Computations that wait, of all and of one session.
    works : int
        Maximum number of submissions of a session.
    sessions : int
        Concurrent sessions: a new one replaces the oldest that has no computation.
    idle : float
        Seconds without a request after which a session is deleted.
    stored_results : int
        Computations of a session whose files are kept.
    rate, burst : float
        Computations a second that a session gets in the long run, and at once.
    entries : float
        Sessions a second that one address gets in the long run; ``entered``: at once.
    """

    seconds: float = 10.0
    slow_seconds: float = 120.0
    trusted_seconds: float = 120.0
    memory: int | None = 500 * MB
    text: int = 512 * 1024
    upload: int = 5 * MB
    uploads: int = 20 * MB
    works: int = 2000
    written: int = 64 * MB
    waiting: int = 200
    session_waiting: int = 4
    sessions: int = 500
    idle: float = 2 * 3600.0
    stored_results: int = 6
    rate: float = 4.0
    burst: float = 40.0
    entries: float = 1.0
    entered: float = 120.0


PUBLIC_LIMITS = StudioLimits()
LOCAL_LIMITS = StudioLimits(
    seconds=600.0, slow_seconds=600.0, trusted_seconds=600.0, memory=None, idle=24 * 3600.0,
    rate=50.0,
)  # fmt: skip
"""On one's own machine: its user stops what takes too long."""


class Bucket(Struct):
    """Leaky bucket: a limited burst, and a limited rate in the long run (частота запросов)."""

    level: float = 0.0
    then: float = 0.0

    def admit(self, now: float, *, rate: float, burst: float) -> bool:
        """Take one more at a time, s, unless it is too soon."""
        self.level = max(0.0, self.level - (now - self.then) * rate)
        self.then = now
        if self.level + 1 > burst:
            return False
        self.level += 1
        return True


_HEADER = re.compile(r"^\s*+(\[{1,2}+)([^\]]++)\]{1,2}+\s*+(?:#.*)?$")
_NAME = r"""(?:[\w-]++|"[^"]*+"|'[^']*+')"""
_KEY = re.compile(rf"^\s*+({_NAME}(?:\s*+\.\s*+{_NAME})*+)\s*+=")
_PART = re.compile(r"""[\w-]+|"[^"]*"|'[^']*'""")


def place_of(text: str, fault: Fault) -> tuple[int, int] | None:
    """Return the line and the column of a fault, both from 1; None if unknown.

    A syntax error states them; another fault names a key, found by its longest matching path.
    """
    numbers = re.fullmatch(r"\D*(\d+)\D+(\d+)\D*", fault.path)
    if numbers is not None and " " in fault.path:
        return int(numbers[1]), int(numbers[2])
    said = re.match(r"\w+ (\d+)\b", fault.message) if not fault.path else None
    if said is not None:
        return int(said[1]), 1
    wanted = _parts(fault.path.split(" ")[0].replace("[", ".").replace("]", ""))
    best: tuple[int, int, int] | None = None
    for own, line, column in _keys(text):
        same = next((k for k, (a, b) in enumerate(zip(own, wanted, strict=False)) if a != b), None)
        depth = min(len(own), len(wanted)) if same is None else same
        whole = same is None and len(own) <= len(wanted)
        if (whole or depth == len(wanted)) and depth and (best is None or depth > best[0]):
            best = depth, line, column
    return None if best is None else best[1:]


def _parts(path: str) -> tuple[str, ...]:
    return tuple(part.strip("\"'") for part in _PART.findall(path))


def _keys(text: str) -> Iterator[tuple[Sequence[str], int, int]]:
    """Yield the headers and keys of a text with their lines and columns; arrays by number from 0.

    A half-typed text is not valid TOML: lines are parsed one by one.
    """
    table: tuple[str, ...] = ()
    count: dict[tuple[str, ...], int] = {}
    for number, line in enumerate(text.split("\n"), 1):
        if (header := _HEADER.match(line)) is not None:
            table = _parts(header[2].strip())
            if len(header[1]) == 2:
                count[table] = count.get(table, -1) + 1
            for depth in range(len(table), 0, -1):
                if table[:depth] in count:
                    table = (*table[:depth], str(count[table[:depth]]), *table[depth:])
            yield table, number, line.index("[") + 1
        elif (key := _KEY.match(line)) is not None:
            own = (*table, *_parts(key[1]))
            yield own, number, key.start(1) + 1
            for inner in re.finditer(r"[{,]\s*([\w-]+)\s*=", line):
                yield (*own, inner[1]), number, inner.start(1) + 1


ACTS = (
    "sketched", "modelled", "assemblies", "sheets", "command", "questions", "verdicts", "checked",
    "varied",
)  # fmt: skip
QUICK = ("sketched", "modelled", "pictured", "questions")
"""Computations that run at each keystroke."""

TRUSTED = ("checked", "varied")
"""Computations for instructors only, on a public server."""

COMMANDS = (
    "tables",
    "protocol",
    "structure",
    "live",
    "play",
    "pdf",
    "dxf",
    "svg",
    "note",
    "project",
    "form",
)
TRUSTED_COMMANDS = ("key",)
SLOW = ("note", "project")
"""Commands that take minutes of processor time."""

WORKS = (".csv", ".xlsx", ".json", ".toml", ".txt", ".dxf", ".svg")
"""Suffixes of submission files."""

MAX_VARIANTS = 60
MAX_DEPTH = 32
"""Maximum depth of objects and lists in a submission."""

MAX_NAME_BYTES = 200
"""Bytes of the name of a file: systems take 255."""


class StudioRequest(Struct, frozen=True, kw_only=True):
    """Request from the page (запрос страницы); other types are rejected.

    Attributes
    ----------
    text, name, variant : str or None
        The problem file, what it is called, and which variant of it is meant.
    what, layout : str or None
        Which command, which composition of its sheets.
    colour : bool
        Lines of sheets have the colours of their meanings, whatever the file has.
    work : dict or None
        A submission, as in JSON.
    drawn : dict
        Where points were drawn by hand, m: of several assemblies the nearest is meant.
    by_hand : list of dict
        Points and remarks of the instructor.
    count, seed : int or None
        Of variants.
    token, file, mark, over
        Of the instructor; of one's own file, and whether to overwrite a conflicting version.
    """

    text: str = ""
    name: str | None = None
    variant: str | None = None
    what: str | None = None
    layout: str | None = None
    colour: bool = False
    work: dict[str, Any] | None = None
    drawn: Annotated[dict[str, tuple[float, float]], Meta(max_length=400)] = {}
    by_hand: Annotated[list[dict[str, str]], Meta(max_length=10_000)] = []
    count: int | None = None
    seed: int | None = None
    moodle: bool = False
    token: str = ""
    file: str = ""
    mark: str = ""
    over: bool = False


_DECODER = Decoder(StudioRequest)


def request_of(data: bytes) -> StudioRequest:
    """Return the request in JSON data.

    Raises
    ------
    ArgumentError
        It is no JSON, no object, of another type than the page sends, or nested too deep.
    """
    try:
        found = _DECODER.decode(data or b"{}")
        deep = _is_deeper(found.work, MAX_DEPTH)
    except (MsgspecError, ValueError) as error:
        named = re.search(r"at `\$\.(\w+)", str(error))
        if named is None:
            raise ArgumentError("This is not valid JSON from the page. Reload the page.") from None
        phrase = "'{}' does not have the type that the page sends. Reload the page."
        raise ArgumentError(phrase, named[1]) from None
    except RecursionError:
        deep = True
    if deep:
        raise ArgumentError(
            "This is nested deeper than {} levels. A submission has three.", MAX_DEPTH
        )
    return found


def _is_deeper(value: object, limit: int) -> bool:
    inner: Iterable[object] = ()
    if isinstance(value, dict):
        inner = value.values()
    elif isinstance(value, list):
        inner = value
    return any(limit == 0 or _is_deeper(one, limit - 1) for one in inner)


def page_data(lang: str, layouts: Sequence[str], uploads: int) -> dict[str, Any]:
    """Return the data of the page in a language, wherever it is served from."""
    families = {name: get_language(lang).families[name] for name in (*FAMILIES, *OTHER_FAMILIES)}
    return {
        "served": False, "files": (), "one": False, "layouts": layouts, "families": families,
        "uploads": uploads, "works": WORKS,
    }  # fmt: skip


def upload_name(name: str) -> str | None:
    """Return the plain name of an uploaded submission; None if it is not one."""
    plain = Path(name).name
    is_one = Path(plain).suffix.lower() in WORKS and plain.isprintable()
    return plain if is_one and len(plain.encode()) <= MAX_NAME_BYTES else None


def build_job(
    do: str,
    request: StudioRequest,
    *,
    lang: str,
    layouts: Sequence[str],
    works: Path,
    served: bool = False,
) -> dict[str, Any] | None:
    """Return the job for a process, with validated parts of the request; None for unknown ones.

    Parameters
    ----------
    do : str
        One of `ACTS`.
    works : Path
        Folder of the uploaded submissions.
    served : bool
        Strangers come.
    """
    if do == "command" and request.what not in (*COMMANDS, *TRUSTED_COMMANDS):
        return None
    asked: dict[str, Any] = {
        "do": do, "what": request.what, "lang": lang, "served": served,
        "name": _name(request.name or ""), "text": request.text,
        "variant": request.variant[:100] if request.variant else None,
        "layout": request.layout if request.layout in layouts else None,
        "colour": request.colour,
    }  # fmt: skip
    if asked["variant"] and asked["variant"].startswith("-"):
        return None
    if do == "modelled":
        asked["drawn"] = {
            name: place for name, place in request.drawn.items() if all(map(isfinite, place))
        }
    if do == "verdicts":
        asked["work"] = request.work
    if do == "checked":
        asked["by_hand"] = request.by_hand
        asked["works"] = sorted(str(path) for path in works.iterdir())
    if do == "varied":
        asked["count"] = _number(request.count, MAX_VARIANTS)
        asked["seed"] = _number(request.seed, 1_000_000)
        asked["moodle"] = request.moodle
    return asked


def _name(text: str) -> str:
    """Return a file name made from typed text."""
    plain = re.sub(r"[^\w-]+", "-", Path(text).stem).strip("-_")[:60]
    return plain or "problem"


def _number(value: int | None, limit: int) -> int:
    return min(max(value or 1, 1), limit)
