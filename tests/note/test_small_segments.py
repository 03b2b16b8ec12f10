"""Segments too small to draw are not laid off, and the protocol mentions it."""

from __future__ import annotations

from pathlib import Path

from click.testing import CliRunner
from doors import cli

CRANK = """
frame = { O = [0, 0], guides.x-x = { through = "O", angle = 0 } }
driver = { link = "1", phi = PHI, omega = 10 }
assembly = { B = "right of O" }
[links.1]
points = ["O", "A"]
OA = 0.1
[links.2]
points = ["A", "B"]
AB = 0.35
[links.3]
points = ["B"]
slides = { on = "x-x" }
"""


def test_a_segment_of_some_hundredths_of_a_millimetre_is_not_laid_off(tmp_path: Path) -> None:
    """Near 90 degrees the rod barely turns: a^n_BA is 0.009 mm long."""
    for phi, small in ((89, True), (60, False)):
        path = tmp_path / f"{phi}.toml"
        path.write_text(CRANK.replace("PHI", str(phi)), encoding="utf-8")
        run = CliRunner().invoke(cli, ["protocol", str(path), "--lang", "en"])
        assert run.exit_code == 0, run.output
        told = " ".join(run.output.split())
        assert ("mm is too small to be laid off: point n_BA stays at point a" in told) is small
