"""Faulty files: every fault is reported, with exactly this message, and no other."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from doors import (
    LINE_LIMIT,
    SIZE_LIMIT,
    ExitCode,
    ProblemError,
    problem_load as load,
    problem_loads as loads,
    variant_names,
)
from worked import path_of

FAULTY = Path(__file__).parent / "faulty"
CASES = sorted(FAULTY.glob("*.toml"))


def expected_of(text: str) -> list[str]:
    """The faults a file announces in its last lines."""
    mark = "# fault: "
    return [line.removeprefix(mark) for line in text.splitlines() if line.startswith(mark)]


def message_of(path: Path) -> str:
    with pytest.raises(ProblemError) as caught:
        load(path)
    return str(caught.value).removeprefix(f"{path}: ")


@pytest.mark.parametrize("path", CASES, ids=lambda path: path.stem)
def test_every_fault_is_reported_and_no_other(path: Path) -> None:
    with pytest.raises(ProblemError) as caught:
        load(path)
    assert [str(fault) for fault in caught.value.faults] == expected_of(
        path.read_text(encoding="utf-8")
    )
    assert caught.value.exit_code is ExitCode.PROBLEM


def test_there_are_many_cases_and_some_have_five_faults() -> None:
    counts = [len(expected_of(path.read_text(encoding="utf-8"))) for path in CASES]
    assert len(CASES) >= 100
    assert min(counts) >= 1
    assert counts.count(5) >= 3


def test_all_faults_are_in_one_message() -> None:
    message = message_of(FAULTY / "five-of-all-kinds.toml")
    assert message.splitlines()[0] == "5 faults in the problem file"
    assert len(message.splitlines()) == 6


def test_missing_file_names_the_nearest(tmp_path: Path) -> None:
    (tmp_path / "press.toml").write_text("", encoding="utf-8")
    assert message_of(tmp_path / "pres.toml") == (
        "1 fault in the problem file\n"
        f"  this file does not exist. Did you mean '{tmp_path / 'press.toml'}'?"
    )
    (tmp_path / "link.toml").symlink_to("nowhere.toml")
    there = f"this file does not exist. In '{tmp_path}' there are press.toml."
    assert message_of(tmp_path / "link.toml").endswith(there)
    assert message_of(tmp_path / "else.toml").endswith(there)


@pytest.mark.parametrize("typed", ["t40", "t40.tom", "T40"])
def test_a_name_without_its_ending_is_reported_with_it(typed: str, tmp_path: Path) -> None:
    for name in ("t40.toml", "t41.toml", "t400.toml"):
        (tmp_path / name).write_text("", encoding="utf-8")
    assert message_of(tmp_path / typed).endswith(f"Did you mean '{tmp_path / 't40.toml'}'?")


def test_missing_folder(tmp_path: Path) -> None:
    assert message_of(tmp_path / "no" / "ex.toml").endswith(
        f"this file does not exist. The folder '{tmp_path / 'no'}' does not exist either. "
        "Check the path."
    )
    assert message_of(tmp_path / "ex.toml").endswith("this file does not exist. Check the path.")


def test_directory(tmp_path: Path) -> None:
    assert message_of(tmp_path).endswith("this is a directory. Name the file itself, *.toml.")


def test_device() -> None:
    assert message_of(Path("/dev/null")).endswith(
        "this is not an ordinary file. Name a file, *.toml."
    )


def test_path_with_a_null_byte() -> None:
    assert "the file cannot be read" in message_of(Path("ex\0.toml"))


def test_windows_1251(tmp_path: Path) -> None:
    path = tmp_path / "old.toml"
    path.write_bytes('source = "x"\ntitle = "Механизм"\n'.encode("cp1251"))
    assert message_of(path).endswith(
        "line 2: byte 0xCC is not UTF-8. Save the file as UTF-8; "
        "Russian text is often saved as Windows-1251 by mistake."
    )


def test_utf_16(tmp_path: Path) -> None:
    path = tmp_path / "wide.toml"
    path.write_bytes('title = "x"'.encode("utf-16"))
    assert message_of(path).endswith("the file is in UTF-16, expected UTF-8. Save it as UTF-8.")


def test_a_byte_order_mark_adds_no_further_fault(tmp_path: Path) -> None:
    path = tmp_path / "bom.toml"
    path.write_bytes(b'\xef\xbb\xbftitle = "x"')
    assert "links: missing" in message_of(path)
    with pytest.raises(ProblemError, match="links: missing"):
        loads('\ufefftitle = "x"', name="bom")


def test_too_large_a_file(tmp_path: Path) -> None:
    path = tmp_path / "large.toml"
    path.write_bytes(b"# " * (SIZE_LIMIT // 2) + b"\n")
    assert message_of(path).endswith(
        "the file is larger than 262144 bytes (256 KiB). "
        "A few kilobytes are enough; is this the right file?"
    )
    with pytest.raises(ProblemError, match="larger than 262144 bytes"):
        loads("# ы" * (SIZE_LIMIT // 3), name="large")


def test_a_list_of_numbers_may_be_longer_than_a_line() -> None:
    numbers = ", ".join(f"{number / 100:.2f}" for number in range(9000))
    assert len(numbers) > LINE_LIMIT
    text = path_of("linkages/ex3").read_text("utf-8")
    for value in (f"[{numbers}]", f"[\n  {numbers},\n]"):
        many = re.sub(r"(?m)^phi = [^#\n]*", f"phi = {value} ", text)
        assert len(loads(many, name="many").drive.positions) == 9000


@pytest.mark.parametrize("depth", [10, 400, 3000])
def test_brackets_below_an_open_list_are_a_fault_of_the_file(depth: int) -> None:
    # The parser of the file stops at "x"; the hint's parser is given the line with the brackets.
    with pytest.raises(ProblemError, match=r"line 2, column 1: this is not TOML"):
        loads("phi = [\nx = " + "[" * depth, name="deep")


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("phi = [" + "1, x, " * LINE_LIMIT + "]", "line 1 has"),
        ("#" * (LINE_LIMIT + 1), "line 1 has 8193 characters, the limit is 8192"),
        ("a = " + "[\n" * 50_000, "lists or tables are nested too deeply"),
        ("gears = " + "{ a = " * 20 + "1" + " }" * 20, "tables are nested deeper than 12 levels"),
        ("a" + ".a" * 12 + " = 1", "line 1: a key has over 12 parts"),
        ("title = " + "9" * 5000, "a value cannot be read"),
        ("[driver]\nphi = 0x" + "f" * 4000, "driver.phi: expected an angle in degrees, got inf"),
        (
            "".join(f"[links.{n}]\n" for n in range(1, 203)),
            "links: 202 links, the limit is 201",
        ),
        (
            "[links.1]\npoints = [" + ", ".join(f'"A{n}"' for n in range(61)) + "]\n",
            "links.1.points: 61 points in a link, the limit is 60",
        ),
        (
            "".join(
                f"[links.{n}]\npoints = ["
                + ", ".join(f'"{letter}{n}"' for letter in "ABCDEFGHIJKLMNOPQRSTUVWXYZ")
                + "]\n"
                for n in range(1, 17)
            ),
            "links: 416 points, the limit is 400",
        ),
        (
            "[frame]\n" + "".join(f"A{n} = [0, 0]\nB{n} = [0, 1]\n" for n in range(201)),
            "frame: 402 points, the limit is 400",
        ),
        (
            "[links.1]\npoints = ['A']\n" + "".join(f"AB{n} = 1\n" for n in range(200)),
            "links.1: 201 keys in a link, the limit is 200",
        ),
        (
            "".join(f"[variants.v{n}]\n" for n in range(10_001)),
            "variants: 10001 variants, the limit is 10000",
        ),
        (
            "[links.1]\n[frame]\n[driver]\n[published]\n"
            + "".join(f"v{n}.value = 1\n" for n in range(1001)),
            "published: 1001 values, the limit is 1000",
        ),
        (
            "[driver]\nphi = [" + ",\n".join("1" for _ in range(10_001)) + "]",
            "driver.phi: 10001 positions, the limit is 10000",
        ),
        (
            "[driver]\nphi = { from = 0, count = 99999999999999999999 }",
            "driver.phi.count: over a billion positions, the limit is 10000",
        ),
        (
            "[driver]\nphi = { from = 0, to = 360, step = 1e-20 }",
            "driver.phi: over a billion positions, the limit is 10000",
        ),
        (
            "[links.'" + "1" * 25 + "']\npoints = ['A', 'B']",
            "cannot name a link. Use letters and digits, at most 24.",
        ),
        (
            f"title = '{'x' * 301}'",
            "title: the text has 301 characters, the limit is 300. Shorten it.",
        ),
    ],
    ids=lambda value: value[:30] if isinstance(value, str) and len(value) < 90 else "",
)
def test_bounds_are_reported_with_numbers(text: str, wanted: str) -> None:
    base = '\n[frame]\nA = [0, 0]\n[links.1]\npoints = ["A", "B"]\nAB = 1\n'
    if text.startswith("[driver]"):
        text = text.replace("[driver]", '[driver]\nlink = "1"\nomega = 1') + base
    with pytest.raises(ProblemError) as caught:
        loads(text, name="stranger")
    assert wanted in str(caught.value)


def test_a_flood_of_faults_is_cut() -> None:
    text = "".join(f"key{n} = 1\n" for n in range(20_000))
    with pytest.raises(ProblemError) as caught:
        loads(text, name="flood")
    assert len(caught.value.faults) == 101
    assert str(caught.value.faults[-1]) == "and 19901 more faults. Fix these first."


def test_names_of_strangers_are_cut_in_messages() -> None:
    with pytest.raises(ProblemError) as caught:
        loads("k" * 4000 + " = 1", name="long")
    assert max(map(len, str(caught.value).splitlines())) < 300


def test_variant_names_of_a_faulty_file() -> None:
    with pytest.raises(ProblemError, match=r"driver\.phy"):
        variant_names(FAULTY / "variant-unknown-path.toml")
