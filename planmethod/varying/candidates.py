"""Candidates read as the variants of a file are (кандидаты): it with others in their place."""

from __future__ import annotations

import re
import tempfile
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from planmethod.errors import PlanMethodError
from planmethod.kind import ProblemKind
from planmethod.kinds import load_each
from planmethod.problem.common import KindProblem
from planmethod.problem.names import segment
from planmethod.problem.source import parse, read_source
from planmethod.varying.parameters import VaryingError

Overrides = Mapping[str, Any]
"""Overrides of the file in a variant, by dotted key."""


class VariantCandidates:
    """A file whose variants are removed, to read others in their place (файл с кандидатами).

    Attributes
    ----------
    path : Path
    kind : ProblemKind or None
        None of a linkage.
    text : str
        The file without its variants.
    table : mapping
        The same as parsed.

    Raises
    ------
    ProblemError, VaryingError
        The file is faulty, or its variants cannot be removed from its text.
    """

    def __init__(self, path: Path, kind: ProblemKind[Any] | None) -> None:
        self.path, self.kind = path, kind
        text = read_source(path)
        whole = parse(text, name=str(path))
        self.text = without_variants(text) if "variants" in whole else text
        self.table = parse(self.text, name=str(path))
        if self.table != {key: value for key, value in whole.items() if key != "variants"}:
            raise VaryingError(
                "{}: its [variants] are between other tables; move them to the end of the file",
                path,
            )

    def read(self, variants: Mapping[str, Overrides]) -> Iterator[KindProblem | PlanMethodError]:
        """Yield the problem of every variant, or its error; without variants, the file itself."""
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / self.path.name
            path.write_text(self.with_variants(variants), encoding="utf-8")
            for name in variants or (None,):
                try:
                    if self.kind is None:
                        yield from load_each(path, (name,))
                    else:
                        yield self.kind.load(path, name)
                except PlanMethodError as error:
                    yield error

    def with_variants(self, variants: Mapping[str, Overrides]) -> str:
        """Return the text of the file with other variants."""
        if not variants:
            return self.text
        return f"{self.text.rstrip()}\n\n{toml_of(variants)}"


def without_variants(text: str) -> str:
    """Return the text of a problem file without its variants."""
    text = re.sub(r"(?m)^[ \t]*variants[ \t]*=[ \t]*(\"[^\"\n]*\"|'[^'\n]*')[^\n]*\n?", "", text)
    kept, inside = [], False
    for line in text.splitlines(keepends=True):
        header = re.fullmatch(_HEADER, line)
        if header is not None:
            inside = header[1].strip("\"'") == "variants"
        if not inside:
            kept.append(line)
    return "".join(kept)


_HEADER = r"\s*\[\[?\s*(\"[^\"]*\"|'[^']*'|[^\[\]\s.,\"']++)[^\[\],]*\]\]?\s*+(?:#.*)?+\s*"


def toml_of(variants: Mapping[str, Overrides]) -> str:
    """Return the table ``[variants]`` of a problem file."""
    lines = ["[variants]"]
    for name, own in variants.items():
        text = ", ".join(f'"{key}" = {_value(value)}' for key, value in own.items())
        lines.append(f"{segment(name)} = {{ {text} }}")
    return "\n".join(lines) + "\n"


def _value(value: Any) -> str:
    if isinstance(value, str):
        return '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"'
    if isinstance(value, list):
        return "[" + ", ".join(map(_value, value)) + "]"
    return repr(value)


def csv_of(variants: Mapping[str, Overrides], lang: str) -> str:
    """Return the table that ``variants = "table.csv"`` names, as Excel of a language has it.

    Raises
    ------
    VaryingError
        A value that is a list has no column.
    """
    separator, decimal = (";", ",") if lang == "ru" else (",", ".")
    heads: dict[str, None] = {}
    rows: list[dict[str, str]] = []
    for own in variants.values():
        row: dict[str, str] = {}
        for key, value in own.items():
            if isinstance(value, list):
                parts = key.split(".")
                if parts[0] != "frame" or len(parts) != 2:
                    raise VaryingError("{} has no column in a CSV table; write a TOML file", key)
                row |= {
                    f"{axis}{parts[1]}": _cell(v, decimal)
                    for axis, v in zip("xy", value, strict=True)
                }
            else:
                row[key] = _cell(value, decimal)
        heads |= dict.fromkeys(row)
        rows.append(row)
    lines = [["variant", *heads]]
    lines += [
        [name, *(row.get(head, "") for head in heads)]
        for name, row in zip(variants, rows, strict=True)
    ]
    return "".join(
        separator.join(_quoted(cell, separator) for cell in line) + "\n" for line in lines
    )


def _cell(value: Any, decimal: str) -> str:
    return value if isinstance(value, str) else repr(value).replace(".", decimal)


def _quoted(cell: str, separator: str) -> str:
    special = separator in cell or '"' in cell
    return '"' + cell.replace('"', '""') + '"' if special else cell
