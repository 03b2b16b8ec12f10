"""What a stranger's file does beside its words: numbers, keys, links, pipes and full disks."""

from __future__ import annotations

from collections.abc import Sequence
from decimal import Decimal
from pathlib import Path

import pytest
from click.testing import CliRunner, Result
from hypothesis import given, settings
from hypothesis import strategies as st
from worked import path_of

from planmethod.cli import cli
from planmethod.errors import ProblemError
from planmethod.problem.formula import EXPONENT_LIMIT, read_decimal
from planmethod.problem.source import DEPTH_LIMIT, parse

EX3 = path_of("linkages/ex3")
EX3_TEXT = EX3.read_text("utf-8")


def run(*words: str) -> Result:
    return CliRunner().invoke(cli, ("--lang", "en", *words))


def refuses(*words: str | Path, code: int, said: str = "") -> str:
    result = run(*map(str, words))
    assert result.exit_code == code, result.output
    assert said in result.output, result.output
    return result.output


# Numbers ------------------------------------------------------------------------------------------

FAR = ("1e99999999", "-1e-99999999", "0e99999999999999999999", "1e-99999999999999999999")
"""As fractions they have as many digits as they say; the longer ones no exact number takes."""


@pytest.mark.parametrize("text", FAR)
def test_no_power_of_ten_is_worked_out_that_no_number_has(text: str, tmp_path: Path) -> None:
    assert read_decimal(text) is None
    linkage, point, table = tmp_path / "l.toml", tmp_path / "p.toml", tmp_path / "v.csv"
    linkage.write_text(EX3_TEXT.replace("AB = 0.064", f'AB = "{text}"'))
    assert "the power of ten" in refuses("solve", linkage, code=3)
    point.write_text(f'title = "p"\n[point]\nx = "{text}*t"\ny = "4*t"\nt = 0\n')
    assert "the power of ten" in refuses("solve", point, code=3)
    linkage.write_text('variants = "v.csv"\n' + EX3_TEXT)
    table.write_text(f"variant;driver.phi\n1;{text}\n")
    assert "the power of ten" in refuses("solve", linkage, "--all-variants", code=3)
    layout = tmp_path / "layout.toml"
    layout.write_text(f'sizes.A1.letter = "{text}"\n[[blocks]]\nkind = "results"\n')
    assert "the power of ten" in refuses("sheet", EX3, "--layout", layout, code=2)
    overrides, works = tmp_path / "o.csv", tmp_path / "w.csv"
    overrides.write_text(f"student;points\nA;{text}\n")
    works.write_text(f"student;what;value\nA;v_B1;{text}\n")
    check = ("check", EX3, works, "-o", tmp_path / "out")
    assert "points are a number" in refuses(*check, "--overrides", overrides, code=2)
    assert run(*map(str, check)).exit_code == 1


@pytest.mark.parametrize("text", (*FAR, "nan", "inf", "1_0", "", "1/0/1"))
def test_an_option_takes_numbers_that_are_some(text: str) -> None:
    for words in (
        ("teeth", f"--U={text}"), ("teeth", f"--U=1/{text}"),
        ("teeth", "--U=6", f"--modules={text}"),
        ("solve", str(EX3), f"--phi={text}"), ("solve", str(EX3), f"--ruler={text}"),
        ("animate", str(EX3), f"--seconds={text}"),
        ("variants", str(EX3), f"--spread={text}"),
        ("variants", str(EX3), f"--vary=driver.phi=0..{text}"),
        ("studio", f"--time={text}"), ("synthesize", "slider-crank", f"--stroke={text}"),
    ):  # fmt: skip
        if words == ("teeth", "--U=1/"):
            continue  # a whole number
        refuses(*words, code=2)


@given(
    st.from_regex(
        r"[-+]?([0-9]{1,9}\.?[0-9]{0,9}|\.[0-9]{1,9})(e[-+]?[0-9]{1,30})?", fullmatch=True
    )
)
@settings(max_examples=100)
def test_a_number_is_read_as_it_is_written_or_not_at_all(text: str) -> None:
    number, power = read_decimal(text), text.partition("e")[2] or "0"
    assert (number is None) == (abs(int(power)) > EXPONENT_LIMIT)
    assert number is None or number == Decimal(text)


# Keys ---------------------------------------------------------------------------------------------

PARTS = ("a", "'a'", '"a"', '"a.b"', '"\\""', "'\"'", '"#"', '"é"')
BEFORE = (
    "",
    'b = """x"""',
    "b = '''\n#'''''",
    'b = "\\""',
    "b = '\"'",
    "b = 1 # '''",
    'b = """"""',
)


def depth_of(text: str) -> str:
    with pytest.raises(ProblemError) as told:
        parse(text, name="x")
    return str(told.value)


@given(
    parts=st.one_of(
        st.lists(st.sampled_from(PARTS), min_size=DEPTH_LIMIT + 1, max_size=40),
        st.sampled_from(PARTS).map(lambda one: 20 * [one]),
    ),
    dot=st.sampled_from((".", " . ", "\t.")),
    shape=st.sampled_from(
        ("{} = 1", "[{}]", "[[ {} ]]", "c = {{ {} = 1 }}", "c = [[{{ {} = 1 }}]]",
         'c = {{ b = """x"""", {} = 1 }}', "c = {{ b = '''x''''', {} = 1 }}")
    ),
    before=st.sampled_from(BEFORE),
)  # fmt: skip
@settings(max_examples=100)
def test_parts_of_a_key_are_counted_before_anything_is_made_of_them(
    parts: Sequence[str], dot: str, shape: str, before: str
) -> None:
    """The parser's time grows with the square of them: quoted ones took 19 s and 984 MB."""
    text = f"{before}\n{shape.format(dot.join(parts))}\n"
    assert f"line {text.count(chr(10))}: a key has over {DEPTH_LIMIT} parts" in depth_of(text)


@given(
    before=st.sampled_from(BEFORE), dots=st.sampled_from((".", ".x", " . a", "1.")),
    shape=st.sampled_from(
        ('a = "{}"', "a = '{}'", 'a = """\n{}"""', "a = '''\n{}'''", "a = 1 # {}")
    ),
)  # fmt: skip
@settings(max_examples=50)
def test_dots_of_a_text_are_no_parts_of_a_key(before: str, dots: str, shape: str) -> None:
    assert parse(f"{before}\n{shape.format('x' + 40 * dots)}\n", name="x")["a"]


# Links --------------------------------------------------------------------------------------------

WRITERS: dict[str, tuple[str, ...]] = {
    "sheet": ("sheet", str(EX3), "--format", "svg"),
    "one file": ("sheet", str(EX3), "--one-file", "set.pdf"),
    "check": ("check", str(EX3), "works.csv"),
    "key": ("check", "--key", str(EX3)),
    "project": ("project", "PROJECT", "--parts", "kinematics", "--format", "svg"),
    "form": ("form", str(EX3)),
    "live": ("live", str(EX3)),
    "animate": ("animate", str(EX3), "--format", "svg"),
    "sketch": ("sketch", str(EX3)),
    "specimen": ("specimen", "lines"),
    "batch": ("batch", str(EX3), "--format", "svg"),
    "structure": ("structure", str(EX3), "--format", "svg"),
}


@pytest.mark.parametrize("name", WRITERS)
def test_nothing_is_written_where_a_link_leads_out(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A folder in it, or a file; the project, which has its own folder, is dear."""
    monkeypatch.chdir(tmp_path)
    Path("works.csv").write_text("student;what;value\nA;v_B1;3.2\n")
    words = [str(path_of("levers/task-13")) if w == "PROJECT" else w for w in WRITERS[name]]
    assert run(*words, "-o", "out").exit_code in (0, 1)
    made = sorted(Path("out").rglob("*"))
    folders = [path for path in made if path.is_dir()]
    outside = Path("outside")
    outside.mkdir()
    files = [path for path in made if path.is_file() and path.name != "overrides.csv"]
    for number, path in enumerate(folders or files[:1]):
        is_folder = path.is_dir()
        out = Path(f"out{number}")
        link = out / path.relative_to("out")
        link.parent.mkdir(parents=True)
        kept = outside / "kept"
        if not is_folder:
            kept.write_text("kept")
        link.symlink_to(outside.resolve() if is_folder else kept.resolve())
        result = run(*words, "-o", str(out))
        assert link.is_symlink() == (result.exit_code == 2), result.output
        assert not link.is_symlink() or "out of the folder" in result.output
        assert [one.name for one in outside.iterdir()] == ["kept"] * kept.exists()
        assert is_folder or kept.read_text() == "kept"
