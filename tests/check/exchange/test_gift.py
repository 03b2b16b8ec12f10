"""Numbers as GIFT: read back, compared with the parts that Moodle gets."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from click.testing import CliRunner
from doors import (
    LINKAGES,
    WORDING_LANGUAGES as LANGUAGES,
    QuizPart,
    Variants,
    cli,
    get_language,
    gift,
    question_of,
)
from msgspec.structs import replace
from worked import path_of

_QUESTION = re.compile(
    r"^::((?:\\.|[^\\])*?)::\[plain\]((?:\\.|[^\\])*?) \{#\n(.*?)^\}$", re.S | re.M
)
_LINE = re.compile(r"\t=(?:%([\d.]+)%)?(-?[\d.]+):([\d.]+)(?:#(.*))?\Z")


def read_gift(text: str) -> list[tuple[str, str, list[tuple[float, float, float, str]]]]:
    """Questions of a file: name, text, and of each alternative share, value, margin, feedback."""

    def bare(escaped: str) -> str:
        return re.sub(r"\\(.)", r"\1", escaped)

    found = []
    for name, asked, lines in _QUESTION.findall(text):
        answers = []
        for line in lines.splitlines():
            match = _LINE.match(line)
            assert match, line
            share = float(match[1]) / 100 if match[1] else 1.0
            answers.append((share, float(match[2]), float(match[3]), bare(match[4] or "")))
        found.append((bare(name), bare(asked), answers))
    return found


@pytest.mark.parametrize("lang", LANGUAGES)
def test_every_number_is_a_question_with_the_intervals_of_its_part(lang: str) -> None:
    words = get_language(lang)
    questions = [
        question_of(Variants(path_of("linkages/ex3-variants")).task(n), LINKAGES, words)
        for n in "12"
    ]
    text = gift(questions, words).decode()
    assert text.startswith("$CATEGORY: $course$/top/")
    parts: list[QuizPart] = [part for one in questions for part in one.parts if part.alternatives]
    found = read_gift(text)
    assert len(found) == len(parts) == 38 and len({name for name, _, _ in found}) == 38
    for (name, asked, answers), part in zip(found, parts, strict=True):
        assert (
            asked.endswith("= ?")
            and "φ₁" in asked
            and words.check["key"].variant.format(variant="")[:5] in name
        )
        assert len(answers) == len(part.alternatives)
        for (share, value, margin, feedback), one in zip(answers, part.alternatives, strict=True):
            assert share == pytest.approx(one.fraction)
            assert value == pytest.approx(one.value, abs=1e-3 * one.margin)
            assert margin == pytest.approx(one.margin, rel=1e-3)
            assert bool(feedback) is bool(one.feedback)


def test_signs_of_the_format_in_a_title_are_escaped() -> None:
    words = get_language("ru")
    whole = question_of(Variants(path_of("linkages/ex3")).task(None), LINKAGES, words)
    evil = "a::b {#=5} ~ \\ x\n// y"
    found = read_gift(gift([replace(whole, title=evil, parts=whole.parts[:1])], words).decode())
    assert [name for name, _, _ in found] == ["a::b {#=5} ~ \\ x // y, v_B1"]


def test_both_files_are_written_in_place_of_the_key(tmp_path: Path) -> None:
    ex3, out = path_of("linkages/ex3"), tmp_path / "out"
    words = [
        "--key",
        str(ex3),
        "--gift",
        str(tmp_path / "a.txt"),
        "--moodle",
        str(tmp_path / "a.xml"),
    ]
    done = CliRunner().invoke(cli, ["check", *words, "-o", str(out)])
    assert done.exit_code == 0 and done.stdout.splitlines() == [words[5], words[3]]
    assert not out.exists() and sorted(p.name for p in tmp_path.iterdir()) == ["a.txt", "a.xml"]
