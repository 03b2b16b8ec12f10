"""Notes of problems without a linkage: trains, meshings, cams, moving points."""

from __future__ import annotations

from pathlib import Path

import pytest
from cases import sampled
from click.testing import CliRunner
from doors import (
    WORDING_LANGUAGES as LANGUAGES,
    Chapter,
    Figure,
    Formula,
    Homework,
    StructuralHeading,
    cli,
    get_language,
    kind_of,
    note_document,
)
from worked import PROBLEMS

FILES = [
    *(PROBLEMS / "gears" / f"{name}.toml" for name in ("gears-ex1", "planetary-k10")),
    PROBLEMS / "gears/tasks/gears-2-2-044.toml",
    PROBLEMS / "point/k11-01.toml",
    *sorted((PROBLEMS / "cams").glob("*.toml"))[:1],
    *sorted((PROBLEMS / "meshing").glob("*.toml"))[:1],
]
OTHERS = sampled(sorted((PROBLEMS / "gears").rglob("*.toml")), 9)


def homework(file: Path, lang: str) -> Homework:
    kind = kind_of(file)
    return Homework(kind.load(file, None), kind, lang)


@pytest.mark.parametrize("lang", LANGUAGES)
@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_every_kind_of_problem_has_a_note(file: Path, lang: str) -> None:
    """It has its data in the assignment, its chapters with pictures, and its sources."""
    language = get_language(lang)
    nodes = note_document(homework(file, lang), language).nodes
    heads = [node.title for node in nodes if isinstance(node, StructuralHeading)]
    assert heads[0] == language.report["front"]["assignment"]
    assert heads[-1] == language.report["back"]["sources"]
    assert sum(isinstance(node, Chapter) for node in nodes) == 1
    pictures = [node for node in nodes if isinstance(node, Figure)]
    assert pictures
    assert all(min(node.view.size) > 10.0 for node in pictures)


@pytest.mark.parametrize("file", OTHERS, ids=lambda file: file.stem)
def test_every_train_has_a_note(file: Path) -> None:
    nodes = note_document(homework(file, "ru"), get_language("ru")).nodes
    assert any(isinstance(node, Figure) for node in nodes)


def test_the_note_of_a_train_derives_its_teeth() -> None:
    nodes = note_document(homework(FILES[0], "ru"), get_language("ru")).nodes
    texts = [node.text for node in nodes if isinstance(node, Formula)]
    assert any("z_{2'} = z_{1} + z_{2} − z_{3} = 16 + 48 − 44 = 20" in text for text in texts)
    assert any("z_{5} = z_{3'} + 2·z_{4} = 20 + 2·40 = 100" in text for text in texts)


@pytest.mark.parametrize("file", [FILES[0], FILES[3]], ids=lambda file: file.stem)
def test_the_command_writes_word_and_pdf(file: Path, tmp_path: Path) -> None:
    done = CliRunner().invoke(cli, ["note", str(file), "-o", str(tmp_path), "--lang", "en"])
    assert done.exit_code == 0, done.output
    assert {path.suffix for path in tmp_path.iterdir()} == {".docx", ".pdf"}


def test_a_position_is_of_linkages_only(tmp_path: Path) -> None:
    args = ["note", str(FILES[0]), "--position", "1", "-o", str(tmp_path), "--lang", "en"]
    done = CliRunner().invoke(cli, args)
    assert done.exit_code == 2
    assert "--position selects a position of the driving link" in done.stderr
    assert "[gears] has no such link" in done.stderr
    assert not any(tmp_path.iterdir())
