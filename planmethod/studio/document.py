"""The page of the studio: its HTML in a language, its scripts and its style (страница)."""

# no messages: headers of HTTP

from __future__ import annotations

import json
import re
import secrets
from collections.abc import Mapping
from functools import cache
from hashlib import sha256
from html import escape
from importlib.resources import files
from typing import Any

from planmethod.languages import LANGUAGES
from planmethod.note.wording import get_language

POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self' 'nonce-{nonce}'; "
    "img-src 'self' blob: data:; connect-src 'self'; frame-src 'self'; base-uri 'none'; "
    "form-action 'none'; frame-ancestors 'none'"
)
"""Permissions of the page: to run its own scripts and talk to its own host."""

KINDS = {".js": "text/javascript", ".css": "text/css", ".txt": "text/plain; charset=utf-8"}


@cache
def asset(name: str) -> tuple[bytes, str] | None:
    """Return a file of the page and its type; None if there is no such file."""
    if re.fullmatch(r"[\w-]+\.(?:js|css|txt)", name) is None:
        return None
    path = files("planmethod.studio").joinpath("page", name)
    if not path.is_file():
        return None
    return path.read_bytes(), KINDS[name[name.rindex(".") :]]


@cache
def assets_mark() -> str:
    """Return the fingerprint of all files of the page, which distinguishes versions."""
    there = sorted(files("planmethod.studio").joinpath("page").iterdir(), key=lambda one: one.name)
    return sha256(b"".join(one.read_bytes() for one in there)).hexdigest()[:16]


def page_of(lang: str, page_data: Mapping[str, Any], static: str = "static") -> tuple[str, str]:
    """Return the page in a language, and the word by which its editor may set its style.

    Parameters
    ----------
    page_data : mapping
        What its script reads, plain data.
    static : str
        Where its scripts and its style are, below it.
    """
    words, nonce = get_language(lang).studio["page"], secrets.token_urlsafe(16)
    text = files("planmethod.studio").joinpath("page", "studio.html").read_text("utf-8")
    text = re.sub(r"\{\{(\w+)\}\}", lambda place: escape(words[place[1]]), text)
    data = {**page_data, "lang": lang, "langs": LANGUAGES, "nonce": nonce, "words": words}
    whole = json.dumps(data, ensure_ascii=False).replace("<", "\\u003c")
    text = text.replace("[[static]]", static).replace("[[lang]]", lang)
    return text.replace("[[data]]", whole), nonce
