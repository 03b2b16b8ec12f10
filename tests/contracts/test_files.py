"""Other hazards of a stranger's file: numbers, keys, links, pipes and full disks."""

from __future__ import annotations

import os
import re
import signal
import socket
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from decimal import Decimal
from pathlib import Path

import pytest
from click.testing import CliRunner, Result
from doors import (
    EXPONENT_LIMIT,
    LOCK,
    PREFIX,
    SOURCE_DEPTH_LIMIT as DEPTH_LIMIT,
    ProblemError,
    cause_of,
    cli,
    read_decimal,
    served_folder,
    source_parse as parse,
    unwritten,
    visible,
)
from hypothesis import given, settings, strategies as st
from worked import path_of

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
"""Numbers whose exact fractions would have as many digits as their power of ten."""


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
    "play": ("play", str(EX3), "--frames"),
    "animate": ("animate", str(EX3), "--format", "svg"),
    "sketch": ("sketch", str(EX3)),
    "specimen": ("specimen", "lines"),
    "batch": ("batch", str(EX3), "--format", "svg"),
    "structure": ("structure", str(EX3), "--format", "svg"),
}


@pytest.mark.parametrize("name", WRITERS)
def test_no_file_is_written_through_a_link_to_elsewhere(
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


# Paths that are not files -------------------------------------------------------------------------

READ: tuple[tuple[str, ...], ...] = (
    ("solve", "ODD"), ("sheet", "ODD"), ("structure", "ODD"), ("variants", "ODD"), ("lint", "ODD"),
    ("audit", "ODD"), ("solve", "of_table.toml"), ("sheet", str(EX3), "--layout", "ODD"),
    ("sheet", str(EX3), "--settings", "ODD"), ("check", str(EX3), "ODD"),
    ("check", str(EX3), "w.csv", "--overrides", "ODD"),
    ("check", str(EX3), "w.csv", "--settings", "ODD"), ("form", str(EX3), "--names", "ODD"),
    ("variants", str(EX3), "--settings", "ODD"),
    ("note", str(path_of("levers/task-13")), "--template", "ODD"),
)  # fmt: skip


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes with a name here")
@pytest.mark.parametrize("odd", ["pipe", "device", "socket", "folder"])
def test_a_path_that_is_not_a_file_is_rejected_at_once(
    odd: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Reading a pipe without a writer never returns, and a device has no end."""
    monkeypatch.chdir(tmp_path)
    for name in ("odd", "v.csv"):
        if odd == "pipe":
            os.mkfifo(name)
        elif odd == "device":
            Path(name).symlink_to("/dev/zero")
        elif odd == "socket":
            with socket.socket(socket.AF_UNIX) as made:
                made.bind(name)
        else:
            Path(name).mkdir()
    Path("w.csv").write_text("student;what;value\nA;v_B1;3.2\n")
    Path("of_table.toml").write_text('variants = "v.csv"\n' + EX3_TEXT)

    def fail(*_: object) -> None:
        raise AssertionError

    before = signal.signal(signal.SIGALRM, fail)
    signal.setitimer(signal.ITIMER_REAL, 60)  # ends a test that waits
    try:
        for words in READ:
            if (words[0], odd) in (("solve", "folder"), ("check", "folder")):
                continue
            result = run(*["odd" if word == "ODD" else word for word in words])
            assert result.exit_code in (2, 3), (words, result.output)
            assert "Internal error" not in result.output
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


# Texts --------------------------------------------------------------------------------------------

BRACES = "План {v} {0} {} }{ {{x}}"


def test_braces_of_a_text_are_text_on_every_page(tmp_path: Path) -> None:
    path, works = tmp_path / "b.toml", tmp_path / "w.csv"
    path.write_text(re.sub("title = .*", f"title = '{BRACES}'", EX3_TEXT, count=1), "utf-8")
    works.write_text(f"student;what;value\n{BRACES};v_B1;3.2\nB {{v}};v_B1;{{0}}\n", "utf-8")
    out = ("-o", str(tmp_path / "out"))
    for words in (
        ("solve", str(path)), ("protocol", str(path)), ("structure", str(path)),
        ("check", "--key", str(path), *out), ("check", str(path), str(works), *out),
        ("form", str(path), *out), ("sheet", str(path), *out, "--format", "svg"),
        ("live", str(path), *out), ("play", str(path), *out), ("sketch", str(path), *out),
    ):  # fmt: skip
        result = run(*words)
        assert result.exit_code in (0, 1), (words, result.output)
    assert run("solve", str(path)).output.startswith(BRACES)
    assert f"Key: {BRACES}" in run("check", "--key", str(path), *out).output
    pages = [page.read_text("utf-8") for page in (tmp_path / "out" / "pages").glob("*.html")]
    assert len(pages) == 2 and all(BRACES in page for page in pages)
    assert any("B {v}" in page for page in pages)


@pytest.mark.parametrize(
    "sign",
    [*"\u202e\u2066\u200b\u200d\u2060\ufeff\xad\U000e0041\u3164\ufe0f"],
)
def test_a_letter_that_is_not_seen_is_in_no_title_and_shown_elsewhere(
    sign: str, tmp_path: Path
) -> None:
    path, works = tmp_path / "b.toml", tmp_path / "w.csv"
    path.write_text(re.sub("title = .*", f'title = "a{sign}b"', EX3_TEXT, count=1), "utf-8")
    assert f"U+{ord(sign):04X}" in refuses("solve", path, code=3)
    assert visible(f"a{sign}b") == "a\ufffdb"
    works.write_text(f"student;what;value\nA{sign}B;v_B1;3.2\n", "utf-8")
    run("check", str(EX3), str(works), "-o", str(tmp_path / "out"))
    for file in (tmp_path / "out").rglob("*"):
        assert sign not in file.name
        if file.suffix in (".html", ".csv", ".json"):
            assert sign not in file.read_text("utf-8-sig")


# Signals ------------------------------------------------------------------------------------------


@pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")
def test_a_command_that_is_ended_leaves_no_folder_and_no_part_of_a_file(tmp_path: Path) -> None:
    waits = tmp_path / "tmp"
    waits.mkdir()
    written = str(tmp_path / "out" / "a")
    code = (
        "import signal, sys, tempfile, time\n"
        "from pathlib import Path\n"
        "signal.signal(signal.SIGHUP, signal.SIG_DFL)\n"  # also where the tests run under nohup
        "from planmethod import __main__, cli\n"
        "from planmethod.render.backends.output import opened\n"
        "def work():\n"
        f"    with tempfile.TemporaryDirectory(dir={str(waits)!r}), opened({written!r}) as f:\n"
        "        f.write(b'x'); print('at work', flush=True); time.sleep(60)\n"
        "cli.main = work\n"
        "__main__.main()\n"
    )
    for name in ("SIGTERM", "SIGHUP"):
        number = getattr(signal, name)
        with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE) as command:
            assert command.stdout is not None
            assert command.stdout.readline() == b"at work\n"
            command.send_signal(number)
            assert command.wait(30) == 128 + number
        assert not [*waits.iterdir(), *(tmp_path / "out").iterdir()]


@pytest.mark.skipif(sys.platform == "win32", reason="locks of POSIX")
def test_a_server_clears_folders_of_dead_ones_alone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    dead, other = tmp_path / f"{PREFIX}dead", tmp_path / f"{PREFIX}other"
    for folder in (dead, other):
        (folder / "sessions").mkdir(parents=True)
    (dead / LOCK).write_bytes(b"")
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / LOCK).write_bytes(b"")
    (tmp_path / f"{PREFIX}link").symlink_to(tmp_path / "mine")
    with served_folder() as first:
        assert first.is_dir() and not dead.exists() and other.exists()
        with served_folder() as second:
            assert first.is_dir() and second.is_dir()
    assert sorted(path.name for path in tmp_path.iterdir()) == [
        "mine", f"{PREFIX}link", f"{PREFIX}other",
    ]  # fmt: skip
    assert (tmp_path / "mine" / LOCK).exists()


# Full disks ---------------------------------------------------------------------------------------


@pytest.mark.skipif(sys.platform == "win32", reason="limits of POSIX")
def test_a_limit_of_the_size_of_files_is_reported_like_a_full_disk(tmp_path: Path) -> None:
    """Also where a library writes into a folder of the system for a while."""
    works = tmp_path / "w.csv"
    works.write_text("student;what;value\nA;v_B1;3.2\n")
    words = ["--lang", "en", "check", str(EX3), str(works), "-o", str(tmp_path / "out")]
    code = (
        "import resource, sys\n"
        "resource.setrlimit(resource.RLIMIT_FSIZE, (3000, 3000))\n"
        "from planmethod.__main__ import main\n"
        "main()\n"
    )
    done = subprocess.run([sys.executable, "-c", code, *words], capture_output=True, timeout=60)
    assert done.returncode == 2, done.stderr
    assert b"Cannot write" in done.stderr or b"cannot write the output" in done.stderr
    assert b"larger than the system's limit" in done.stderr
    error = type("SerialisationError", (Exception,), {})("IO_ENOSPC")
    found = unwritten(error)
    assert found is not None and "no space left" in cause_of(found)
    assert unwritten(ValueError("IO_ENOSPC")) is None
