"""Write the schema and the key references from the declared keys of flat tables.

``make schema`` writes ``planmethod/problem/schema.json`` and the tables of ``docs/reference/problem-file.md``
and ``docs/ru/reference/keys.md``. The schema's entries for other tables, and for keys with their own reader,
are written by hand and kept. The Russian descriptions of keys are in ``scripts/keys.ru.toml``;
``schema.ru.json`` is the schema with them.
"""

from __future__ import annotations

import json
import re
import tomllib
from collections.abc import Callable, Iterator, Mapping
from enum import Enum
from pathlib import Path
from typing import Any, cast

from msgspec import NODEFAULT
from msgspec.structs import fields

from planmethod.problem import keys
from planmethod.problem.records import STAMP_LIMIT, TITLE_BLOCK, TITLE_BLOCK_IN
from planmethod.problem.tables import (
    AngleKey,
    ChoiceKey,
    CustomKey,
    FlagKey,
    FlatField,
    IntegerKey,
    NumberKey,
    TextKey,
    WordKey,
    declared,
)

ROOT = Path(__file__).resolve().parents[1]
SCHEMA = ROOT / "planmethod" / "problem" / "schema.json"
RUSSIAN_SCHEMA = SCHEMA.with_suffix(".ru.json")
ENGLISH = ROOT / "docs" / "reference" / "problem-file.md"
RUSSIAN = ROOT / "docs" / "ru" / "reference" / "keys.md"
SENTENCES = ROOT / "scripts" / "keys.ru.toml"

WIDTH = 160
"""Characters of a line of the schema."""

_MOTOR = ("$defs", "machine", "properties", "motor")
PLACES: Mapping[str, tuple[str, ...]] = {
    "cycle": ("$defs", "cycle"),
    "pole": ("$defs", "cycle", "properties", "pole"),
    "scales": ("$defs", "scales"),
    "stamp": ("$defs", "stamp"),
    "sheet": ("$defs", "sheet"),
    "published": ("$defs", "published", "additionalProperties"),
    "answer": ("$defs", "answer"),
    "higher": ("$defs", "higher"),
    "dynamics": ("$defs", "dynamics"),
    "mass": ("$defs", "mass"),
    "load": ("$defs", "load"),
    "phases": ("$defs", "phases"),
    "machine": ("$defs", "machine"),
    "flywheel": ("$defs", "machine", "properties", "flywheel"),
    "motor": _MOTOR,
    "kloss": (*_MOTOR, "properties", "kloss"),
    "line": (*_MOTOR, "properties", "line"),
    "balancing": ("$defs", "balancing"),
    "balancing_force": ("$defs", "balancingForce"),
    "friction": ("$defs", "friction"),
    "pair": ("$defs", "pairFriction"),
    "bearing": ("$defs", "bearing"),
    "wheel": ("$defs", "gearWheel"),
    "picture": ("$defs", "gears", "properties", "picture"),
    "design": ("$defs", "gears", "properties", "design"),
    "meshing": ("$defs", "meshing"),
    "cam": ("$defs", "cam"),
    "project": ("$defs", "project"),
}
"""Paths of the kinds of table in the schema."""


def table_at(schema: dict[str, Any], kind: str) -> dict[str, Any]:
    """Return the schema of a kind of table."""
    for step in PLACES[kind]:
        schema = schema[step]
    return schema


def defaults_of(kind: str) -> dict[str, object]:
    """Return the defaults of the fields that have one."""
    record: Any = keys.FLAT[kind]
    every = {one.name: one.default for one in fields(record)}
    return {name: default for name, default in every.items() if default is not NODEFAULT}


# The schema --------------------------------------------------------------------------------------


def schema_text() -> str:
    """Return the schema with the declared keys filled in."""
    schema = json.loads(SCHEMA.read_text("utf-8"))
    for kind, record in keys.FLAT.items():
        table, every = table_at(schema, kind), declared(record)
        properties = table["properties"]
        table["properties"] = {
            one.name: _property(one, properties.get(one.name, {})) for one in every
        }
        required = [one.name for one in every if one.key.required]
        if required:
            table["required"] = required
    texts = {name: {"$ref": "#/$defs/field", "description": _plain(what)}
             for name, what in TITLE_BLOCK.items()}  # fmt: skip
    texts |= {lang: {"$ref": "#/$defs/stamp", "description": _plain(what)}
              for lang, what in TITLE_BLOCK_IN.items()}  # fmt: skip
    table_at(schema, "stamp")["properties"] = texts
    schema["$defs"]["field"] = {"type": "string", "maxLength": STAMP_LIMIT}
    return _printed(schema, 0) + "\n"


def russian_schema_text() -> str:
    """Return the schema with the Russian descriptions of keys, where there are any."""
    schema = json.loads(SCHEMA.read_text("utf-8"))
    sentences = tomllib.loads(SENTENCES.read_text("utf-8"))
    others = sentences.pop("schema")
    _tell(schema, others)
    for kind, known in sentences.items():
        for name, told in table_at(schema, kind)["properties"].items():
            if name in known:
                told["description"] = _plain(known[name])
    return _printed(schema, 0) + "\n"


def _tell(node: object, known: Mapping[str, str]) -> None:
    """Put sentences in place of others, everywhere below a node of the schema."""
    if isinstance(node, dict):
        said = node.get("description")
        if isinstance(said, str) and said in known:
            node["description"] = known[said]
        for inner in node.values():
            _tell(inner, known)
    elif isinstance(node, list):
        for inner in node:
            _tell(inner, known)


def _property(one: FlatField, by_hand: Mapping[str, Any]) -> dict[str, Any]:
    """Return the schema of a key; for a key with its own reader, the entry written by hand."""
    said = {"description": _plain(_sentence(one) + one.key.more)}
    match one.key:
        case NumberKey() as key:
            zero = {"exclusiveMinimum": 0} if key.positive else {}
            bounds = {"minimum": _short(key.low), "maximum": _short(key.high)}
            return {"$ref": "#/$defs/number", **zero, **bounds, **said}
        case IntegerKey() as key:
            return {"type": "integer", "minimum": key.low, "maximum": key.high, **said}
        case AngleKey():
            return {"$ref": "#/$defs/angle", **said}
        case FlagKey():
            return {"type": "boolean", **said}
        case TextKey() as key:
            return {"type": "string", "maxLength": key.limit, **said}
        case WordKey():
            return {"enum": [word.value for word in one.kind], **said}
        case ChoiceKey() as key:
            return {"enum": list(key.words), **said}
        case CustomKey():
            assert by_hand, f"{one.name}: write its type into the schema by hand"
            return {**by_hand, **said}


def _sentence(one: FlatField) -> str:
    unit = one.key.unit if isinstance(one.key, NumberKey) else ""
    return f"{one.key.sentence}, {unit}" if unit else one.key.sentence


def _plain(sentence: str) -> str:
    """Return a sentence without the signs of Markdown, as an editor shows it."""
    text = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", sentence).replace("`", "")
    return f"{text[:1].upper()}{text[1:]}."


def _short(number: float) -> float:
    return int(number) if number == int(number) and abs(number) < 1e6 else number


def _printed(value: object, depth: int) -> str:
    """Return JSON with every table on one line that has room for it."""
    if isinstance(value, dict) and value:
        parts = [f"{_one(key)}: {_printed(item, depth + 1)}" for key, item in value.items()]
        brackets = "{ ", " }"
    elif isinstance(value, list) and value:
        parts = [_printed(item, depth + 1) for item in value]
        brackets = "[", "]"
    else:
        return _one(value)
    line = ", ".join(parts).join(brackets)
    if "\n" not in line and len(line) + 2 * depth <= WIDTH:
        return line
    indent = "\n" + "  " * (depth + 1)
    first, last = (sign.strip() for sign in brackets)
    return f"{first}{indent}{f',{indent}'.join(parts)}{indent[:-2]}{last}"


def _one(value: object) -> str:
    return json.dumps(value, ensure_ascii=False)


# The references ----------------------------------------------------------------------------------

MARK = r"(?m)^(<!-- keys of (\w+) -->\n).*?(?=^$|\Z)"
"""Mark before a generated table, which ends at an empty line."""


def english_text() -> str:
    """Return ``docs/reference/problem-file.md`` with its tables of keys regenerated."""
    return _with_tables(ENGLISH.read_text("utf-8"), _english)


def russian_text() -> str:
    """Return ``docs/ru/reference/keys.md`` with its tables of keys regenerated."""
    return _with_tables(RUSSIAN.read_text("utf-8"), _russian)


def _with_tables(text: str, rows: Callable[[str], Iterator[tuple[str, str]]]) -> str:
    def table(match: re.Match[str]) -> str:
        head = match[0].splitlines()[:3]  # the mark, the heads of the columns, the line below them
        lines = [f"| `{name}` | {what} |" for name, what in rows(match[2])]
        return "\n".join([*head, *lines]) + "\n"

    return re.sub(MARK, table, text, flags=re.DOTALL | re.MULTILINE)


def _english(kind: str) -> Iterator[tuple[str, str]]:
    if kind == "stamp":
        yield from {**TITLE_BLOCK, **TITLE_BLOCK_IN}.items()
        return
    defaults = defaults_of(kind)
    for one in declared(keys.FLAT[kind]):
        facts = [_sentence(one) + _bounds(one, _ENGLISH)]
        if one.key.required:
            facts.append("required")
        elif usual := one.key.absent or _written(one, defaults.get(one.field)):
            facts.append(f"default: {usual}")
        yield one.name, "; ".join(facts) + one.key.more


def _russian(kind: str) -> Iterator[tuple[str, str]]:
    sentences = tomllib.loads(SENTENCES.read_text("utf-8"))[kind]
    if kind == "stamp":
        yield from ((name, sentences[name]) for name in (*TITLE_BLOCK, *TITLE_BLOCK_IN))
        return
    defaults = defaults_of(kind)
    for one in declared(keys.FLAT[kind]):
        if one.name not in sentences:
            raise SystemExit(f"{SENTENCES}: [{kind}] has no sentence for '{one.name}'; add it.")
        facts = [sentences[one.name] + _bounds(one, _RUSSIAN)]
        usual = "" if one.key.absent else _written(one, defaults.get(one.field))
        if one.key.required:
            facts.append("нужен")
        elif usual:
            facts.append(f"по умолчанию {usual}")
        yield one.name, "; ".join(facts)


_ENGLISH = ("{} to {}", "at most {} characters", "`true` or `false`")
_RUSSIAN = ("от {} до {}", "не больше {} знаков", "`true` или `false`")


def _bounds(one: FlatField, words: tuple[str, str, str]) -> str:
    """Return the bounds that a reader may come upon."""
    span, most, flag = words
    match one.key:
        case TextKey() as key if key.limit < STAMP_LIMIT:
            return ", " + most.format(key.limit)
        case NumberKey(low=low, high=high) if 1e-3 <= abs(high) <= 1e5 and low > -1e5:
            return ", " + span.format(f"{low:g}", f"{high:g}")
        case IntegerKey() as key:
            return ", " + span.format(key.low, key.high)
        case FlagKey():
            return f": {flag}"
        case _:
            return ""


def _written(one: FlatField, default: object) -> str:
    """Return a default as a file has it; empty where it is none."""
    if isinstance(one.key, CustomKey | TextKey) or default is None:
        return ""
    if isinstance(one.key, NumberKey) and not one.key.low <= cast("float", default) <= one.key.high:
        return ""  # the default is outside the bounds: it means that there is no value
    if isinstance(default, bool):
        return f"`{str(default).lower()}`"
    if isinstance(default, Enum):
        return f'`"{default.value}"`'
    return f"{default:g}" if isinstance(default, float) else str(default)


def main() -> None:
    """Write the schema, in both languages, and both references."""
    SCHEMA.write_text(schema_text(), "utf-8")
    RUSSIAN_SCHEMA.write_text(russian_schema_text(), "utf-8")
    ENGLISH.write_text(english_text(), "utf-8")
    RUSSIAN.write_text(russian_text(), "utf-8")


if __name__ == "__main__":
    main()
