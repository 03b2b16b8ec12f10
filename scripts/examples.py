"""Write the output of commands into the documentation, as Markdown.

``make examples`` looks for such blocks in the pages of ``docs/`` and runs the command of each::

    <!-- example: planmethod protocol problems/linkages/ex3.toml --format md --lang en -->
    ...
    <!-- end of example -->
"""

from __future__ import annotations

import re
import shlex
from contextlib import chdir
from pathlib import Path

from click.testing import CliRunner

from planmethod.cli import cli

ROOT = Path(__file__).resolve().parent.parent
_BLOCK = re.compile(r"(?s)(<!-- example: planmethod ([^\n]*) -->\n).*?(<!-- end of example -->\n)")


def pages() -> list[Path]:
    """Return the pages that have examples."""
    return [
        page
        for page in sorted((ROOT / "docs").rglob("*.md"))
        if _BLOCK.search(page.read_text("utf-8"))
    ]


def filled(page: str) -> str:
    """Return a page with its examples as the commands print them now."""
    return _BLOCK.sub(lambda found: f"{found[1]}\n{_printed(found[2])}\n{found[3]}", page)


def _printed(command: str) -> str:
    """Return the output of a command, its headings a level below the page's title."""
    with chdir(ROOT):
        run = CliRunner().invoke(cli, shlex.split(command), catch_exceptions=False)
    if run.exit_code:
        raise SystemExit(run.output)
    return re.sub(r"(?m)^#", "##", run.output)


if __name__ == "__main__":
    for path in pages():
        path.write_text(filled(path.read_text("utf-8")), "utf-8")
        print(path.relative_to(ROOT))
