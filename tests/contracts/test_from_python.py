"""Errors and warnings in Python: every failure is a PlanMethodError, doubts are warnings."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Iterator
from fractions import Fraction
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from doors import (
    ArgumentError,
    AssemblyError,
    DoubtWarning,
    PlanKind,
    PlanMethodError,
    UnknownNameError,
    UnknownQuantityError,
    Variants,
    check_works,
    read_works,
    settle,
    speaking,
)
from worked import path_of

import planmethod

EX3 = path_of("linkages/ex3")
VARIANTS = path_of("linkages/ex3-variants")

ODD: tuple[Any, ...] = (
    None, 20.0, -1, 0, math.nan, math.inf, "xx", "", b"x", [], [[1.0, 2.0]], ["a"], [None],
    [math.nan], {}, {"a": 1}, object(), True, 1j, [1j], np.zeros((2, 2)), np.array(5.0), range(3),
    Path("x"), int, [10**400], ["1"], 10**400, {1.0, 2.0}, np.array(["a"]), np.array([object()]),
    "v_Q", 10**9, lambda: 0,
)  # fmt: skip
"""Values passed as every argument: wrong for most of them, right for some."""


def keyed(
    call: Callable[..., object], name: str, *first: object, **more: object
) -> Callable[[Any], object]:
    return lambda odd: call(*first, **{name: odd}, **more)


def behind(call: Callable[..., object], *more: object) -> Callable[[Any], object]:
    return lambda odd: call(odd, *more)


def doors() -> Iterator[tuple[str, Callable[[Any], object]]]:
    """Yield every argument of the public names, and the call that takes it."""
    problem = planmethod.load(EX3)
    solution = planmethod.solve(problem)
    drafting, statics = planmethod.drafting(solution), planmethod.statics(solution)
    sweep, varied = planmethod.Sweep(problem), planmethod.Sweep(problem, ["v_E"], varied=["l_AB"])
    text, variants = EX3.read_text("utf-8"), Variants(VARIANTS)
    kind = PlanKind.VELOCITY
    yield "load(path)", planmethod.load
    yield "load(variant)", lambda b: planmethod.load(VARIANTS, variant=b)
    yield "loads(text)", lambda b: planmethod.loads(b, name="x")
    yield "loads(name)", lambda b: planmethod.loads(text, name=b)
    yield "loads(variant)", lambda b: planmethod.loads(text, name="x", variant=b)
    for name in ("positions", "ruler", "profile"):
        yield f"solve({name})", keyed(planmethod.solve, name, problem)
        yield f"draw({name})", keyed(planmethod.draw, name, problem, layout="-")
    for name in ("views", "scales", "construction"):
        yield f"Solution({name})", keyed(planmethod.Solution, name, problem)
    for name in ("solve", "Solution", "Sweep", "draw"):
        yield f"{name}(problem)", getattr(planmethod, name)
    for name in ("drafting", "statics", "document"):
        yield f"{name}(solution)", getattr(planmethod, name)
    for name in ("paper", "fields", "furniture", "layout", "most", "asked"):
        yield f"draw({name})", keyed(planmethod.draw, name, problem, positions=[])
    yield "document(lang)", lambda b: planmethod.document(solution, lang=b)
    yield "document(position)", lambda b: planmethod.document(solution, position=b)
    for name in (
        "with_positions", "filling", "drawn_at", "variant_at", "has_common", "place", "exact",
        "read_off", "segments", "quantities", "read_on", "read_at",
    ):  # fmt: skip
        yield name, getattr(solution, name)
    for name in ("points", "links", "legend"):
        yield name, getattr(solution, name).__getitem__
    yield "length", lambda b: solution.length(b, "A", "B")
    for name in ("plan_scale", "detail_views_at"):
        yield f"{name}(kind)", behind(getattr(solution, name), 0)
        yield f"{name}(index)", partial(getattr(solution, name), kind)
    yield "spreads", lambda b: drafting.spreads[b]
    yield "covariance", drafting.covariance
    yield "covariance(index)", lambda b: drafting.covariance(["v_E"], b)
    yield "causes", drafting.causes
    yield "causes(index)", lambda b: drafting.causes("v_E", b)
    yield "ellipse", lambda b: drafting.ellipse(b, 0)
    yield "sample", drafting.sample
    for name in ("lever_at", "largest"):
        yield name, getattr(statics, name)
    for name in ("asked", "varied", "dtype", "drawn"):
        yield f"Sweep({name})", keyed(planmethod.Sweep, name, problem)
    for name in ("run", "table", "bind"):
        yield name, getattr(sweep, name)
        yield f"{name}(parameters)", partial(getattr(sweep, name), [1.0])
    yield "run(l_AB)", lambda b: varied.run([1.0], {"l_AB": b})
    for name in ("out", "failed"):
        yield f"run({name})", keyed(sweep.run, name, [1.0])
    for name in ("explain", "failure", "reason"):
        yield name, getattr(sweep, name)
    yield "table[name]", lambda b: sweep.table([1.0])[b]
    yield "settle(problem)", settle
    yield "settle(path)", lambda b: settle(problem, b)
    yield "Variants(path)", Variants
    yield "read_works(path)", read_works
    yield "check_works(variants)", lambda b: list(check_works(b, []))
    yield "check_works(works)", lambda b: list(check_works(variants, b))


def test_every_argument_is_accepted_or_rejected_in_one_sentence() -> None:
    faults, refused = [], 0
    for door, call in doors():
        for odd in ODD:
            try:
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore")
                    call(odd)
            except PlanMethodError as error:
                refused += 1
                assert str(error)
            except Exception as error:  # what must not be
                faults.append(f"{door} of {odd!r:.30}: {type(error).__name__} {error}")
    assert not faults, "\n".join(faults[:40])
    assert refused > 1500


@pytest.mark.parametrize("lang", ["ru", "en"])
def test_an_error_names_the_argument_and_the_expected_type(lang: str) -> None:
    problem = planmethod.load(EX3)
    solution = planmethod.solve(problem)
    draw: Any = planmethod.draw
    with speaking(lang):
        for call, words in (
            (lambda: planmethod.solve(problem, profile="xx"), ("profile", "xx", "board")),
            (lambda: planmethod.solve(problem, positions=20.0), ("positions", "20.0", "[30]")),
            (lambda: planmethod.solve(problem, ruler=-1), ("ruler", "-1", "0")),
            (lambda: solution.read_off("v_Q"), ("v_Q", "v_E")),
            (lambda: solution.points["Q"], ("Q", "E")),
            (lambda: draw(solution), ("problem", "Solution", "planmethod.load()")),
        ):
            with pytest.raises(ArgumentError) as refused:
                call()
            assert all(word in str(refused.value) for word in words), refused.value


def test_a_name_that_there_is_not_is_a_key_error_too() -> None:
    solution = planmethod.solve(planmethod.load(EX3))
    assert solution.points.get("Q") is None
    assert planmethod.drafting(solution).spreads.get("v_Q") is None
    with pytest.raises(KeyError):
        solution.links["9"]
    with pytest.raises(UnknownNameError, match=r"^link '9' does not exist\. Known: 1, 2"):
        solution.links["9"]


def test_positions_are_any_values_that_numpy_accepts() -> None:
    problem = planmethod.load(EX3)
    once = planmethod.solve(problem, positions=[10.0, 20.0, 30.0]).read_off("v_E")
    ways: tuple[Any, ...] = (
        (10, 20, 30), range(10, 31, 10), np.array([10, 20, 30], np.int16),
        [Fraction(10), 20, np.float32(30)],
    )  # fmt: skip
    for positions in ways:
        found = planmethod.solve(problem, positions=positions).read_off("v_E")
        assert np.array_equal(found, once)


def test_a_requested_quantity_and_its_column_have_one_spelling() -> None:
    problem, at = planmethod.load(EX3), np.array([0.0, 30.0])
    solution = planmethod.solve(problem, positions=at)
    table = planmethod.Sweep(problem, ["omega_3", "v_E", "E"]).table(at)
    assert table["omega_3"] is table["3.omega"]
    assert np.allclose(table["v_E"], solution.points["E"].velocity, rtol=1e-12)
    assert np.allclose(table["E"], solution.points["E"].place, rtol=1e-12)
    by_column = planmethod.Sweep(problem, ["3.omega", "E.vx", "E.y"]).table(at)
    assert {name: values.tolist() for name, values in by_column.items()} == {
        name: values.tolist() for name, values in table.items()
    }
    with pytest.raises(UnknownNameError):
        table["3.omegas"]
    with pytest.raises(UnknownQuantityError):
        planmethod.Sweep(problem, ["3.omegas"])


# Doubts ------------------------------------------------------------------------------------------


TANGENT = """
title = "The rod is square to the guide at -90 degrees, and no longer"
[frame]
O = [0, 0]
guides.x = { through = [0, 0.2], angle = 0 }
[links.1]
points = ["O", "A"]
OA = 0.1
[links.2]
points = ["A", "B"]
AB = 0.3
[links.3]
points = ["B"]
slides = { on = "x" }
[driver]
link = "1"
phi = 30
omega = 10
[assembly]
B = "right of A"
"""


def test_doubts_are_warnings_and_meaningless_requests_are_errors() -> None:
    problem = planmethod.loads(TANGENT, name="near")
    with pytest.warns(DoubtWarning, match=r"near: .*dead position"):
        planmethod.solve(problem, positions=[30.0, -90.0 + 1e-2])
    with pytest.raises(AssemblyError):
        planmethod.solve(problem, positions=[30.0, -90.0 + 1e-3])
    planmethod.solve(problem, positions=np.linspace(0.0, 60.0, 4))  # warnings are errors here


def test_without_a_load_no_force_is_minus_zero() -> None:
    for name in ("linkages/ex3", "linkages/ex1"):
        statics = planmethod.statics(planmethod.solve(planmethod.load(path_of(name))))
        found = [statics.balance, *(joint.force for joint in statics.reactions)]
        assert statics.moment is not None
        for array in (*found, statics.moment):
            if not array.any():
                assert not np.signbit(np.real(array)).any()
                assert not np.signbit(np.imag(array)).any()
