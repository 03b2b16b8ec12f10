"""The user's config file: its place, its settings, and its faults."""

from __future__ import annotations

from pathlib import Path

import pytest
from doors import (
    VARIABLE,
    ConfigError,
    ExitCode,
    ProblemError,
    SheetSettings,
    find_config,
    load_config,
    problem_loads as loads,
    usual_place,
)
from msgspec.structs import replace
from worked import path_of


def written(folder: Path, text: str) -> Path:
    path = folder / "config.toml"
    path.write_text(text, encoding="utf-8")
    return path


def faults(folder: Path, text: str) -> list[str]:
    with pytest.raises(ConfigError) as caught:
        load_config(written(folder, text))
    assert caught.value.exit_code is ExitCode.USAGE
    assert "in the config file" in str(caught.value)
    return [str(fault) for fault in caught.value.faults]


def test_both_tables(tmp_path: Path) -> None:
    config = load_config(
        written(
            tmp_path,
            '[stamp]\nauthor = "Иванов"\nfirst_use = "ТММ.00"\n'
            '[sheet]\npaper = "а3:книжная"\nform = "1+2а"\ngraph_26 = false\n'
            'lettering = "b-upright"\n',
        )
    )
    assert config.stamp == {"author": "Иванов", "first_use": "ТММ.00"}
    assert config.sheet == SheetSettings(
        paper="A3:portrait", form="1+2a", graph_26=False, lettering="B-upright"
    )


def test_an_empty_file_has_no_settings(tmp_path: Path) -> None:
    config = load_config(written(tmp_path, "\ufeff# ничего\n"))
    assert (config.stamp, config.sheet) == ({}, SheetSettings())


def test_all_faults_at_once_with_place_and_nearest_name(tmp_path: Path) -> None:
    found = faults(
        tmp_path,
        "[stamp]\nautor = 'Иванов'\ngroup = 31\nside_columns = true\n"
        "[sheet]\npaper = 'A4:landscape'\nform = '3'\nside_columns = 'true'\nlettering = 'C'\n"
        "author = 'x'\n[stamps]\n",
    )
    assert found == [
        "stamps: unknown key. Did you mean 'stamp'?",
        "stamp.side_columns: unknown key. It belongs in [sheet].",
        "stamp.autor: unknown key. Did you mean 'author'?",
        "stamp.group: expected a string, got the integer 31. Put it in quotes.",
        "sheet.author: unknown key. It belongs in [stamp].",
        "sheet.paper: A4 must be portrait by GOST 2.301, with the title block along the short "
        "side. Choose A4, or a landscape A3",
        "sheet.form: expected one of 1, 1+2a, 2, 2a, got the string '3'",
        "sheet.side_columns: expected true or false, got the string 'true'. Write it without "
        "quotes.",
        "sheet.lettering: expected one of A, A-upright, B, B-upright, got the string 'C'",
    ]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("[stamp]\nauthor = Иванов\n", "line 2, column 10: this is not TOML"),
        ("stamp = 3\n", "stamp: expected a table, got the integer 3"),
        ("[sheet]\npaper = 'B5'\n", "sheet.paper: Unknown paper format 'B5'. Choose A4"),
        ("[sheet]\ngraph_26 = 1\n", "sheet.graph_26: expected true or false, got the integer 1"),
    ],
)
def test_single_faults(text: str, said: str, tmp_path: Path) -> None:
    (found,) = faults(tmp_path, text)
    assert found.startswith(said)


def test_a_file_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match=r"this file does not exist.*--no-config"):
        load_config(tmp_path / "no.toml")
    with pytest.raises(ConfigError, match="this is a directory"):
        load_config(tmp_path)
    latin = tmp_path / "cp1251.toml"
    latin.write_bytes('[stamp]\nauthor = "Иванов"\n'.encode("cp1251"))
    with pytest.raises(ConfigError, match=r"is not UTF-8.*Windows-1251"):
        load_config(latin)


def test_the_usual_places(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Path, "home", lambda: tmp_path)
    assert usual_place({}, "linux") == tmp_path / ".config" / "planmethod" / "config.toml"
    assert usual_place({"XDG_CONFIG_HOME": "/etc/me"}, "linux") == Path(
        "/etc/me/planmethod/config.toml"
    )
    assert usual_place({"XDG_CONFIG_HOME": "rel"}, "darwin").is_relative_to(tmp_path)
    windows = usual_place({"APPDATA": str(tmp_path / "Roaming")}, "win32")
    assert windows == tmp_path / "Roaming" / "planmethod" / "config.toml"
    assert usual_place({}, "win32").is_relative_to(tmp_path / "AppData" / "Roaming")


def test_which_file_is_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Path, "home", lambda: tmp_path)
    assert find_config({}) is None
    assert find_config({VARIABLE: ""}) is None
    usual = tmp_path / ".config" / "planmethod" / "config.toml"
    usual.parent.mkdir(parents=True)
    usual.touch()
    assert find_config({"APPDATA": str(tmp_path / ".config")}) == usual
    assert find_config({VARIABLE: "other.toml"}) == Path("other.toml")


def test_settings_over_settings() -> None:
    lower = SheetSettings(paper="A3", form="2", side_columns=True)
    upper = SheetSettings(paper="A2", side_columns=False)
    assert upper.over(lower) == SheetSettings(paper="A2", form="2", side_columns=False)


def test_texts_of_a_language_are_read_from_a_problem_file() -> None:
    text = path_of("linkages/ex3").read_text("utf-8")
    made = text.replace("en.title", "en.group = 'M-2'\nen.title")
    problem = loads(made, name="ex3")
    assert problem.stamp_in["en"]["group"] == "M-2"
    assert "group" not in problem.title_block
    english = replace(problem, sheet=replace(problem.sheet, lang="en"))
    assert english.title_block["group"] == "M-2"
    with pytest.raises(ProblemError) as caught:
        loads(text.replace("en.title", "en.autor = 'x'\nen.paper = 'A3'\nen.title"), name="ex3")
    assert [fault.path for fault in caught.value.faults] == ["stamp.en.paper", "stamp.en.autor"]
