"""The sheet of the flywheel: what is constructed lies on it to scale, and the lint is content."""

from __future__ import annotations

import json

import numpy as np
import pytest
from cases import each, thinned
from click.testing import CliRunner
from worked import ROOT, drawn_sheets, path_of

from planmethod.cli import cli
from planmethod.errors import ExitCode
from planmethod.render.ink.drawing import Disc, Drawing, Text

WANTED = json.loads((ROOT / "tests/data/flywheel.json").read_text("utf-8"))
FILES = ("press/flywheel", "machines/compressor", "machines/engine")


def sheet(name: str) -> Drawing:
    (drawn,) = drawn_sheets(name, layout="flywheel")
    return drawn


def test_the_points_lie_where_the_scales_put_them() -> None:
    wanted = WANTED["rod/table/true"]["sheet_mm"]["12"]
    drawn = sheet("press/flywheel")
    (view,) = (view for view in drawn.views if view.kind == "flywheel")
    spans = {span.name: span for span in view.spans}
    assert spans["KL"].length == pytest.approx(wanted["K"] - wanted["L"], abs=1e-6)
    assert spans["H"].length == pytest.approx(30.0)
    points = np.array(
        [item.centre for item in drawn.items if isinstance(item, Disc) and "point" in item.tag]
    )
    # the energy-mass points stand right of K and L by J, and above their axis by dT
    foot = spans["KL"].end - 1j * wanted["K"]
    for inertia, energy in zip(wanted["J"][:-1], wanted["T"][:-1], strict=True):
        assert np.min(np.abs(points - foot - complex(inertia, energy))) < 0.02
    left = spans["H"].end
    for k, work in enumerate(wanted["A"]):
        assert np.min(np.abs((points - left).real - 20.0 * k)) < 0.02, work


@each("name", thinned(FILES, 3))
def test_the_lint_finds_nothing_on_the_sheet(name: str) -> None:
    run = CliRunner().invoke(cli, ["lint", str(path_of(name)), "--layout", "flywheel"])
    assert run.exit_code == ExitCode.DONE, run.output


def test_the_sheet_says_what_the_construction_is_off_by() -> None:
    texts = "".join(item.text for item in sheet("press/flywheel").items if isinstance(item, Text))
    for said in ("−6,50", "−6,63", "2,550", "2,384", "0,055556"):
        assert said in texts


def test_a_file_without_a_machine_is_told() -> None:
    run = CliRunner().invoke(cli, ["sheet", str(path_of("press/press")), "--layout", "flywheel"])
    assert run.exit_code == ExitCode.USAGE or run.exit_code == ExitCode.PROBLEM, run.output
    assert "needs [machine]" in run.output
