"""Paper formats: the tables of GOST 2.301, and names as people type them."""

from __future__ import annotations

import pytest
from doors import (
    PAPER_FORMATS as FORMATS,
    ExitCode,
    LayoutError,
    PaperFormat as Format,
    Views,
    paper_paper_format as paper_format,
)

LYING = [fmt for fmt in FORMATS.values() if not fmt.is_portrait]


@pytest.mark.parametrize(
    ("name", "size"),
    [
        ("A4", (210, 297)),
        ("A3", (420, 297)),
        ("A2", (594, 420)),
        ("A1", (841, 594)),
        ("A0", (1189, 841)),
        ("A1x3", (1783, 841)),
        ("A2x3", (1261, 594)),
        ("A3x3", (891, 420)),
        ("A4x3", (630, 297)),
        ("A4x4", (841, 297)),
        ("A3:portrait", (297, 420)),
        ("A4x3:portrait", (297, 630)),
    ],
)
def test_sizes(name: str, size: tuple[int, int]) -> None:
    assert (FORMATS[name].width, FORMATS[name].height) == size


def test_all_the_elongated_ones_are_there() -> None:
    found = {fmt.size for fmt in FORMATS.values() if "x" in fmt.size}
    counts = {"A4": range(3, 10), "A3": range(3, 8), "A2": range(3, 6), "A1": (3, 4), "A0": (2, 3)}
    assert found == {f"{base}x{times}" for base, many in counts.items() for times in many}


@pytest.mark.parametrize(
    "lying", [fmt for fmt in LYING if "x" in fmt.size], ids=lambda fmt: fmt.name
)
def test_an_elongated_format_is_its_short_side_taken_many_times(lying: Format) -> None:
    """The long side of the base stays; the multiple is that of the exact side, to 1.5 mm."""

    base, times = lying.size.split("x")
    sides = sorted((FORMATS[base].width, FORMATS[base].height))
    assert lying.height == sides[1]
    exact = 1000 * 2 ** (-0.25 - int(base[1]) / 2)
    assert sides[0] == pytest.approx(exact, abs=0.7)
    assert lying.width == pytest.approx(int(times) * exact, abs=1.5)


def test_every_size_belongs_to_one_format_and_only_a4_is_upright() -> None:
    assert len({(fmt.width, fmt.height) for fmt in FORMATS.values()}) == len(FORMATS)
    assert [name for name in FORMATS if name.startswith("A4") and "x" not in name] == ["A4"]
    for fmt in FORMATS.values():
        assert fmt.is_portrait == (fmt.name == "A4" or fmt.name.endswith(":portrait"))
        assert Views.for_paper(fmt.name, 1).paper == fmt.name  # every format has boxes of views


@pytest.mark.parametrize(
    ("typed", "name"),
    [
        ("A3", "A3"),
        ("a3", "A3"),
        (" \u04103 ", "A3"),
        ("\u04303", "A3"),
        ("\u04104\u04453", "A4x3"),
        ("A4×3", "A4x3"),
        ("A3:portrait", "A3:portrait"),
        ("а3 : Книжная", "A3:portrait"),
        ("A3:landscape", "A3"),
        ("А2:альбомный", "A2"),
        ("A4:portrait", "A4"),
        ("a4x3:PORTRAIT", "A4x3:portrait"),
    ],
)
def test_names_are_forgiving(typed: str, name: str) -> None:
    assert paper_format(typed).name == name


@pytest.mark.parametrize(
    ("typed", "said"),
    [
        ("B5", r"Unknown paper format 'B5'\. Choose A4, A3, A2, A1, A0, .*A4x3.*A3:portrait"),
        ("A5", "Unknown paper format 'A5'"),
        ("A4:landscape", r"A4 must be portrait by GOST 2\.301"),
        ("A3x2", r"GOST 2\.301 has no paper format A3x2\. A3 can be elongated to A3x3, .*A3x7"),
        ("A3:up", r"Unknown orientation 'up'.*A3:portrait"),
        ("A3:", "Unknown orientation ''"),
        ("", "Unknown paper format ''"),
    ],
)
def test_unknown_formats_are_rejected(typed: str, said: str) -> None:
    with pytest.raises(LayoutError, match=said) as caught:
        paper_format(typed)
    assert caught.value.exit_code is ExitCode.USAGE
