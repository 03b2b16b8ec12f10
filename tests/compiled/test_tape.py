"""Programs as tapes of real operations: constant folding, known values, generated source."""

from __future__ import annotations

import io
import keyword
import math
import random
import re
import tokenize
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from cases import each, sampled, some
from doors import (
    ARRAYS,
    Blocks,
    Builder,
    Guard,
    ImpossibleError,
    Name,
    NumberName,
    PiecewiseTape,
    PointName,
    Program,
    Ref,
    Side,
    Sweep,
    Symbol,
    Symbolic,
    Tape,
    TapeProgram,
    compiled_blocks as blocks_module,
    evaluate_limit_of as limit_of,
    problem_load as load,
    problem_loads as loads,
    pysource as straight_module,
    same,
    straight,
    symbolic_write as write,
    used_by,
)
from tapes import INPUTS, drawn
from worked import every_file

from benchmarks.generator import random_problem


@pytest.fixture
def tape() -> Tape:
    made = Tape()
    for number in range(3):
        made.input(number)
    return made


X, Y, Z = 0, 1, 2

# Folding ------------------------------------------------------------------------------------------


def test_constants_are_folded(tape: Tape) -> None:
    before = len(tape.nodes)
    assert tape.add(1.5, 2.0) == 3.5
    assert tape.sub(1.5, 2.0) == -0.5
    assert tape.mul(1.5, 2.0) == 3.0
    assert tape.div(1.5, 3.0) == 0.5
    assert tape.neg(1.5) == -1.5
    assert tape.abs(-1.5) == 1.5
    assert tape.add_node("sqrt", 2.25) == 1.5
    assert tape.add_node("max", 1.0, 2.0) == 2.0
    assert tape.add_node("min", 1.0, 2.0) == 1.0
    assert tape.add_node("at_zero", 0.0, 4.0, 5.0) == 4.0
    assert tape.add_node("at_zero", 1.0, 4.0, 5.0) == 5.0
    assert tape.add_node("degrees", tape.add_node("atan2", -0.0, -1.0)) == 180.0
    assert tape.add_node("degrees", tape.add_node("atan2", 1.0, 0.0)) == 90.0
    assert math.isnan(float(tape.div(0.0, float("nan")))) or tape.div(0.0, 1.0) == 0.0
    assert len(tape.nodes) == before


def test_division_by_zero_is_folded_without_an_error(tape: Tape) -> None:
    assert tape.add_node("div", 1.0, 0.0) == math.inf
    assert tape.add_node("div", -1.0, 0.0) == -math.inf
    assert math.isnan(float(tape.add_node("div", 0.0, 0.0)))


def test_operations_without_effect_are_not_made(tape: Tape) -> None:
    before = len(tape.nodes)
    assert tape.add(X, 0.0) == tape.add(0.0, X) == X
    assert tape.sub(X, 0.0) == X
    assert tape.mul(X, 1.0) == tape.mul(1.0, X) == X
    assert tape.mul(X, 0.0) == 0.0
    assert tape.div(X, 1.0) == X
    assert tape.div(0.0, X) == 0.0
    assert tape.sub(X, X) == 0.0
    assert len(tape.nodes) == before


def test_a_sum_less_a_term_is_the_other_term(tape: Tape) -> None:
    for total in (tape.add(X, Y), tape.add(Y, X)):
        assert tape.sub(total, X) == Y
        assert tape.sub(total, Y) == X
        assert tape.sub(X, total) == tape.neg(Y)
    assert tape.sub(tape.sub(X, Y), X) == tape.neg(Y)
    assert tape.sub(tape.add(X, 2.5), 2.5) == X
    assert tape.sub(tape.add(X, 2.5), X) == 2.5


def test_every_operation_is_made_once(tape: Tape) -> None:
    assert tape.add(X, Y) == tape.add(Y, X)
    assert tape.mul(X, Y) == tape.mul(Y, X)
    assert tape.mul(X, 3.5) == tape.mul(3.5, X)
    difference = tape.sub(X, Y)
    assert tape.sub(Y, X) == tape.neg(difference)


def test_signs_go_outside(tape: Tape) -> None:
    product = tape.mul(X, Y)
    minus_x, minus_y = tape.neg(X), tape.neg(Y)
    assert tape.neg(minus_x) == X
    assert tape.mul(minus_x, minus_y) == product
    assert tape.mul(minus_x, Y) == tape.mul(X, minus_y) == tape.neg(product)
    assert tape.mul(-1.0, X) == minus_x
    assert tape.mul(-2.0, X) == tape.neg(tape.mul(2.0, X))
    assert tape.div(minus_x, Y) == tape.div(X, minus_y) == tape.neg(tape.div(X, Y))
    assert tape.add(X, minus_y) == tape.sub(X, Y)
    assert tape.sub(X, minus_y) == tape.add(X, Y)
    assert tape.abs(minus_x) == tape.abs(X)
    root = tape.add_node("sqrt", X)
    assert tape.abs(root) == root
    assert tape.unsigned(minus_x) == X
    assert tape.unsigned(-2.0) == 2.0


def test_factors_are_gathered(tape: Tape) -> None:
    assert tape.mul(2.0, tape.mul(3.0, X)) == tape.mul(6.0, X)
    assert tape.div(tape.mul(3.0, X), 3.0) == X
    assert tape.div(tape.div(X, 3.0), 5.0) == tape.div(X, 15.0)
    assert tape.div(X, 4.0) == tape.mul(0.25, X)  # exact


def test_a_node_is_not_the_constant_of_its_number(tape: Tape) -> None:
    """Node 2 and 2.0 are equal in Python, and so are the pairs that hold them."""
    assert tape.mul(Z, X) != tape.mul(2.0, X)
    assert tape.add(1.0, X) != tape.add(Y, X)
    assert same(tape.sub(tape.add(2.0, X), Z), 0.0) is False
    assert tape.nodes[int(tape.sub(tape.sub(2.0, X), Z))].kind == "sub"
    assert tape.sub(tape.sub(2.0, X), 2.0) == tape.neg(X)
    known = Symbolic(tape)
    known.note(Symbol(tape, X, Z), Symbol(tape, 5.0))
    assert known.known(Symbol(tape, X, 2.0)).size is None
    assert known.known(Symbol(tape, X, Z)).size == 5.0


# Against plain arithmetic -------------------------------------------------------------------------


def both(
    tape: Tape, results: list[Ref], guards: list[Guard], columns: list[Any]
) -> tuple[Any, Any]:
    """Run a tape as a line of Python and in blocks."""
    count = len(columns[0])
    buffer = bytearray(8 * len(results) * count)
    straight(tape, results, guards)([list(column) for column in columns], buffer)
    line = np.frombuffer(buffer).reshape(count, len(results)).T
    out = np.empty((len(results), count))
    depends = [frozenset(range(len(guards)))] * len(results)
    Blocks(tape, results, guards, depends, block=7).run([np.array(c) for c in columns], out)
    return line, out


@each("seed", sampled(range(some(60, few=20)), 3))
def test_a_tape_equals_its_program(seed: int) -> None:
    rng, tape = random.Random(seed), Tape()
    made = drawn(rng, tape, 40)
    results = [ref for ref, _ in made] + [made[5][0], made[-1][0]]  # some twice
    columns = [[rng.uniform(-2.0, 2.0) for _ in range(17)] for _ in range(INPUTS)]
    line, out = both(tape, results, [], columns)
    for row, (_, value) in enumerate([*made, made[5], made[-1]]):
        wanted = np.array([value(*at) for at in zip(*columns, strict=True)])
        assert line[row] == pytest.approx(wanted, rel=1e-9, abs=1e-9)
        assert out[row] == pytest.approx(wanted, rel=1e-9, abs=1e-9)
    assert line == pytest.approx(out, rel=1e-13, abs=1e-13)


def test_angles_are_exact_at_quadrants() -> None:
    tape = Tape()
    angle = tape.input(0)
    cosine, sine = tape.add_node("cosd", angle), tape.add_node("sind", angle)
    columns = [[0.0, 90.0, 180.0, 270.0, 360.0, -90.0, -180.0, 450.0, 3.6e8 + 90.0]]
    for found in both(tape, [cosine, sine], [], columns):
        assert found[0].tolist() == [1, 0, -1, 0, 1, 0, -1, 0, 0]
        assert found[1].tolist() == [0, 1, 0, -1, 0, -1, 0, 1, 1]


def test_only_a_sine_or_only_a_cosine() -> None:
    tape = Tape()
    angle = tape.input(0)
    for kind, function in (("sind", math.sin), ("cosd", math.cos)):
        for found in both(tape, [tape.add_node(kind, angle)], [], [[20.0, 200.0]]):
            wanted = [function(math.radians(a)) for a in (20.0, 200.0)]
            assert found[0] == pytest.approx(wanted, rel=1e-15)


def test_directions_at_the_half_turn() -> None:
    tape = Tape()
    x, y = tape.input(0), tape.input(1)
    result = tape.add_node("degrees", tape.add_node("atan2", y, x))
    columns = [[-1.0, -1.0, -1.0, 1.0, 0.0, -1.0], [0.0, -0.0, -1e-300, -0.0, -2.0, 1.0]]
    for found in both(tape, [result], [], columns):
        assert found[0].tolist() == [180.0, 180.0, 180.0, 0.0, -90.0, 135.0]


def test_an_undefined_direction_does_not_hide_a_defined_one() -> None:
    tape = Tape()
    x, y = tape.input(0), tape.input(1)
    result = tape.add_node("degrees", tape.add_node("atan2", y, x))
    out = np.empty((1, 2))
    Blocks(tape, [result], [], [frozenset()]).run(
        [np.array([np.nan, -1.0]), np.array([0.0, -0.0])], out
    )
    assert np.isnan(out[0, 0])
    assert out[0, 1] == 180.0


@each("seed", sampled(range(200), 10))
def test_piecewise_tapes_equal_piecewise_arrays(seed: int) -> None:
    draw = random.Random(seed)
    at = sorted(draw.uniform(-2.0, 2.0) for _ in range(draw.randint(2, 6)))
    at = sorted([*at, at[draw.randrange(len(at))]])  # with a jump
    values = [draw.uniform(-5.0, 5.0) for _ in at]
    x = np.array([draw.uniform(-3.0, 3.0) for _ in range(20)] + at)
    y = np.array([draw.uniform(-3.0, 3.0) for _ in x])

    def told(ar: Any, x: Any, y: Any) -> list[Any]:
        holds = ar.either(ar.both(ar.above(x, 0.5), ar.above(y, 0.0)), ar.reaches(-1.0, x))
        return [
            ar.interpolated(at, values, x),
            ar.stepped(at, values, x),
            ar.passed(at, x),
            ar.modulo(x, 0.7),
            ar.clipped(x, -1.0, 1.0),
            ar.larger(x, y),
            ar.select(holds, x, y),
            ar.angle(x + 1j * y),
            ar.listed(at, values, x, 1e-9, ValueError) if ar is not ARRAYS else x,
        ]

    symbols = PiecewiseTape(Tape())
    made = told(symbols, symbols.input(0), symbols.input(1))
    right, known = told(ARRAYS, x, y), np.isin(x, at)
    for found in both(symbols.tape, [one.re for one in made], [], [x, y]):
        assert found[:-1] == pytest.approx(np.array(right[:-1], dtype=float), abs=1e-12)
        assert np.isnan(found[-1][~known]).all() and not np.isnan(found[-1][known]).any()


def test_no_value_of_a_table_is_no_number() -> None:
    symbols = PiecewiseTape(Tape())
    made = symbols.interpolated([0.0, 1.0], [2.0, 3.0], symbols.input(0))
    for found in both(symbols.tape, [made.re], [], [np.array([math.nan, 0.5])]):
        assert found[0] == pytest.approx([math.nan, 2.5], nan_ok=True)


def test_the_other_value_where_a_size_is_zero() -> None:
    tape = Tape()
    size, one = tape.input(0), tape.input(1)
    result = tape.add_node("at_zero", size, one, tape.div(1.0, size))
    out = np.empty((1, 3))
    Blocks(tape, [result], [], [frozenset()]).run([np.array([0.0, 2.0, 4.0]), np.full(3, 7.0)], out)
    assert out[0].tolist() == [7.0, 0.5, 0.25]


# Guards -------------------------------------------------------------------------------------------


def test_a_failing_guard_empties_the_dependent_values() -> None:
    tape = Tape()
    x = tape.input(0)
    root = tape.add_node("sqrt", x)
    guards = [Guard(NumberName("first"), x, 0.0), Guard(NumberName("second"), root, 1.0)]
    results: list[Ref] = [root, tape.mul(2.0, x), 5.0, x]
    depends = [frozenset({0, 1}), frozenset({0}), frozenset[int](), frozenset({1})]
    out, failed = np.empty((4, 3)), np.empty(3, np.int16)
    Blocks(tape, results, guards, depends).run([np.array([-1.0, 0.25, 4.0])], out, failed)
    assert failed.tolist() == [0, 1, -1]
    assert np.isnan(out).tolist() == [
        [True, True, False],
        [True, False, False],
        [False, False, False],
        [True, True, False],
    ]
    assert out[:, 2].tolist() == [2.0, 8.0, 5.0, 4.0]
    run = straight(tape, results, guards)
    buffer = bytearray(32)
    run([[4.0]], buffer)
    assert np.frombuffer(buffer).tolist() == [2.0, 8.0, 5.0, 4.0]
    for bad in (-1.0, 0.25, math.nan):
        with pytest.raises((ImpossibleError, ValueError)):
            run([[bad]], bytearray(32))


def crank_and_arcs(*, reach: float) -> tuple[Program, dict[str, complex | float]]:
    """Return a point on two arcs about points 2 apart; only the second radius may be short."""
    b = Builder()
    a, d = b.take_point("A"), b.take_point("D")
    r, q = b.known("r"), b.known("q")
    b.intersect_circles("C", a, r, d, q, Side.LEFT)
    return b.program(), {"A": 0j, "D": 2.0 + 0j, "r": 1.5, "q": reach}


def written(reach: float, inputs: tuple[str, ...] = ()) -> TapeProgram:
    program, data = crank_and_arcs(reach=reach)
    return write(program, {k: v for k, v in data.items() if k not in inputs}, inputs)


def test_guards_that_always_hold_are_dropped() -> None:
    found = written(1.5)
    assert found.guards == ()
    assert found.depends[PointName("C")] == frozenset()
    assert found.tape.nodes == []  # no operation remains
    assert found.value[PointName("C")].re == pytest.approx(1.0)


def test_guards_that_never_hold_are_kept() -> None:
    found = written(0.1)
    assert [guard.step for guard in found.guards] == ["C"]
    assert type(found.guards[0].margin) is float
    assert found.depends[PointName("C")] == frozenset({0})


def test_guards_of_varying_values_are_kept() -> None:
    found = written(1.5, inputs=("q",))
    assert [guard.step for guard in found.guards] == ["C"]
    assert type(found.guards[0].margin) is int
    x, y = found.value[PointName("C")].re, found.value[PointName("C")].im
    out, failed = np.empty((2, 3)), np.empty(3, np.int16)
    blocks = Blocks(found.tape, [x, y], found.guards, [found.depends[PointName("C")]] * 2)
    blocks.run([np.array([1.5, 0.1, 0.5])], out, failed)
    assert failed.tolist() == [-1, 0, -1]
    assert out[:, 0] == pytest.approx([1.0, math.sqrt(1.25)])
    assert np.isnan(out[:, 1]).all()
    assert out[:, 2] == pytest.approx([2.0 - 0.5, 0.0], abs=1e-7)  # the arcs just touch


def test_scaled_guards_are_looked_at_without_the_scale() -> None:
    """The limit is divided, not every margin."""
    for path in every_file():
        sweep = Sweep(load(path))
        steps = {step.out: step for step in sweep.program.steps}
        for guard in sweep.runner.written.guards:
            assert guard.step in steps
            assert math.isfinite(limit_of(steps[guard.step]))
            if type(guard.margin) is int:
                kind, refs = sweep.runner.written.tape.nodes[guard.margin]
                constant = refs[-1] if kind == "div" else refs[0] if kind == "mul" else None
                assert not (type(constant) is float and constant > 0)


# Known values -------------------------------------------------------------------------------------


def test_a_length_that_was_laid_off_is_not_measured() -> None:
    """The line from the centre of an arc to a point on it is as long as the radius: no root."""
    b = Builder()
    a, d, r, q = b.take_point("A"), b.take_point("D"), b.known("r"), b.known("q")
    c = b.intersect_circles("C", a, r, d, q, Side.LEFT)
    lines = [b.join(a, c), b.join(c, a), b.join(d, c), b.join(a, d)]
    found = write(b.program(), {"A": 0j, "D": 2.0 + 1.0j, "r": 1.5}, ("q",))
    one, other, second, base = (found.value[line][1] for line in lines)
    assert one.size == other.size == 1.5
    assert abs(one).re == 1.5
    assert found.tape.nodes[second.size].kind in ("input", "abs")
    assert base.size is None
    assert abs(base).re == math.hypot(2.0, 1.0)


def test_a_turned_vector_keeps_its_length() -> None:
    known = Symbolic()
    x, y = known.tape.input(0), known.tape.input(1)
    vector = Symbol(known.tape, x, y)
    known.note(vector, Symbol(known.tape, 3.0))
    for turned in (vector * 1j, -vector, vector * -1j, vector.conjugate()):
        assert known.known(turned).size == 3.0
        assert abs(turned).re == 3.0
    other = known.known(Symbol(known.tape, x, known.tape.mul(2.0, y)))
    assert other.size is None


def test_a_straight_line_has_only_used_operations() -> None:
    tape = Tape()
    x, y = tape.input(0), tape.input(1)
    used = tape.add(x, y)
    tape.mul(x, y)
    assert used_by(tape, [used, 3.0]) == [x, y, used]
    assert used_by(tape, [3.0]) == []


# Generated source ---------------------------------------------------------------------------------

ODD = """
title = "import os"
[frame]
A = [0.0, 0.0]
D = [0.4, 0.0]
[links."exec"]
points = ["A", "B"]
AB = 0.1
[links."lambda x"]
points = ["B", "C", "E'", "ξ1"]
BC = 0.35
"E'" = { on = "BC", at = 0.1 }
"ξ1" = { on = "BC", at = 0.2 }
[links."коромысло-3''"]
points = ["D", "C"]
DC = 0.25
[driver]
link = "exec"
phi = 60
omega = 10
[assembly]
C = "above D"
"""

WORDS = {
    *("run", "inputs", "buffer", "buffers", "at", "out", "pack", "zip", "turn", "fail", "least"),
    *("copyto", "where", "ImpossibleError", "sqrt", "sin", "cos", "remainder", "atan2", "int"),
    *("add", "sub", "mul", "div", "neg", "abs", "min", "max", "multiply", "inf", "nan"),
}


def sources_of(monkeypatch: pytest.MonkeyPatch, make: Callable[[], None]) -> list[str]:
    """Return the sources that are compiled while something is made."""
    sources: list[str] = []

    def spied(source: str, name: str, mode: str) -> Any:
        sources.append(source)
        return compile(source, name, mode)

    for module in (straight_module, blocks_module):
        monkeypatch.setattr(module, "compile", spied, raising=False)
    make()
    return sources


@pytest.mark.parametrize("text", [ODD, *(random_problem(seed)[0] for seed in range(5))])
def test_no_name_of_a_problem_gets_into_the_source(
    monkeypatch: pytest.MonkeyPatch, text: str
) -> None:
    problem = loads(text, name="__import__('os')")

    def make() -> None:
        varied = [] if text is not ODD else ["l_BC"]
        sweep = Sweep(problem, varied=varied)
        parameters = {name: sweep.parameters[name] for name in varied}
        for count in (2, 100):
            assert sweep.run(np.full(count, problem.drive.positions[0]), parameters).size

    sources = sources_of(monkeypatch, make)
    assert len(sources) == 2
    for source in sources:
        assert source.isascii()
        assert '"' not in source and "'" not in source
        for token in tokenize.generate_tokens(io.StringIO(source).readline):
            if token.type == tokenize.NAME:
                known = token.string in WORDS or keyword.iskeyword(token.string)
                assert known or re.fullmatch(r"[xtrqcsobk]\d+", token.string), token.string


@pytest.mark.parametrize("value", [1e-300, 1e300, -0.1, 1 / 3, 5e-324])
def test_constants_are_written_to_the_last_bit(value: float) -> None:
    tape = Tape()
    result = tape.add_node("mul", value, tape.input(0))
    for found in both(tape, [result], [], [[1.0, 3.0]]):
        assert found[0].tolist() == [value, 3.0 * value]


def steps_of(program: Program) -> set[Name]:
    return {step.out for step in program.steps}


def test_a_program_is_cut_down_to_the_requested_results() -> None:
    problem = load(next(path for path in every_file() if path.stem == "ex3"))
    whole, few = Sweep(problem), Sweep(problem, ["omega_3"])
    assert steps_of(few.program) < steps_of(whole.program)
    assert few.operations < whole.operations
