"""Tables and the calculation of a pair of wheels: numbers in formulas, limits, units."""

from __future__ import annotations

import re
from collections.abc import Callable
from math import acos, asin, atan, degrees, pi
from pathlib import Path

import pytest
from cases import each
from doors import (
    WORDING_LANGUAGES as LANGUAGES,
    Document,
    FormulasUnit as Unit,
    SolvedMeshing,
    get_language,
    inlined,
    involute_reader_load as load,
    plain_document,
    plain_text,
    solved_document,
)
from worked import PROBLEMS

BODIES = {
    "shifted": "z = [12, 30]\nm = 5\nx = [0.59, 0.53]",
    "cut": "z = [9, 14]\nm = 2\nx = [0, 0]",
    "negative": "z = [40, 60]\nm = 3\nx = [-0.2, 0.35]",
    "helical": "z = [17, 40]\nm = 4\nbeta = 15\nb = 40\nx = [0.3, 0.2]",
}


def solved_of(name: str, folder: Path) -> SolvedMeshing:
    if name == "ring":
        return SolvedMeshing(load(PROBLEMS / "meshing" / "z20-60-internal.toml"))
    path = folder / "pair.toml"
    path.write_text(f"[meshing]\n{BODIES[name]}\n", encoding="utf-8")
    return SolvedMeshing(load(path))


def _in_degrees(of: Callable[[float], float]) -> Callable[[float], float]:
    return lambda x: degrees(of(x))


def value_of(text: str) -> float:
    """Return the value of a formula with numbers, angles in degrees."""
    text = re.sub(r"\^\{(\d)\}", r"**\1", inlined(text))
    text = text.replace("·", "*").replace("−", "-").replace("π", str(pi))
    return float(
        eval(text, {f"arc{one.__name__[1:]}": _in_degrees(one) for one in (acos, asin, atan)})
    )


@each("name", [*BODIES, "ring"])
def test_formulas_with_their_numbers_give_the_printed_results(name: str, tmp_path: Path) -> None:
    solved = solved_of(name, tmp_path)
    count = 0
    for key, line in solved.formulas(get_language("en")):
        _, _, numbers, shown = line.split(" = ")
        if shown.startswith("—") or "nan" in shown:
            continue
        value = float(re.sub(r"( mm|°)$", "", shown).replace("−", "-"))
        assert value_of(numbers) == pytest.approx(value, rel=1e-3, abs=6e-3), line
        assert shown.endswith(" mm") == (key in LENGTHS), line
        assert shown.endswith("°") == key.startswith(("alpha", "beta")), line
        count += 1
    assert count > 25


LENGTHS = {
    "a", "a_w", "p", "p_b", "d", "d_b", "d_w", "d_a", "d_f", "s", "s_a", "W", "rho_a", "rho_p",
    "rho_l", "g_alpha", "e", "h", "m_t", "s_na",
}  # fmt: skip


@each("name", [*BODIES, "ring"])
def test_limits_are_printed_as_true_inequalities(name: str, tmp_path: Path) -> None:
    for lang in LANGUAGES:
        seen = set()
        for limit, holds, text in solved_of(name, tmp_path).sentences(get_language(lang)):
            said = plain_text(text).replace(",", ".").replace("−", "-")
            found = re.search(r"(-?\d+\.\d{3})[^-\d]*([≥≤<>])(?:.* )?(-?\d+\.\d{3})", said)
            assert found is not None, said
            left, sign, right = float(found[1]), found[2], float(found[3])
            true = {"≥": left >= right, "≤": left <= right, "<": left < right, ">": left > right}
            assert true[sign] or abs(left - right) < 2e-3, said
            assert holds == (sign in "≥≤"), said
            seen.add((limit.kind, holds))
        assert any(holds for _, holds in seen)


def test_wheel_1_comes_before_wheel_2(tmp_path: Path) -> None:
    solved = solved_of("cut", tmp_path)
    assert any(not holds for _, holds, _ in solved.sentences(get_language("en")))
    words = get_language("en")
    text = plain_document(Document.of(solved_document(solved.problem, words)), words)
    rows = dict(re.findall(r"\n([a-z ,]+?)  +z? *(?:d_a )? *(\S+ +\S+)(?=\n)", text))
    assert rows["number of teeth"].split() == ["9", "14"]
    one, two = map(float, rows["tip diameter, mm"].split())
    assert one == pytest.approx(2 * (9 + 2))
    assert two == pytest.approx(2 * (14 + 2))


@each("key", ["m", "p", "p_b", "a", "a_w"])
def test_sizes_that_grow_with_the_module_are_printed_in_mm(key: str, tmp_path: Path) -> None:
    small = solved_of("shifted", tmp_path)
    path = tmp_path / "large.toml"
    path.write_text(f"[meshing]\n{BODIES['shifted'].replace('m = 5', 'm = 10')}\n", "utf-8")
    large = SolvedMeshing(load(path))
    pairs = [
        (one.quantity, one.values, other.values)
        for group, others in zip(small.sized_quantities(), large.sized_quantities(), strict=True)
        for one, other in zip(group, others, strict=True)
    ]
    assert key in {quantity.key for quantity, _, _ in pairs}
    for quantity, values, doubled in pairs:
        grows = doubled == pytest.approx([2 * v for v in values], rel=1e-9, nan_ok=True)
        if any(values) and not all(v != v for v in values):
            assert grows == (quantity.unit is Unit.MM), quantity.key
