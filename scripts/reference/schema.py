"""The schema of problem files, from the declared keys and the sentences of the others.

The schema's types of keys with their own reader are written by hand and kept. A key's sentence is
that of its declaration, or in ``keys.en.toml``; all Russian sentences are in ``keys.ru.toml``.
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from typing import Any

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
from scripts.reference.markdown import ROOT, data

SCHEMA = ROOT / "planmethod" / "problem" / "schema.json"
RUSSIAN_SCHEMA = SCHEMA.with_suffix(".ru.json")

WIDTH = 160
"""Characters of a line of the schema."""

_MOTOR = ("$defs", "machine", "properties", "motor")
PLACES: Mapping[str, tuple[str, ...]] = {
    "top": (),
    "frame": ("$defs", "frame"),
    "guide": ("$defs", "guide"),
    "drawn": ("$defs", "drawn"),
    "synthesis": ("$defs", "synthesis"),
    "link": ("$defs", "link"),
    "point": ("$defs", "pointForm"),
    "slides": ("$defs", "slides"),
    "driver": ("$defs", "driver"),
    "span": ("$defs", "span"),
    "rule": ("$defs", "assembly", "additionalProperties", "anyOf", "1"),
    "scales": ("$defs", "scales"),
    "cycle": ("$defs", "cycle"),
    "pole": ("$defs", "cycle", "properties", "pole"),
    "project": ("$defs", "project"),
    "sheet": ("$defs", "sheet"),
    "stamp": ("$defs", "stamp"),
    "dynamics": ("$defs", "dynamics"),
    "mass": ("$defs", "mass"),
    "load": ("$defs", "load"),
    "spring": ("$defs", "spring"),
    "table": ("$defs", "table"),
    "phases": ("$defs", "phases"),
    "balancing_force": ("$defs", "balancingForce"),
    "friction": ("$defs", "friction"),
    "pair": ("$defs", "pairFriction"),
    "bearing": ("$defs", "bearing"),
    "letters": ("$defs", "sourceLetters"),
    "machine": ("$defs", "machine"),
    "flywheel": ("$defs", "machine", "properties", "flywheel"),
    "motor": _MOTOR,
    "kloss": (*_MOTOR, "properties", "kloss"),
    "line": (*_MOTOR, "properties", "line"),
    "catalogue_motor": ("$defs", "catalogueMotor"),
    "balancing": ("$defs", "balancing"),
    "higher": ("$defs", "higher"),
    "toothed": ("$defs", "toothed"),
    "rolls": ("$defs", "rolls"),
    "answer": ("$defs", "answer"),
    "published": ("$defs", "published", "additionalProperties"),
    "gears": ("$defs", "gears"),
    "wheel": ("$defs", "gearWheel"),
    "mesh": ("$defs", "gearMesh"),
    "picture": ("$defs", "gears", "properties", "picture"),
    "design": ("$defs", "gears", "properties", "design"),
    "meshing": ("$defs", "meshing"),
    "cam": ("$defs", "cam"),
    "shaft_cam": ("$defs", "shaftCam"),
    "motion": ("$defs", "camMotion"),
    "law": ("$defs", "camLaw", "anyOf", "1"),
    "moving": ("$defs", "moving"),
    "rolling": ("$defs", "rolling"),
}
"""Paths of the kinds of table in the schema, in the order of the reference."""

OTHER = tuple(kind for kind in PLACES if kind not in keys.FLAT and kind != "stamp")
"""Kinds whose sentences are in ``keys.en.toml``."""


def table_at(schema: dict[str, Any], kind: str) -> dict[str, Any]:
    """Return the schema of a kind of table."""
    found: Any = schema
    for step in PLACES[kind]:
        found = found[int(step)] if isinstance(found, list) else found[step]
    assert isinstance(found, dict)
    return found


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
    for kind in OTHER:
        _describe(table_at(schema, kind), data("keys.en")[kind])
    for kind, other in keys.EXTENDED.items():
        _add_keys_of(schema, other, to=kind)
    texts = {name: {"$ref": "#/$defs/field", "description": _plain(what)}
             for name, what in TITLE_BLOCK.items()}  # fmt: skip
    texts |= {lang: {"$ref": "#/$defs/stamp", "description": _plain(what)}
              for lang, what in TITLE_BLOCK_IN.items()}  # fmt: skip
    table_at(schema, "stamp")["properties"] = texts
    schema["$defs"]["field"] = {"type": "string", "maxLength": STAMP_LIMIT}
    return _printed(schema, 0) + "\n"


def russian_schema_text() -> str:
    """Return the schema with the Russian descriptions of tables and keys."""
    schema = json.loads(SCHEMA.read_text("utf-8"))
    sentences = data("keys.ru")
    _translate(schema, sentences["schema"])
    for kind in PLACES:
        _describe(table_at(schema, kind), sentences[kind])
    return _printed(schema, 0) + "\n"


def _add_keys_of(schema: dict[str, Any], kind: str, *, to: str) -> None:
    """Let a kind of table have all keys of another one, which it refers to."""
    table, other = table_at(schema, to), table_at(schema, kind)
    place = "/".join(("#", *PLACES[kind], "properties"))
    table["properties"] |= {name: {"$ref": f"{place}/{name}"} for name in other["properties"]}
    table["required"] = [*table.get("required", ()), *other.get("required", ())]
    table["additionalProperties"] = False


def _describe(table: dict[str, Any], sentences: Mapping[str, str]) -> None:
    """Describe the keys of a table, and its patterns by the first sentence that each matches."""
    own = table["properties"]
    for name, node in own.items():
        if "/properties/" not in node.get("$ref", ""):  # a key of another kind is described there
            node["description"] = _plain(sentences[name])
    for pattern, node in table.get("patternProperties", {}).items():
        others = [name for name in sentences if name not in own and re.search(pattern, name)]
        node["description"] = _plain(sentences[others[0]])


def _translate(node: object, known: Mapping[str, str]) -> None:
    """Put sentences in place of others, everywhere below a node of the schema."""
    if isinstance(node, dict):
        said = node.get("description")
        if isinstance(said, str) and said in known:
            node["description"] = known[said]
        for inner in node.values():
            _translate(inner, known)
    elif isinstance(node, list):
        for inner in node:
            _translate(inner, known)


def _property(one: FlatField, by_hand: Mapping[str, Any]) -> dict[str, Any]:
    """Return the schema of a key; for a key with its own reader, the entry written by hand."""
    said = {"description": _plain(full_sentence(one))}
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


def full_sentence(one: FlatField) -> str:
    """Return the sentence of a declared key, with its unit after the first clause if need be."""
    text = one.key.sentence
    unit = one.key.unit if isinstance(one.key, NumberKey) else ""
    unit = {"percent": "per cent"}.get(unit, unit)
    if not unit or re.search(rf"(?<!\w){re.escape(unit)}(?!\w)", text):
        return text
    return re.sub(r"(?=[;.:] | \(|$)", f", {unit}", text, count=1)


def _plain(sentence: str) -> str:
    """Return a sentence without the signs of Markdown, as an editor shows it."""
    text = re.sub(r"\[(\[*[^][]*\]*)\]\([^)]*\)", r"\1", sentence).replace("`", "")
    return f"{text[:1].upper()}{text[1:].removesuffix('.')}."


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
