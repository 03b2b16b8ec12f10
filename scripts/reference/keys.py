"""All keys of a problem file, table by table, from their declarations and the schema."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from enum import Enum
from typing import Any, cast

from planmethod.problem import keys
from planmethod.problem.records import TITLE_BLOCK, TITLE_BLOCK_IN
from planmethod.problem.tables import CustomKey, FlatField, NumberKey, TextKey, declared
from scripts.reference.markdown import code, data, sentence, table, words
from scripts.reference.schema import (
    PLACES,
    SCHEMA,
    defaults_of,
    full_sentence,
    table_at,
)

HEADINGS: Mapping[str, str] = {
    "frame": "[frame]",
    "guide": "[frame.guides.x-x]",
    "drawn": "[drawn]",
    "synthesis": "[synthesis]",
    "link": "[links.1]",
    "point": "[links.3.D]",
    "slides": "[links.3.slides]",
    "driver": "[driver]",
    "span": "[driver.phi]",
    "rule": "[assembly.B]",
    "scales": "[scales]",
    "cycle": "[cycle]",
    "pole": "[cycle.pole]",
    "project": "[project]",
    "sheet": "[sheet]",
    "stamp": "[stamp]",
    "dynamics": "[dynamics]",
    "mass": "[dynamics.links.2]",
    "load": "[[loads]]",
    "spring": "[[springs]]",
    "table": "[loads.force]",
    "phases": "[loads.phases]",
    "balancing_force": "[balancing_force]",
    "friction": "[friction]",
    "pair": '[friction.pairs."B 3-0"]',
    "bearing": "[bearings.O]",
    "letters": "[letters]",
    "machine": "[machine]",
    "flywheel": "[machine.flywheel]",
    "motor": "[machine.motor]",
    "kloss": "[machine.motor.kloss]",
    "line": "[machine.motor.line]",
    "catalogue_motor": "[[motors]]",
    "balancing": "[balancing]",
    "higher": "[[higher_pairs]]",
    "toothed": "[[meshes]]",
    "rolls": "[links.3.rolls]",
    "answer": "[[answers]]",
    "published": "[published.v_C]",
    "gears": "[gears]",
    "wheel": "[gears.wheels.2]",
    "mesh": "[[gears.meshes]]",
    "picture": "[gears.picture]",
    "design": "[gears.design]",
    "meshing": "[meshing]",
    "cam": "[cam]",
    "shaft_cam": "[[cams]]",
    "motion": "[[cam.motions]]",
    "law": "[cam.law]",
    "moving": "[point]",
    "rolling": "[point.wheel]",
}
"""A table of each kind as a file has it; the same in both languages, as are the anchors."""


REFERRED = {"AB": "#/$defs/length", "D": "#/$defs/pointForm"}
"""What examples of names in a link are: its other keys are either."""

HUGE = 1e9
TINY = 1e-9
"""Bounds beyond these only reject impossible values, and are not listed."""


def keys_page(lang: str) -> str:
    """Return the keys of each kind of table."""
    said = words("keys", lang)
    schema = json.loads(SCHEMA.read_text("utf-8"))
    types = Types(schema, said["types"])
    parts = []
    for kind in PLACES:
        about = said["tables"][kind].strip()
        title = said["top"] if kind == "top" else HEADINGS[kind]
        parts += [f"## {title}", about, table(said["heads"], _rows(kind, lang, types))]
    return "\n\n".join(parts)


def _rows(kind: str, lang: str, types: Types) -> Iterator[tuple[str, str, str]]:
    """Yield key, value and meaning of a kind of table."""
    said = words("keys", lang)
    place = table_at(types.schema, kind)
    required = set(place.get("required", ()))
    defaults = _defaults(kind)
    for name, what in sentences(kind, lang).items():
        node = node_of(place, name)
        meaning = sentence(what)
        if usual := defaults.get(name, ("", ""))[lang == "ru"]:
            meaning += f" {said['default'].format(usual)}"
        if name in required:
            meaning += f" {said['required']}"
        value = "" if node is None else types.text(node)
        if kind == "stamp" and "field" in str(node):
            value = types.said["text"]  # of all of them the bound is in the introduction
        yield code(name), value, meaning


def sentences(kind: str, lang: str) -> Mapping[str, str]:
    """Return the sentences of the keys of a kind of table."""
    if lang == "ru":
        return cast("Mapping[str, str]", data("keys.ru")[kind])
    if kind == "stamp":
        return {**TITLE_BLOCK, **TITLE_BLOCK_IN}
    if kind in keys.FLAT:
        return {one.name: full_sentence(one) for one in declared(keys.FLAT[kind])}
    return cast("Mapping[str, str]", data("keys.en")[kind])


def _defaults(kind: str) -> dict[str, tuple[str, str]]:
    """Return the defaults of declared keys; in words they are in English alone."""
    found: dict[str, tuple[str, str]] = {}
    if kind in keys.FLAT:
        usual = defaults_of(kind)
        for one in declared(keys.FLAT[kind]):
            text = "" if one.key.required else _written(one, usual.get(one.field))
            found[one.name] = (one.key.absent or text, "" if one.key.absent else text)
    return found


def _written(one: FlatField, default: object) -> str:
    """Return a default as a file has it; empty where it is none."""
    if isinstance(one.key, CustomKey | TextKey) or default is None:
        return ""
    if isinstance(one.key, NumberKey) and not one.key.low <= cast("float", default) <= one.key.high:
        return ""  # the default is outside the bounds and means that the file has no value
    if isinstance(default, bool):
        return code(str(default).lower())
    if isinstance(default, Enum):
        return code(f'"{default.value}"')
    if isinstance(default, str):
        return code(f'"{default}"')
    return f"{default:g}" if isinstance(default, float) else str(default)


def node_of(place: Mapping[str, Any], name: str) -> Mapping[str, Any] | None:
    """Return the schema of a key: its own, that of a pattern, or that of any other name."""
    if name in REFERRED:
        return {"$ref": REFERRED[name]}
    if name in place["properties"]:
        return cast("Mapping[str, Any]", place["properties"][name])
    for pattern, node in place.get("patternProperties", {}).items():
        if re.search(pattern, name):
            return cast("Mapping[str, Any]", node)
    other = place.get("additionalProperties")
    return other if isinstance(other, dict) else None


class Types:
    """What a key may be, in words, by its schema."""

    def __init__(self, schema: dict[str, Any], said: Mapping[str, str]) -> None:
        self.schema = schema
        self.said = said
        self.anchors = {
            f"#/{'/'.join(PLACES[kind])}": re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")
            for kind, title in HEADINGS.items()
        }
        self.places = {id(table_at(schema, kind)): kind for kind in HEADINGS}

    def text(self, node: Mapping[str, Any], *, inner: bool = False) -> str:
        """Return the values that a node of the schema accepts; ``inner`` ones without bounds."""
        ref = str(node.get("$ref", ""))
        name = ref.rpartition("/")[2]
        if ref in self.anchors:
            return self._linked(self.anchors[ref])
        if name in self.said:
            return self.said[name]
        if id(node) in self.places:
            kind = self.places[id(node)]
            return self._linked(self.anchors[f"#/{'/'.join(PLACES[kind])}"])
        if ref:
            own = {key: one for key, one in node.items() if key != "$ref"}
            return self.text({**self.schema["$defs"][name], **own}, inner=inner)
        return self._of(node, inner=inner)

    def _linked(self, anchor: str) -> str:
        return f"[{self.said['table']}](#{anchor})"

    def _of(self, node: Mapping[str, Any], *, inner: bool) -> str:
        """Return the values of a node without a reference."""
        if "enum" in node or "const" in node:
            known = node.get("enum", [node.get("const")])
            return ", ".join(code(json.dumps(one, ensure_ascii=False)) for one in known)
        if "anyOf" in node:
            parts = dict.fromkeys(self.text(one, inner=True) for one in node["anyOf"])
            return self.said["or"].join(parts)
        match node.get("type"):
            case "boolean":
                return "`true`, `false`"
            case "integer":
                return self._number(node, self.said["integer"])
            case "number" | ["number", "string"]:
                return self._number(node, self.said["real"])
            case "string":
                return self.said["text"] if inner else self._string(node)
            case "array":
                return self._list(node)
            case ["object", "string"]:
                return self.said["table_or_file"]
            case _:
                other = node.get("additionalProperties")
                by_name = self.text(other, inner=True) if isinstance(other, dict) else ""
                return self.said["by_name"].format(by_name) if by_name else self.said["table"]

    def _number(self, node: Mapping[str, Any], noun: str) -> str:
        low, high = node.get("minimum"), node.get("maximum")
        above, below = node.get("exclusiveMinimum"), node.get("exclusiveMaximum")
        low = low if (low is not None and abs(low) < HUGE and abs(low) > 1e-6) or low == 0 else None
        high = high if high is not None and abs(high) < HUGE else None
        if low is not None and high is not None:
            return self.said["span"].format(noun, _short(low), _short(high))
        bounds = [
            f"> {_short(above)}" if above is not None and low is None else "",
            f"≥ {_short(low)}" if low is not None else "",
            f"< {_short(below)}" if below is not None else "",
            f"≤ {_short(high)}" if high is not None else "",
        ]
        return " ".join([noun, ", ".join(filter(None, bounds))]).strip()

    def _string(self, node: Mapping[str, Any]) -> str:
        limit = node.get("maxLength")
        text = self.said["text"]
        return text if limit is None else self.said["limited"].format(text, limit)

    def _list(self, node: Mapping[str, Any]) -> str:
        few, many = node.get("minItems", 0), node.get("maxItems")
        items = node.get("items")
        inner = self.text(items, inner=True) if isinstance(items, dict) else self.said["value"]
        if few == many:
            return self.said["count"].format(few, inner)
        return self.said["list"].format(inner)


def _short(number: float) -> str:
    return f"{number:.9f}".rstrip("0").rstrip(".")
