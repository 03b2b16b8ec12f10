"""Modules of the pages: their own tests in node, and the script that a page joins of them."""

from __future__ import annotations

import re
import shutil
import subprocess

import pytest
from doors import MESH_SCRIPT, POINT_SCRIPT, SCRIPT, joined
from worked import ROOT

needs_node = pytest.mark.skipif(shutil.which("node") is None, reason="node is not installed")


@needs_node
def test_modules_hold_their_own_tests() -> None:
    own = sorted((ROOT / "tests/js").glob("*.test.mjs"))
    command = ["node", "--import", "./scripts/js/resolve.mjs", "--test", *map(str, own)]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout[-4000:] + done.stderr[-2000:]
    (count,) = re.findall(r"(?m)^\S* ?tests (\d+)$", done.stdout)
    assert int(count) >= len(own)


@needs_node
def test_a_joined_script_has_every_module_and_no_name_twice() -> None:
    folder, pages = ROOT / "planmethod/render/live/script", (SCRIPT, POINT_SCRIPT, MESH_SCRIPT)
    used = {f"{name}.js" for page in pages for name in page}
    assert used == {path.name for path in folder.iterdir()}
    for page in pages:
        script = joined(*page)
        assert not re.search(r"(?m)^(?:import|export)\b", script)
        done = subprocess.run(
            ["node", "--check", "-"], input=script, capture_output=True, text=True
        )
        assert done.returncode == 0, done.stderr  # a name declared twice is an error of syntax
