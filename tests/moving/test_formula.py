"""Faults of formulas and of ``[point]``: the message of each, without side effects."""

from __future__ import annotations

import random
import re
from pathlib import Path
from typing import Any

import mpmath
import numpy as np
import pytest
from doors import (
    CALLS,
    FORMULA_DEPTH_LIMIT as DEPTH_LIMIT,
    FUNCTIONS,
    LENGTH_LIMIT,
    ExitCode,
    Faults,
    FileNode,
    ProblemError,
    kind_of,
    read_formula,
    reader_loads as loads,
    series_evaluate as evaluate,
    speaking,
)


def faults_of(text: str) -> list[str]:
    with pytest.raises(ProblemError) as caught:
        loads(text, name="p")
    assert caught.value.exit_code is ExitCode.PROBLEM
    return [str(fault) for fault in caught.value.faults]


def fault_of(formula: str) -> str:
    (fault,) = faults_of(f"[point]\nx = '{formula}'\ny = 't'\nt = 0\n")
    assert fault.startswith("point.x: ")
    return fault.removeprefix("point.x: ")


def test_every_function_has_its_derivatives() -> None:
    assert set(FUNCTIONS.values()) == set(CALLS)


@pytest.mark.parametrize(
    ("formula", "said"),
    [
        ("", "the formula is empty. For example: "),
        ("3t", "character 2: expected an operator before 't'. Multiplication needs a sig"),
        ("0.3.1", "character 4: expected an operator before '.1'. A number has one decimal point."),
        ("2(t + 1)", "character 2: expected an operator before '('."),
        ("(2 3)", "character 4: expected an operator before '3'."),
        ("sin t", "character 1: expected '(' after sin. Write sin(t)."),
        ("sni(t)", "character 1: unknown name 'sni'. Did you mean 'sin'?"),
        ("q + 1", "character 1: unknown name 'q'. Known: t, pi, e, sin, "),
        ("3*х", "'3*х' has the Cyrillic letter х (U+0445), expected the Latin letter 'x'"),
        ("7,5*t", "character 2: ',' has no meaning in a formula. The decimal sign is a point: 7.5"),
        ("2·t", "character 2: '·' has no meaning in a formula. Write *."),
        ("x = t", "character 3: '=' has no meaning in a formula. Write only the right side here."),
        ("t; t", "character 2: ';' has no meaning in a formula"),
        ("(t + 1", "character 1: '(' is not closed. Add ')'."),
        ("t + 1)", "character 6: ')' closes no '('"),
        ("sin()", "character 5: expected a number, got ')'."),
        ("t +", "the formula ends where a number or a name is expected"),
        ("t*/2", "character 3: expected a number, got '/'"),
        ("1e999", "character 1: the power of ten of 1e999 is beyond 400"),
        ("(" * 41 + "t", f"the formula is nested deeper than {DEPTH_LIMIT} levels"),
        ("t" + "^t" * 41, f"the formula is nested deeper than {DEPTH_LIMIT} levels"),
        ("t" * 501, f"the formula has 501 characters, the limit is {LENGTH_LIMIT}"),
        ("__import__(t)", "character 1: unknown name '__import__'."),
    ],
)
def test_a_faulty_formula_is_reported(formula: str, said: str) -> None:
    assert said in "; ".join(
        faults_of(f"[point]\nx = '{formula}'\ny = 't'\nt = 0\n")
        if "Cyrillic" in said
        else [fault_of(formula)]
    )


@pytest.mark.parametrize("formula", ["3t", "sin t", "2·t", "7,5*t", "(t + 1", "sni(t)", "1e999"])
def test_faults_of_formulas_have_no_english_words_in_russian(formula: str) -> None:
    with speaking("ru"):
        found = fault_of(formula)
    assert not set(re.findall("[A-Za-z]{3,}", found)) - {"sin", "sni"}, found


def test_the_longest_formulas_are_read() -> None:
    for formula in ("-" * 499 + "t", "t" + "+t" * 249, "(" * 40 + "t" + ")" * 40):
        made = FileNode(Faults(), formula, "x").attempt(read_formula)
        assert made is not None
        assert evaluate(made, np.array([1.0])).value.value in ([-1.0], [250.0], [1.0])


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("title = 'x'", ["point: missing. For example: "]),
        ("point = 3", ["point: expected a table, got the integer 3. "]),
        ("[point]\nx = 't'\ny = 't'", ["point.t: missing. "]),
        ("[point]\nx = 't'\ny = 't'\nt = true", ["point.t: expected a moment in seconds"]),
        ("[point]\nx = 't'\nt = 0", ["point.y: missing. "]),
        ("[point]\nt = 0", ["point: expected x and y, r and phi, or s, or a wheel and phi. "]),
        (
            "[point]\nx = 't'\ny = 't'\nr = 't'\nt = 0",
            ["point: the motion is stated twice: x, y and r, phi. Keep one of them."],
        ),
        (
            "[point]\nx = 't'\ny = 't'\nradius = 2\nt = 0",
            ["point.radius: valid only with s(t). Omit it."],
        ),
        (
            "[point]\ns = 't'\nradius = -1\nt = 0",
            ["point.radius: expected a length in metres great"],
        ),
        ("[point]\nx = 't'\nz = 't'\ny = '1'\nt = 0", ["point.z: unknown key. "]),
        (
            "[point]\nx = true\ny = [1]\nt = 0",
            ["point.x: expected a formula", "point.y: expected a"],
        ),
        (
            "[point]\nx = nan\ny = inf\nt = 0",
            ["point.x: expected a finite", "point.y: expected a f"],
        ),
        ("[point]\ns = 't'\nt = '2*t'", ["point.t: expected a number or a formula without t. "]),
        ("[point]\ns = 't'\nt = 'ln(0)'", ["point.t: 'ln(0)' has no value"]),
        ("[point]\ns = 't'\nt = []", ["point.t: expected at least one moment"]),
        ("[point]\ns = 't'\nt = [0, 'x']", ["point.t[1]: character 1: unknown name 'x'."]),
        (
            "[point]\ns = 't'\nt = 1e9",
            ["point.t: expected a moment in seconds from -1e+06 to 1e+0"],
        ),
        (
            "[point]\ns = 't'\nt = { from = 0 }",
            ["point.t: expected { from, to, step } or { from, t"],
        ),
        (
            "[point]\ns = 't'\nt = { from = 0, to = 1, step = -1 }",
            ["point.t.step: the step -1 does not lead from 0 to 1"],
        ),
        (
            "[point]\ns = 't'\nt = { from = 0, to = 1, step = 1e-9 }",
            ["point.t: over a billion positions, the limit is 10000"],
        ),
        (
            "[point]\ns = 't'\nt = 0\n[driver]\nlink = '1'",
            ["driver: unknown key. Known here: title"],
        ),
        (
            "[point]\ns = 't'\nt = 0\n[published.v]\nvalue = 1\nwhat = 'rh'",
            ["published.v.what: a moving point has no 'rh'. Did you mean 'rho'?"],
        ),
        (
            "[point]\ns = 't'\nt = [0, 1]\n[published.v]\nvalue = 1\nwhat = 'v'",
            ["published.v.position: missing. There are 2 moments: from 0."],
        ),
        (
            "[point]\ns = '3t'\nt = 'q'\n[published.v]\nvalue = 'a'\n[stamp]\nauthr = 'x'",
            ["point.s: ", "point.t: ", "stamp.authr: ", "published.v.value: "],
        ),
    ],
)
def test_all_faults_of_a_file_are_reported_at_once(text: str, said: list[str]) -> None:
    found = faults_of(text)
    assert len(found) == len(said), found
    assert all(one.startswith(start) for one, start in zip(found, said, strict=True)), found


def test_a_strangers_formula_gives_faults_or_numbers_only() -> None:
    pieces = [*"+-*/^()., 0123eEt", "**", "1e308", "t", "pi", *FUNCTIONS, "х", "\t", "²", "1/0"]
    draw = random.Random(13)
    read = 0
    for _ in range(3000):
        formula = "".join(draw.choice(pieces) for _ in range(draw.randint(1, 9)))
        made = FileNode(Faults(), formula, "x").attempt(read_formula)
        if made is not None:
            read += 1
            jet = evaluate(made, np.array([0.0, 0.5]))
            assert all(part.value.shape == (2,) for part in (jet.value, jet.rate, jet.acceleration))
    assert read > 50


def test_which_files_are_moving_points(tmp_path: Path) -> None:
    path = tmp_path / "p.toml"
    for text, wanted in (("[point]", "point"), ("[point]\n[links]", "links"), ("", "links")):
        path.write_text(text, encoding="utf-8")
        assert kind_of(path).table == wanted


SAFE = ("sin({})", "cos({})", "exp({}/4)", "sh({}/3)", "th({})", "arctg({})", "sqrt(1 + ({})^2)")
JOINED = ("({}) + ({})", "({}) - ({})", "({})*({})", "({})/(2 + sin({}))", "ln(3 + cos({}))*({})")


def made_up(draw: random.Random, depth: int) -> str:
    if depth == 0:
        return draw.choice(
            ["t", "t", "0.7", "pi", "3", "t^2", "t^(-2)", "2^t", "t^0.3", "(t - 0.9)"]
        )
    if draw.random() < 0.5:
        return draw.choice(SAFE).format(made_up(draw, depth - 1))
    return draw.choice(JOINED).format(made_up(draw, depth - 1), made_up(draw, depth - 1))


def test_errors_of_derivatives_keep_within_their_bounds() -> None:
    names = {name: getattr(mpmath, name) for name in ("sin", "cos", "exp", "sqrt", "pi")}
    names |= {"sh": mpmath.sinh, "th": mpmath.tanh, "arctg": mpmath.atan, "ln": mpmath.log}
    draw = random.Random(6)
    looked = 0
    for _ in range(80):
        text = made_up(draw, 3)
        made = FileNode(Faults(), text, "x").attempt(read_formula)
        assert made is not None, text
        jet = evaluate(made, np.array([0.9]))
        with mpmath.workdps(60):
            code = compile(re.sub(r"([\d.]*\d)", r"mpf(\1)", text.replace("^", "**")), "x", "eval")

            def exact(t: Any, code: Any = code) -> Any:
                given = {**names, "mpf": lambda number: mpmath.mpf(float(number)), "t": t}
                return mpmath.mpf(1) * eval(code, {"__builtins__": {}}, given)

            for order, part in enumerate((jet.value, jet.rate, jet.acceleration)):
                value, radius = float(part.value[0]), float(part.radius[0])
                if not np.isfinite(value + radius):
                    continue
                looked += 1
                wanted = mpmath.diff(exact, mpmath.mpf(0.9), order)
                off = float(abs(wanted - value))
                assert off <= 1.01 * radius + 1e-18, (text, order)
    assert looked > 200
