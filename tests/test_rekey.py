"""Sentences replaced in the code, in the keys of other languages and in the English texts."""

from __future__ import annotations

import ast
import tomllib
from pathlib import Path

import pytest

from scripts.rekey import main

OLD = "link {} stands on '{}', of which nothing is told in this long sentence on two lines"
CODE = '''
def solve():
    """Tell the answer.

    In full.
    """
    say("link {} stands on '{}', of which nothing is told in this long sentence on two "
        "lines", 1, 2)
    rule = "Of a \\\\ turn"
    return [rule, "as before"]
'''
KEYS = """"Tell the answer.\\n\\nIn full." = "Ответ."
"link {} stands on '{}', of which nothing is told in this long sentence on two lines" = "звено"
"as before" = "как раньше"
"Of a \\\\ turn" = '''
оборот'''
"""
TEXTS = """same = "a text"
list = ["a text", 'another "text"']
"""


@pytest.fixture
def tree(tmp_path: Path) -> Path:
    wording = tmp_path / "planmethod" / "note" / "wording"
    (wording / "ru" / "messages").mkdir(parents=True)
    (wording / "en").mkdir()
    (tmp_path / "planmethod" / "code.py").write_text(CODE, "utf-8")
    (wording / "ru" / "messages" / "solved.toml").write_text(KEYS, "utf-8")
    (wording / "en" / "note.toml").write_text(TEXTS, "utf-8")
    return tmp_path


def rekey(tree: Path, rows: str) -> int:
    (tree / "rows.csv").write_text(rows, "utf-8")
    return main([str(tree / "rows.csv")], tree)


def texts(tree: Path) -> dict[str, str]:
    return {str(path): path.read_text("utf-8") for path in sorted(tree.rglob("*.[pt]*"))}


def test_sentences_are_replaced_everywhere(tree: Path, capsys: pytest.CaptureFixture[str]) -> None:
    long = "link {} is on '{}', and this \"new\" sentence, which is as long, is split again, too, Ж"
    rows = (
        "file,key,old,new\n"
        ',,"Tell the answer.\n\nIn full.","Print the answer.\n\nAll of it."\n'
        f',,"{OLD}",' + '"' + long.replace('"', '""') + '"\n'
        ",,Of a \\ turn,Per \\ turn\n"
        "note.toml,list,a text,a line\n"
        ',,"another ""text""",\'another\'\n'
        ",,no such sentence,any\n"
    )
    assert rekey(tree, rows) == 0
    assert "not found: no such sentence" in capsys.readouterr().out
    code = (tree / "planmethod" / "code.py").read_text("utf-8")
    said = {node.value for node in ast.walk(ast.parse(code)) if isinstance(node, ast.Constant)}
    doc = "Print the answer.\n\n    All of it.\n    "
    assert said >= {doc, long, "Per \\ turn", "as before"}
    assert max(map(len, code.splitlines())) <= 100
    wording = tree / "planmethod" / "note" / "wording"
    keys = tomllib.loads((wording / "ru" / "messages" / "solved.toml").read_text("utf-8"))
    assert keys == {
        "Print the answer.\n\nAll of it.": "Ответ.",
        long: "звено",
        "as before": "как раньше",
        "Per \\ turn": "оборот",
    }
    english = tomllib.loads((wording / "en" / "note.toml").read_text("utf-8"))
    assert english == {"same": "a text", "list": ["a line", "'another'"]}


@pytest.mark.parametrize(
    "row, told",
    [
        (",,a text,a line", "more than one meaning (note.toml same, note.toml list)"),
        (",,Of a \\ turn,as before", "the new sentence exists already"),
        (",,as before,as {} before", "other places"),
        ("note.toml,same,a text,a line\nnote.toml,same,a text,a word", "two rows"),
    ],
)
def test_a_conflict_changes_nothing(
    tree: Path, row: str, told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    before = texts(tree)
    assert rekey(tree, 'file,key,old,new\n,,"another ""text""",another\n' + row + "\n") == 1
    assert f"conflict: {told}" in capsys.readouterr().out
    after = texts(tree)
    assert {path: after[path] for path in before} == before
