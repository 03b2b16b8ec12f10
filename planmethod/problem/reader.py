"""Read a problem file, and lay a variant over it: all faults at once."""

# Cyrillic letters: units as the head of a table may have them

from __future__ import annotations

import io
import re
import stat
from collections.abc import Iterable, Iterator, Mapping
from functools import lru_cache, partial
from itertools import pairwise
from pathlib import Path
from typing import Any, TypeAlias

from msgspec.structs import replace

from planmethod.errors import Fault, ProblemError
from planmethod.languages import current_language, translate
from planmethod.problem import keys
from planmethod.problem.drive import is_place, is_posed
from planmethod.problem.faults import FAULT_LIMIT, Faults, is_number
from planmethod.problem.file_node import FileNode, read_units
from planmethod.problem.formula import read_decimal
from planmethod.problem.linkage import TrainReader, read_parts
from planmethod.problem.model import Problem, SourceTable
from planmethod.problem.names import (
    UNITS,
    fold,
    is_point_name,
    listed,
    nearest_name,
    nearest_name_hint,
    short,
    split_names,
    split_pair,
)
from planmethod.problem.output_rates import is_output_rate
from planmethod.problem.quantities import QuantityNameError, parse_quantity
from planmethod.problem.records import TITLE_BLOCK, TITLE_BLOCK_IN
from planmethod.problem.source import TABLE_LIMIT, parse, read_source, table_text

KeyPath = tuple[str, ...]

_HOLDERS = (Mapping, list)
"""Containers in a path: a table, the loads or the answers."""

_MOTION_TABLES = ("synthesis", "frame", "drawn", "links", "driver", "assembly", *keys.OF_KINDS)
"""Tables on which all published values depend."""

TURNING = ("omega", "n", "train")
"""Keys of the driver of which one replaces the others."""

_CONTACT = ("slides", "length")
"""Key of a link on which none of them depends."""

_FORCES = ("dynamics", "loads", "springs")
"""Tables on which the published values of the force analysis depend."""


def read_variants(file: FileNode) -> dict[str, dict[KeyPath, Any]]:
    """Return the overrides of every variant, by path; unknown paths are faults."""
    return file.read("variants", partial(_read_each, base=file.value)) or {}


def _read_each(node: FileNode, base: Mapping[str, Any]) -> dict[str, dict[KeyPath, Any]]:
    node.table()
    node.require_at_most(keys.VARIANT_LIMIT, "{} variants, the limit is {}")
    found: dict[str, dict[KeyPath, Any]] = {}
    for entry in node.entries():
        if entry.attempt(_read_name) is not None:
            overrides = found[str(entry.key)] = {}
            entry.attempt(partial(_read_variant, base=base, overrides=overrides))
    return found


def _read_name(node: FileNode) -> str:
    name = str(node.key)
    node.check_label(name, "a variant")
    return name


def _read_variant(node: FileNode, base: Mapping[str, Any], overrides: dict[KeyPath, Any]) -> None:
    """Add the overrides of a variant; those of a faulty one are kept as far as they are right."""
    inner: set[KeyPath] = set()
    for where, value in _overrides(base, node.table("driver.phi = 120"), ()):
        prefixes = [where[:depth] for depth in range(1, len(where))]
        if where in overrides or where in inner or any(p in overrides for p in prefixes):
            node.at(where).note("this value is overridden twice")
        elif _check_path(node, base, where):
            overrides[where] = value
            inner.update(prefixes)


def _overrides(
    base: Mapping[str, Any], table: Mapping[str, Any], before: KeyPath
) -> Iterator[tuple[KeyPath, Any]]:
    """Yield every path of an override table; ``"driver.phi"`` in quotes means two parts."""
    for key, value in table.items():
        whole = (*before, key)
        parts = whole if _get(base, whole) is not None else (*before, *key.split("."))
        parts = _numbered(base, parts)
        under = _get(base, parts)
        if isinstance(value, Mapping) and isinstance(under, _HOLDERS) and not _is_leaf(parts):
            yield from _overrides(base, value, parts)
        else:
            yield parts, value


def _is_leaf(path: KeyPath) -> bool:
    """Return whether a table at this path is one value: a span, place, size or phase of loads."""
    if path[:1] in (("loads",), ("springs",), ("motors",), ("answers",)):
        return len(path) == 3
    return path[:-1] in (("driver",), ("point",)) or (path[:1] == ("assembly",) and len(path) > 1)


def _get(base: Any, path: KeyPath) -> Any:
    for part in path:
        key = _key(base, part)
        if isinstance(key, int):
            base = base[key]
        else:
            base = base.get(part) if isinstance(base, Mapping) else None
    return base


def _key(level: object, part: str) -> str | int:
    """Return the key for a part of a path; a load has its number from 0, or its name.

    An answer likewise, or its id.
    """
    if not isinstance(level, list) or not all(isinstance(entry, Mapping) for entry in level):
        return part
    if part.isdecimal():
        return int(part) if len(part) < 6 and int(part) < len(level) else part
    names = [entry.get("name", entry.get("id")) for entry in level]
    return names.index(part) if part in names else part


def _numbered(base: Mapping[str, Any], path: KeyPath) -> KeyPath:
    """KeyPath with the numbers of loads in place of their names."""
    return tuple(str(_key(_get(base, path[:i]), part)) for i, part in enumerate(path))


_LOAD_TABLES = {"force": "table", "couple": "table", "phases": "phases"}


def _known_under(path: KeyPath) -> tuple[str, ...]:
    """Keys that may be added to the table at a path although the main part lacks them."""
    if not path:
        return tuple(key for key in keys.TOP if key != "variants")
    first = path[0]
    if first == "links":
        return {2: keys.LINK, 3: keys.SLIDES if path[2:] == ("slides",) else keys.POINT}.get(
            len(path), ()
        )
    if first == "frame":
        return {1: keys.FRAME, 3: keys.GUIDE}.get(len(path), ())
    if first == "drawn":
        return keys.DRAWN if len(path) == 1 else ()
    if first == "published":
        return keys.known("published") if len(path) == 2 else ()
    if first == "driver" and len(path) == 2:
        return keys.SPAN
    if first == "dynamics" and len(path) > 1:
        return keys.known("mass") if path[1] == "links" and len(path) == 3 else ()
    if first == "answers":
        return keys.known("answer") if len(path) == 2 else ()
    if first == "loads":
        return keys.known({2: "load", 3: _LOAD_TABLES.get(path[-1], "")}.get(len(path), ""))
    if first == "springs":
        return keys.known("spring") if len(path) == 2 else ()
    if first == "motors":
        return keys.known("catalogue_motor") if len(path) == 2 else ()
    if first == "stamp" and path[1:] and path[1] in TITLE_BLOCK_IN:
        return tuple(TITLE_BLOCK) if len(path) == 2 else ()
    return keys.known(first) if len(path) == 1 else ()


def _may_add(path: KeyPath) -> bool:
    """Return whether a user-defined name may be added at this path: a point, a length, a rule."""
    parent, key = path[:-1], fold(path[-1])
    if len(parent) == 2 and parent[0] == "links":
        return is_point_name(key) or split_pair(key) is not None
    if parent in (("frame",), ("assembly",)):
        return is_point_name(key)
    if parent[:1] == ("links",) and parent[2:] == ("angle",):
        return len(split_names(key)) in (3, 4)
    if parent == ("driver",):
        return is_posed(path[-1]) or is_output_rate(path[-1])
    if parent == ("drawn", "points"):
        return is_point_name(key)
    if parent == ("drawn",):
        return path[-1].startswith("phi_") or split_pair(key) is not None
    return parent in (("frame", "guides"), ("published",), ("dynamics", "links"))


def _names_in(table: object) -> list[str]:
    """Names that may follow in a path."""
    if isinstance(table, list):
        entries = [(i, entry) for i, entry in enumerate(table) if isinstance(entry, Mapping)]
        return [str(e.get("name", e.get("id", i))) for i, e in entries]
    return list(table) if isinstance(table, Mapping) else []


def _check_path(node: FileNode, base: Mapping[str, Any], key_path: KeyPath) -> bool:
    """Return whether a variant may override a path."""
    if key_path[0] == "variants":
        node.at(key_path).note("a variant cannot hold variants")
        return False
    if key_path[0] in keys.OF_KINDS:
        return True
    for depth in range(1, len(key_path) + 1):
        part, parent = key_path[:depth], key_path[: depth - 1]
        known = _known_under(parent)
        if _get(base, part) is not None or part[-1] in known or _may_add(part):
            continue
        table = _get(base, parent)
        names = [*_names_in(table), *known]
        guess = nearest_name(part[-1], names) if node.faults.count < FAULT_LIMIT else None
        dotted = ".".join(key_path[:depth])
        hint = translate("Did you mean '{}'?", ".".join((*parent, guess))) if guess else ""
        node.at(key_path).note("the file has no '{}' to override", dotted, hint=hint)
        return False
    return True


def apply_variant(table: Mapping[str, Any], overrides: Mapping[KeyPath, Any]) -> dict[str, Any]:
    """Lay the overrides of a variant over the main part; the table itself is left as it is.

    Published values belong to the main part: a variant that moves differently has only its own, and
    one with other masses or loads keeps those of the motion.
    """
    result = dict(table)
    if any(path[0] in _MOTION_TABLES and path[2:] != _CONTACT for path in overrides):
        result.pop("published", None)
    elif any(path[0] in _FORCES for path in overrides):
        entries = result.get("published")
        if isinstance(entries, Mapping):
            result["published"] = {k: v for k, v in entries.items() if not _is_force_entry(v)}
    for path, value in overrides.items():
        level: Any = result
        for part, after in pairwise(path):
            level = _opened(level, part, after)
        level[_key(level, path[-1])] = value
        if path[:-1] == ("driver",):
            for other in [key for key in level if _replaces(path[-1], key)]:
                if (*path[:-1], other) not in overrides:
                    del level[other]
    return result


def _replaces(one: str, second: str) -> bool:
    """Return whether a key of the driver replaces another one, of its speed or position."""
    if one in TURNING or _is_speed(one):
        return second in TURNING or _is_speed(second)
    return is_place(one) and (is_place(second) or second == "root")


def _is_speed(key: str) -> bool:
    """Return whether a key of the driver is the velocity of an output."""
    return is_output_rate(key) and key.startswith(("v", "omega"))


def _is_force_entry(entry: object) -> bool:
    """Return whether a published value is of the force analysis; one that is faulty is not."""
    what = entry.get("what") if isinstance(entry, Mapping) else None
    try:
        return isinstance(what, str) and bool(what) and parse_quantity(what).is_loaded
    except QuantityNameError:
        return False


def _opened(level: Any, part: str, after: str) -> Any:
    """Replace the container at a part of a path by a copy, and return the copy.

    What cannot hold the part after it is replaced by an empty table.
    """
    key = _key(level, part)
    below = level[key] if isinstance(key, int) else level.get(key)
    if isinstance(_key(below, after), int):
        level[key] = list(below)
    else:
        level[key] = dict(below) if isinstance(below, Mapping) else {}
    return level[key]


_UNITS = {"м": "m", "см": "cm", "мм": "mm", "дюйм": "in", **{one: one for one in UNITS}}
_SI = (
    r"(?:°|град|deg|об/мин|rpm|(?:мин|с)[-⁻][12¹²]|(?:1|рад|rad|м|m)/[сs][²2]?"
    r"|кг|kg|Н|N|(?:Н|N|кг|kg)[·*][мm][²2]?)\Z"
)
"""Units that the file has them in: they change nothing."""

_HEAD = r"(?P<name>[^,(\[]+)(?:[,(\[](?P<unit>[^)\]]*)[)\]]?)?\Z"
_BETWEEN = r"^((?:φ|phi)_?\{?[0-9]+),([0-9]+)"
"""Angle between links, ``φ2,3``: its comma begins no unit."""
_NUMBER = r"[-+−]?[0-9]+(?:[.,][0-9]*)?(?:[eE][-+]?[0-9]+)?\Z"
_GREEK = str.maketrans(
    {"φ": "phi", "ω": "omega", "ε": "epsilon", "∠": "", "_": "", "{": "", "}": ""}
)


def with_table(file: FileNode, folder: Path | None) -> FileNode:
    """Return a file with the variants of the table that it names.

    Parameters
    ----------
    folder : Path or None
        Folder of the problem file; None for a text without a file.
    """
    name = file["variants"].value
    if not isinstance(name, str):
        return file
    variants = file["variants"].attempt(partial(_read_table, folder=folder, base=file.value))
    return file.with_value({**file.value, "variants": variants or {}})


def _read_table(
    node: FileNode, folder: Path | None, base: Mapping[str, Any]
) -> dict[str, dict[str, Any]]:
    """Return the overrides of every row of the table that a node names, by its first cell."""
    name = node.value
    path = None if folder is None else folder / name
    example = 'For example: variants = "variants.csv", beside the problem file.'
    if path is None or Path(name).name != name or not name.lower().endswith((".csv", ".txt")):
        node.reject("expected the name of a CSV file, got '{}'", short(name), hint=example)
    try:
        if not stat.S_ISREG(path.stat().st_mode):
            node.reject("{} is not an ordinary file", name, hint=example)
        with path.open("rb") as stream:
            data = stream.read(TABLE_LIMIT + 1)
    except OSError as error:
        node.reject("{} cannot be read: {}", name, error.strerror, hint=example)
    if len(data) > TABLE_LIMIT:
        node.reject("{} is larger than {} bytes", name, TABLE_LIMIT)
    return _read_rows(node, base, table_text(data)) if data else {}


def _read_rows(node: FileNode, base: Mapping[str, Any], text: str) -> dict[str, dict[str, Any]]:
    """Return the overrides of every row by its first cell; the node has the name of the table."""
    import csv

    name = node.value
    separator = next((one for one in ";\t" if one in text.partition("\n")[0]), ",")
    try:
        rows = [
            [cell.strip() for cell in row]
            for row in csv.reader(io.StringIO(text, newline=""), delimiter=separator)
            if any(cell.strip() for cell in row)
        ]
    except csv.Error as error:
        node.reject("{} is not a CSV file: {}", name, error, hint="Is a quote left open?")
    if not rows:
        node.reject("{} has no rows", name, hint="The first row names the columns.")
    columns = [node.attempt(partial(_read_column, base=base, head=head)) for head in rows[0][1:]]
    found: dict[str, dict[str, Any]] = {}
    for number, row in enumerate(rows[1:], 2):
        variant = row[0]
        if variant in found or not variant:
            what = "the variant has no name"
            if variant:
                what = translate("variant '{}' appears twice", variant)
            node.note("{}, row {}: {}", name, number, what, hint="Its name is the first cell.")
        elif len(row) > len(columns) + 1:
            cells = translate("{} cells, {} columns", len(row), len(columns) + 1)
            hint = "Is a decimal comma read as a separator? Use ';'."
            node.note("{}, row {}: {}", name, number, cells, hint=hint)
        else:
            found[variant] = {}
            for column, cell in zip(columns, row[1:], strict=False):
                if column is not None and cell:
                    _set_override(found[variant], base, *column, cell)
    return found


def _set_override(
    overrides: dict[str, Any], table: Mapping[str, Any], key: str, per: float, cell: str
) -> None:
    value: Any = cell
    if re.match(_NUMBER, cell):
        plain = cell.replace(",", ".").replace("−", "-")
        number = read_decimal(plain)
        if number is not None:
            value = int(number) if plain.lstrip("+-").isdigit() else float(number)
    if per != 1.0:
        value = value * per if is_number(value) else f"({value})*{per!r}"
    key, _, part = key.partition("[")
    if part:  # x or y of a fixed point: the other one stays
        point = key.split(".")[1]
        place = list(overrides.get(key) or table["frame"][point])
        place[int(part[0])], value = value, place
    overrides[key] = place if part else value


def key_of(table: Mapping[str, Any], written: str) -> tuple[str | None, Mapping[str, str]]:
    """Return the dotted key that a text means, None of none, and the keys by their names.

    ``frame.C[1]`` is the y of a fixed point.
    """
    names = dict(_names(table))
    first = fold(written).split(".")[0]
    if "." in written and (first in table or first in keys.TOP):
        return written, names
    return names.get(_folded(written)) or names.get(_folded(written).removeprefix("l")), names


def _read_column(node: FileNode, base: Mapping[str, Any], head: str) -> tuple[str, float]:
    """Return the dotted key of a column, and the factor of its numbers."""
    match = re.match(_HEAD, re.sub(_BETWEEN, r"\1\2", head))
    written = match["name"].rstrip() if match else head
    key, names = key_of(base, written)
    if key is None:
        hint = translate("Known: {}, and dotted keys.", listed(names))
        hint = nearest_name_hint(_folded(written), names, hint)
        node.reject("{}: column '{}' is not known", node.value, short(head), hint=hint)
    unit = (match["unit"] or "").strip() if match else ""
    if not unit or re.match(_SI, unit):
        return key, 1.0
    if unit not in _UNITS or not _is_length(key):
        node.reject("{}: '{}' is not in the unit of the file", node.value, short(head))
    own = UNITS.get(str(base.get("units", "m")), 1.0)
    return key, own / UNITS[_UNITS[unit]]


def _is_length(key: str) -> bool:
    """Return whether a key is a length of the file."""
    parts = key.split(".")
    return parts[0] == "frame" or (parts[0] == "links" and "angle" not in parts) or parts[-1] == "s"


def _folded(name: str) -> str:
    """Return a name of the "Дано" in normal form: ``φ_{1}`` and ``phi1`` are equal."""
    return fold(name.replace(" ", "").translate(_GREEK))


def _names(table: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """Yield the names of the numbers of a file in "Дано", and their dotted keys."""
    driver = table.get("driver")
    if isinstance(driver, Mapping):
        link = driver.get("link", "")
        for key in ("phi", "omega", "n", "epsilon", "s", "v", "a"):
            yield key, f"driver.{key}"
            yield f"{key}{link}", f"driver.{key}"
        yield from ((_folded(key), f"driver.{key}") for key in driver)
    for point, place in _tables(table, "frame"):
        if isinstance(place, list):
            yield f"x{point}", f"frame.{point}[0]"
            yield f"y{point}", f"frame.{point}[1]"
    yield from ((_folded(key), f"drawn.{key}") for key, _ in _tables(table, "drawn"))
    yield from ((_folded(key), f"synthesis.{key}") for key, _ in _tables(table, "synthesis"))
    for link, body in _tables(table, "links"):
        for key, value in _tables({"": body}, ""):
            if len(split_names(key)) == 2:
                yield _folded(key), f"links.{link}.{key}"
            elif key == "angle":
                yield from ((_folded(k), f"links.{link}.angle.{k}") for k, _ in _tables(body, key))
            elif key == "slides" and isinstance(value, Mapping) and "offset" in value:
                yield f"e{body.get('points', [''])[0]}", f"links.{link}.slides.offset"
        yield f"m{link}", f"dynamics.links.{link}.mass"
        yield f"J{link}", f"dynamics.links.{link}.inertia"
        yield f"JS{link}", f"dynamics.links.{link}.inertia"
    loads = table.get("loads")
    for load in loads if isinstance(loads, list) else ():
        if isinstance(load, Mapping) and isinstance(load.get("name"), str):
            size = "couple" if "couple" in load else "force"
            yield _folded(load["name"]), f"loads.{load['name']}.{size}"


def _tables(table: Mapping[str, Any], key: str) -> Iterator[tuple[str, Any]]:
    below = table.get(key)
    if isinstance(below, Mapping):
        yield from below.items()


Variants: TypeAlias = Mapping[str, Mapping[tuple[str, ...], Any]]
"""Overrides of every variant, by path."""


def load(
    path: str | Path, *, variant: str | None = None, train: TrainReader | None = None
) -> Problem:
    """Read a problem file (файл задачи).

    Parameters
    ----------
    path : str or Path
        TOML file as ``docs/reference/problem-file.md`` describes it.
    variant : str, optional
        Name of a ``[variants]`` table to lay over the main part.
    train : callable, optional
        Reads the train that drives the crank (`planmethod.linkages`). Default: no train.

    Raises
    ------
    ProblemError
        With every fault of the file: path, what was expected, what was found, the next action.
    """
    (problem,) = load_each(path, (variant,), train=train)
    return problem


def load_each(
    path: str | Path, variants: Iterable[str | None], *, train: TrainReader | None = None
) -> Iterator[Problem]:
    """Read some variants of a problem file, None for its main part: the file itself once.

    Raises
    ------
    ProblemError
        As of `load`.
    """
    path = Path(path)
    file, known = _open(path)
    names = tuple(known)  # one for all: ten thousand have as many names each
    for variant in variants:
        varied = _overlay_variant(file, known, str(path), variant)
        yield _read_varied(varied.copy(), names, str(path), path.stem, variant, train)


def _open(path: Path) -> tuple[FileNode, Variants]:
    """Return a file and its variants, which may be in a separate table file.

    A file that is loaded variant by variant is parsed once.
    """
    text = read_source(path)
    beside = isinstance(parse(text, name=str(path)).get("variants"), str)
    look = _looked_through.__wrapped__ if beside else _looked_through  # that may change alone
    file, variants = look(text, path, current_language())
    return file.copy(), variants


@lru_cache(maxsize=2)
def _looked_through(text: str, path: Path, _lang: str) -> tuple[FileNode, Variants]:
    """Return the result of `_open`, with faults in a language."""
    file = with_table(FileNode(Faults(), parse(text, name=str(path))), path.parent)
    return file, read_variants(file)


def varied(path: Path, variant: str | None) -> tuple[FileNode, tuple[str, ...]]:
    """Return a file with a variant's values, and the names of all variants.

    So reads a problem of any kind.

    Raises
    ------
    ProblemError
        The file cannot be read, or has no such variant.
    """
    file, known = _open(path)
    file = _overlay_variant(file, known, str(path), variant)
    read_units(file)
    return file, tuple(known)


def overlay_variant(
    file: FileNode, source: str, variant: str | None
) -> tuple[FileNode, tuple[str, ...]]:
    """Return a file with a variant's values, and the names of all variants.

    Raises
    ------
    ProblemError
        No such variant.
    """
    variants = read_variants(file)
    return _overlay_variant(file, variants, source, variant), tuple(variants)


def _overlay_variant(
    file: FileNode, variants: Variants, source: str, variant: str | None
) -> FileNode:
    if variant is None:
        return file
    if variant not in variants:
        raise ProblemError(source, [*file.faults.listed, unknown_variant(variant, variants)])
    return file.with_value(apply_variant(file.value, variants[variant]))


def loads(
    text: str, *, name: str, variant: str | None = None, train: TrainReader | None = None
) -> Problem:
    """Read a problem from a text; ``name`` replaces the stem of the file name."""
    table = parse(text, name=name)
    return read_parsed(table, source=name, name=name, variant=variant, train=train)


def variant_names(path: str | Path) -> tuple[str, ...]:
    """Return the names of the variants of a file, in file order.

    Raises
    ------
    ProblemError
        The file cannot be read, or its variants are faulty.
    """
    path = Path(path)
    file, variants = _open(path)
    if file.faults:
        raise ProblemError(str(path), file.faults.listed)
    return tuple(variants)


def read_parsed(
    table: Mapping[str, Any],
    *,
    source: str,
    name: str,
    variant: str | None = None,
    train: TrainReader | None = None,
) -> Problem:
    """Read a problem from its parsed TOML.

    Parameters
    ----------
    source : str
        What messages call the file.
    name : str
        Name of the problem.
    variant, train
        As of `load`.

    Raises
    ------
    ProblemError
    """
    file = with_table(FileNode(Faults(), table), None)
    file, variants = overlay_variant(file, source, variant)
    return _read_varied(file, variants, source, name, variant, train)


def _read_varied(
    file: FileNode,
    variants: tuple[str, ...],
    source: str,
    name: str,
    variant: str | None,
    train: TrainReader | None,
) -> Problem:
    table = file.value
    problem = read_parts(file, name, train)
    if file.faults or problem is None:
        raise ProblemError(source, file.faults.listed)
    return replace(
        problem,
        source_file=source,
        variants=variants,
        variant=variant,
        source_table=SourceTable(table),
    )


def unknown_variant(variant: str, known: Mapping[str, Any]) -> Fault:
    """Return the fault of a variant that a file has not, with the nearest name."""
    if not known:
        return Fault(
            "variants",
            translate("variant '{}' does not exist", variant),
            "The file has no variants.",
        )
    guess = nearest_name(variant, known) or next(
        (k for k in known if fold(k) == fold(variant)), None
    )
    hint = (
        translate("Did you mean '{}'?", guess)
        if guess
        else translate("There are {}.", listed(known))
    )
    if guess and fold(guess) == fold(variant):
        hint = translate("Did you mean '{}' in the other layout (Russian or Latin)?", guess)
    return Fault("variants", translate("variant '{}' does not exist", variant), hint)
