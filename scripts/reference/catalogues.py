"""Pages from the catalogues of the program: mistakes, remarks of the drawing check, layouts."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from planmethod.note.document import plain_text
from planmethod.note.wording import get_language
from planmethod.render.control.remarks import REMARKS, unit_text
from planmethod.render.sheets.blocks import BLOCKS
from planmethod.render.sheets.compositions import SHIPPED, about
from scripts.reference.markdown import code, prose, sentence, table, words


def mistakes_page(lang: str) -> str:
    """Return the mistakes that ``check`` names, by subject."""
    said = words("mistakes", lang)
    known: Mapping[str, Any] = get_language(lang).check["mistakes"]
    subjects: Mapping[str, str] = said["subjects"]
    parts = []
    for start, title in subjects.items():
        rows = [
            (code(name), sentence(plain_text(one.name)), sentence(plain_text(one.advice)))
            for name, one in known.items()
            if subject_of(name) == start
        ]
        parts += [f"## {title}", table(said["heads"], rows)]
    return "\n\n".join(parts)


def subject_of(name: str) -> str:
    """Return the letter of a mistake's code; ``slip`` for those that have a word in its place."""
    return name[0] if name[1:].isdigit() else "slip"


def lint_codes_page(lang: str) -> str:
    """Return the codes of the drawing check with their limits, rules and actions."""
    said = words("lint-codes", lang)
    texts = get_language(lang).control
    severities = texts["severities"]
    rows, parts = [], []
    for name, remark in REMARKS.items():
        one = texts["remarks"][name]
        unit = unit_text(remark.unit, lang) or "—"
        anchor = f"#{name.lower()}-{_slug(one.title)}"
        rows.append((f"[{name}]({anchor})", severities[remark.severity.value], one.title, unit))
        parts.append(f"## {name}: {one.title}")
        parts.append(prose(one.detail, lang))
        parts.append(f"*{said['rule']}* {one.rule}")
        actions = [prose(_open(text), lang) for text in one["actions"].values()]
        between = " " if len(actions) == 1 else "\n\n- "
        parts.append(f"*{said['fix']}*{between}{between[1:].join(actions)}")
    return "\n\n".join([table(said["heads"], rows), *parts])


def _slug(title: str) -> str:
    kept = "".join(sign for sign in title.lower() if sign.isalnum() or sign in " -_")
    return kept.replace(" ", "-")


def _open(action: str) -> str:
    """Return an action with dots in its places."""
    return re.sub(r"\{\w+\}", "…", action.replace("{scales}", "[scales]"))


def layouts_page(lang: str) -> str:
    """Return the shipped layouts, the kinds of blocks, and the keys of blocks."""
    said = words("layouts", lang)
    blocks = get_language(lang).layouts["blocks"]
    shipped = [(code(name), sentence(about(name, lang))) for name in SHIPPED]
    kinds = [
        (code(name), sentence(blocks[name]), ", ".join(map(code, kind.keys)))
        for name, kind in BLOCKS.items()
    ]
    keys = [(code(key), text) for key, text in said["block_keys"].items()]
    return "\n\n".join([
        f"## {said['shipped']}", table(said["shipped_heads"], shipped),
        f"## {said['blocks']}", said["about_blocks"].strip(), table(said["block_heads"], kinds),
        f"## {said['keys']}", table(said["key_heads"], keys),
    ])  # fmt: skip
