"""The position plan begins with all that is fixed: the points of the frame and its guides."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from click.testing import CliRunner
from doors import AtAngle, PlanKind, Solution, cli, problem_load as load
from worked import PROBLEMS, every_file, path_of

FRAME = "0"
FILES = [path.relative_to(PROBLEMS).as_posix() for path in every_file()]


def guides(solution: Solution, *, frame: bool) -> Iterator[str]:
    """Yield the fixed guides that the frame's section, or the others, draw."""
    construction = solution.construction
    for section in construction.sections:
        if section.kind is not PlanKind.POSITION or section.frame is not frame:
            continue
        for step in section.steps:
            told = (
                construction.draft.dimensions.get(step.angle) if isinstance(step, AtAngle) else None
            )
            if isinstance(step, AtAngle) and step.to is None and told is not None:
                yield told.of[0]


@pytest.mark.parametrize("name", FILES)
def test_fixed_guides_are_drawn_with_the_fixed_points(name: str) -> None:
    solution = Solution(load(PROBLEMS / name))
    slides = solution.problem.slides.values()
    fixed = {slide.label for slide in slides if slide.host == FRAME}
    assert set(guides(solution, frame=True)) == fixed
    assert not set(guides(solution, frame=False)) & fixed


@pytest.mark.parametrize(
    ("lang", "heading", "sentence"),
    [
        (
            "ru",
            "2.1. ",
            "Через точку (−105; 0) мм под углом 90° к оси x проводим направляющую y-y.",
        ),
        (
            "en",
            "2.1. ",
            "Through the point (−105; 0) mm, at 90° to the x axis, we draw the guide y-y.",
        ),
    ],
)
def test_protocol_draws_the_guide_before_the_crank(lang: str, heading: str, sentence: str) -> None:
    file = str(path_of("levers/six-link"))
    result = CliRunner().invoke(cli, ["protocol", file, "--lang", lang])
    assert result.exit_code == 0, result.output
    text = re.sub(r"\s+", " ", result.output)
    frame = text[text.index(heading) : text.index("2.2. ")]
    assert sentence in frame
    assert text.count(sentence) == 1
