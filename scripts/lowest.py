"""``python -m scripts.lowest``: the requirements of the package at the lowest versions it names.

Printed are lines for ``pip install -r``; those of the extras ``dev``, ``dxf`` and ``referee`` too.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator
from pathlib import Path

HERE = Path(__file__).parents[1]
TOOLS = ("build", "import-linter", "mypy", "ruff")
"""Tools that check the source code and are not needed to run it."""

BESIDE = ("pyparsing==3.1.0",)
"""Dependencies of old libraries, in versions that do not warn."""


def lowest() -> Iterator[str]:
    """Yield the requirements, each at the lowest version that `pyproject.toml` allows."""
    told = tomllib.loads((HERE / "pyproject.toml").read_text("utf-8"))["project"]
    wanted = [*told["dependencies"]]
    for extra in ("dev", "dxf", "referee"):
        wanted += told["optional-dependencies"][extra]
    yield from BESIDE
    for one in dict.fromkeys(wanted):
        name, _, version = one.partition(";")[0].partition(">=")
        if re.sub(r"\[.*\]", "", name) not in TOOLS:
            yield f"{name.strip()}=={version.partition(',')[0].strip()}"


if __name__ == "__main__":
    print("\n".join(dict.fromkeys(lowest())))
