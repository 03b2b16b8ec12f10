"""``[sheet] directions``: a known direction is under every vector of an equation."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from click.testing import CliRunner
from doors import cli
from worked import path_of

KEY = "[sheet]\ndirections = true\n"


def directed(name: str, path: Path) -> Path:
    """Write a shipped file with the key, in the ``[sheet]`` that it may have."""
    text = path_of(name).read_text("utf-8")
    head = "[sheet]\n"
    path.write_text(text.replace(head, KEY) if head in text else f"{text}\n{KEY}", "utf-8")
    return path


def protocol(path: Path, lang: str) -> str:
    result = CliRunner().invoke(cli, ["protocol", str(path), "--lang", lang])
    assert result.exit_code == 0, result.output
    return result.output


def under(text: str, equation: str) -> list[str]:
    """Return the directions under the terms of an equation, from left to right."""
    lines = text.splitlines()
    at = next(k for k, line in enumerate(lines) if re.sub(r"\s+", " ", line.strip()) == equation)
    return re.split(r"\s{2,}", lines[at + 2].strip())


@pytest.mark.parametrize("lang", ["ru", "en"])
def test_velocities_of_the_book_have_their_directions(lang: str, tmp_path: Path) -> None:
    text = protocol(directed("levers/six-link", tmp_path / "file.toml"), lang)
    assert under(text, "v_C = v_B + v_CB") == ["⊥ DC", "⊥ AB", "⊥ BC"]
    assert under(text, "v_C = v_D + v_CD") == ["⊥ DC", "= 0", "⊥ DC"]
    assert under(text, "v_H = v_L + v_HL") == ["∥ y-y", "∥ CL"]
    assert under(text, "a_C = a_B + aⁿ_CB + a^τ_CB") == ["C → B", "⊥ BC"]


def test_a_point_of_a_turning_link_goes_across_its_arm(tmp_path: Path) -> None:
    """D of ex3 is found by similarity, N of the press on the slotted link is, too."""
    path = tmp_path / "file.toml"
    text = protocol(directed("linkages/ex3", path), "ru")
    assert under(text, "v_E = v_D + v_ED") == ["∥ x-x", "⊥ CD", "⊥ DE"]
    text = protocol(directed("press/press", path), "ru")
    assert under(text, "v_B = v_N + v_BN") == ["∥ y-y", "⊥ O3N", "⊥ NB"]


def test_without_the_key_only_components_have_directions() -> None:
    text = protocol(path_of("levers/six-link"), "en")
    assert under(text, "v_C = v_B + v_CB") == ["⊥ BC"]
    assert under(text, "v_H = v_L + v_HL") == ["∥ CL"]


def test_a_frame_of_guides_alone_is_drawn_first(tmp_path: Path) -> None:
    path = tmp_path / "guides.toml"
    path.write_text(
        """
frame.guides = { x-x = { through = [0, 0], angle = 0 }, y-y = { through = [0, 0], angle = 90 } }
links.1 = { points = ["A"], slides = { on = "x-x" } }
links.2 = { points = ["A", "B"], AB = 0.2 }
links.3 = { points = ["B"], slides = { on = "y-y" } }
driver = { link = "1", s = 0.1, v = 1 }
assembly = { B = "above A" }
""",
        "utf-8",
    )
    text = protocol(path, "en")
    assert text.index("we draw the guide x-x") < text.index("we draw the guide y-y")
    assert text.index("we draw the guide y-y") < text.index("Driving link 1")
