"""What can be asked for, with a server or without, and what there is to start from (запросы)."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from msgspec.structs import asdict

from planmethod.note.wording import language
from planmethod.problem import FAMILIES, OTHER_FAMILIES, template
from planmethod.problem.tasks import tasks, text_for

ACTS = ("sketched", "assemblies", "sheets", "command", "questions", "verdicts", "checked", "varied")
TRUSTED = ("checked", "varied")
"""What an instructor asks for alone, where strangers come."""

WHATS = ("tables", "protocol", "structure", "live", "pdf", "dxf", "svg", "note", "project", "form")
TRUSTED_WHATS = ("key",)
WORKS = (".csv", ".xlsx", ".json", ".toml", ".txt", ".dxf", ".svg")
"""Endings of works."""

MOST_VARIANTS = 60


def told_of(lang: str, layouts: Sequence[str], uploads: int) -> dict[str, Any]:
    """Return what the page is told in a language, wherever it is served from."""
    families = {name: language(lang).families[name] for name in (*FAMILIES, *OTHER_FAMILIES)}
    return {
        "served": False, "files": (), "one": False, "layouts": layouts, "families": families,
        "uploads": uploads, "works": WORKS,
    }  # fmt: skip


def found_tasks(words: str) -> list[dict[str, Any]]:
    """Return the shipped tasks; of a search, those that say its words."""
    return [asdict(task) for task in tasks() if not words or task.says(words[:200])]


def start_of(name: str, variant: str | None, lang: str) -> dict[str, str] | None:
    """Return the text of a task, of a variant of it, or of a template; None of any other name.

    A template is in the language of the page.
    """
    if name in (*FAMILIES, *OTHER_FAMILIES):
        return {"name": name, "text": template(name, lang)}
    task = next((task for task in tasks() if task.name == name), None)
    if task is None or (variant is not None and variant not in task.variants):
        return None
    return {"name": name, "text": text_for(task, variant)}


def named_work(name: str) -> str | None:
    """Return the plain name of a work that was dropped; None where it is none."""
    plain = Path(name).name
    is_one = Path(plain).suffix.lower() in WORKS and plain.isprintable() and len(plain) <= 120
    return plain if is_one else None


def object_of(data: bytes) -> dict[str, Any] | None:
    """Return what is asked, of JSON; None where it is no object."""
    try:
        found = json.loads(data or b"{}")
    except (ValueError, RecursionError):
        return None
    return found if isinstance(found, dict) else None


def asked_of(
    do: str,
    told: Mapping[str, Any],
    *,
    lang: str,
    layouts: Sequence[str],
    works: Path,
    served: bool = False,
) -> dict[str, Any] | None:
    """Return what a process is asked: of a stranger's words those that are known; None of others.

    Parameters
    ----------
    do : str
        One of `ACTS`.
    works : Path
        Folder of the works that were dropped.
    served : bool
        Strangers come.
    """
    what, layout, variant = (told.get(key) for key in ("what", "layout", "variant"))
    if do == "command" and what not in (*WHATS, *TRUSTED_WHATS):
        return None
    asked: dict[str, Any] = {
        "do": do, "what": what, "lang": lang, "served": served,
        "name": _name(str(told.get("name", ""))), "text": str(told.get("text", "")),
        "variant": str(variant)[:100] if variant else None,
        "layout": layout if layout in layouts else None,
    }  # fmt: skip
    if asked["variant"] and asked["variant"].startswith("-"):
        return None
    if do == "verdicts":
        asked["work"] = told.get("work")
    if do == "checked":
        by_hand = told.get("by_hand")
        rows = by_hand if isinstance(by_hand, list) else []
        asked["by_hand"] = [row for row in rows if isinstance(row, dict)][:10_000]
        asked["works"] = sorted(str(path) for path in works.iterdir())
    if do == "varied":
        asked["count"] = _number(told.get("count"), MOST_VARIANTS)
        asked["seed"] = _number(told.get("seed"), 1_000_000)
        asked["moodle"] = told.get("moodle") is True
    return asked


def _name(text: str) -> str:
    """Return what a file is called, of what somebody typed."""
    plain = re.sub(r"[^\w-]+", "-", Path(text).stem).strip("-_")[:60]
    return plain or "problem"


def _number(value: object, most: int) -> int:
    return min(max(value, 1), most) if isinstance(value, int) else 1
