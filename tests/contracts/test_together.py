"""Threads and processes that use the package at once, and objects passed between them."""

from __future__ import annotations

import copy
import multiprocessing
import pickle
import pkgutil
import sys
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from importlib import import_module
from typing import Any

import numpy as np
import pytest
from cases import each
from doors import (
    Cause,
    Contradiction,
    Failure,
    Fault,
    ModelProblem as Problem,
    Place,
    PlanKind,
    PlanMethodError,
    PointName,
    PositionError,
    ProblemError,
    SelfCheckError,
    current_language,
    render,
    speaking,
    translate,
)
from worked import path_of

import planmethod

NAMES = ("linkages/ex1", "linkages/ex2", "linkages/ex3", "levers/six-link", "levers/task12")
WAYS = [way for way in multiprocessing.get_all_start_methods() if way != "forkserver"]


def problems() -> list[Problem]:
    return [planmethod.load(path_of(name)) for name in NAMES]


def numbers(problem: Problem) -> dict[str, Any]:
    """Return results of parts of the package that keep their last results."""
    solution = planmethod.solve(problem)
    found: dict[str, Any] = {name: one.velocity for name, one in solution.points.items()}
    found |= {name: link.epsilon for name, link in solution.links.items()}
    found["read"] = [solution.read_off(label) for label in solution.legend]
    found["sigma"] = [s.sigma for s in planmethod.drafting(solution).spreads.values()]
    found["moment"] = planmethod.statics(solution).balance
    return found


def told(value: object) -> bytes:
    return pickle.dumps(value)


# Threads -----------------------------------------------------------------------------------------


def test_eight_threads_give_the_results_of_one() -> None:
    once = {problem.name: told(numbers(problem)) for problem in problems()}
    before = sys.getswitchinterval()
    sys.setswitchinterval(1e-5)
    try:
        with ThreadPoolExecutor(8) as pool:
            many = [problem for _ in range(8) for problem in problems()]
            found = list(pool.map(numbers, many))
    finally:
        sys.setswitchinterval(before)
    for problem, one in zip(many, found, strict=True):
        assert told(one) == once[problem.name], problem.name


def test_a_sweep_and_a_solution_may_be_shared_by_threads() -> None:
    problem = planmethod.load(path_of("linkages/ex3"))
    sweep, solution = planmethod.Sweep(problem), planmethod.solve(problem, positions=range(360))
    ways = [np.linspace(k, 360.0 + k, 5001) for k in range(8)]
    once = [sweep.run(way) for way in ways]
    with ThreadPoolExecutor(8) as pool:
        assert all(map(np.array_equal, pool.map(sweep.run, ways), once))
        read = [*pool.map(solution.read_off, ["v_E"] * 8)]
    assert all(np.array_equal(one, solution.read_off("v_E")) for one in read)


def test_two_threads_speak_two_languages() -> None:
    met = threading.Barrier(2)
    sentence = "Stopped; all written files are complete."

    def ask(lang: str) -> list[str]:
        with speaking(lang):
            met.wait()
            said = [translate(sentence) for _ in range(50)]
            with pytest.raises(PlanMethodError) as refused:
                planmethod.loads("[frame]", name="x")
            met.wait()
            assert current_language() == lang
        return [*said, str(refused.value).splitlines()[0]]

    with ThreadPoolExecutor(2) as pool:
        russian, english = pool.map(ask, ("ru", "en"))
    assert {*english[:-1]} == {sentence}
    assert len({*russian[:-1]}) == 1
    assert not {*russian} & {*english}
    assert current_language() == "en"


# Errors ------------------------------------------------------------------------------------------


def kinds(of: type[PlanMethodError]) -> Iterator[type[PlanMethodError]]:
    for kind in of.__subclasses__():
        yield kind
        yield from kinds(kind)


def made(kind: type[PlanMethodError]) -> PlanMethodError:
    """Return an error as the package raises it."""
    place = Place.of(planmethod.load(path_of("linkages/ex3")), np.array([30.0]), 0)
    if issubclass(kind, ProblemError):
        return kind("a.toml", [Fault("links.2", "the link is too short", "Lengthen it", ("a",))])
    if issubclass(kind, PositionError):
        return kind(Failure(Cause.NO_NUMBER, place))
    if issubclass(kind, SelfCheckError):
        return kind(Contradiction("a", place, "velocity", "B", "A", "2", 1.0, 2.0))
    return kind("Unknown lettering {!r}. Choose one of: {}.", "C", "A, B")


def test_every_error_is_the_same_in_another_process() -> None:
    for module in pkgutil.walk_packages(planmethod.__path__, "planmethod."):
        if not module.name.endswith("__main__"):
            import_module(module.name)
    with speaking("ru"):
        errors = [PlanMethodError("no {}", 1), *map(made, kinds(PlanMethodError))]
    assert len(errors) > 15
    for error in errors:
        error.add_note("and where")
        for other in (pickle.loads(pickle.dumps(error)), copy.copy(error), copy.deepcopy(error)):
            assert type(other) is type(error)
            assert (str(other), other.args, vars(other)) == (str(error), error.args, vars(error))
            assert other.exit_code == error.exit_code


def faulty(number: int) -> None:
    if number % 2:
        planmethod.loads("[frame]\n", name=f"{number}.toml")
    text = path_of("linkages/ex3").read_text("utf-8").replace("DE = 0.18", "DE = 0.018")
    planmethod.solve(planmethod.loads(text, name=str(number)))


@pytest.mark.parametrize("way", WAYS)
def test_a_pool_of_processes_gets_errors_and_results(way: str) -> None:
    with multiprocessing.get_context(way).Pool(2) as pool:
        for number in range(4):
            kind = ProblemError if number % 2 else PositionError
            with pytest.raises(kind) as found:
                pool.apply_async(faulty, (number,)).get(300)
            assert str(number) in str(found.value) or number % 2 == 0
        solutions = pool.map_async(solved, NAMES).get(300)
    for name, solution in zip(NAMES, solutions, strict=True):
        assert told(numbers(solution.problem)) == told(numbers(planmethod.load(path_of(name))))


def solved(name: str) -> planmethod.Solution:
    solution = planmethod.solve(planmethod.load(path_of(name)))
    planmethod.drafting(solution).spreads.values()
    return solution


# Results -----------------------------------------------------------------------------------------


def results(name: str) -> Iterator[tuple[str, Any, Callable[[Any], Any]]]:
    """Yield the package's results, with everything requested, and a view of each to compare."""
    problem = planmethod.load(path_of(name))
    solution = planmethod.solve(problem, positions=[150.0, 160.0])
    drafting, statics = planmethod.drafting(solution), planmethod.statics(solution)
    spreads = {label: spread.sigma.tobytes() for label, spread in drafting.spreads.items()}
    yield "solution", solution, lambda s: [s.read_off(label).tobytes() for label in s.legend]
    yield (
        "drafting", drafting,
        lambda d: {label: spread.sigma.tobytes() for label, spread in d.spreads.items()} == spreads,
    )  # fmt: skip
    yield "statics", statics, lambda s: (s.balance.tobytes(), len(s.reactions))
    sweep = planmethod.Sweep(problem, ["v_" + next(iter(solution.points))])
    yield "sweep", sweep, lambda s: s.run([1.0, 2.0]).tobytes()
    yield "problem", problem, lambda p: p
    yield "document", planmethod.document(solution), lambda d: d
    yield "sheets", planmethod.draw(problem), lambda sheets: [render(d, "svg") for d in sheets]


@each("name", NAMES[2:4])
def test_every_result_goes_to_another_process(name: str) -> None:
    for what, result, seen in results(name):
        assert seen(pickle.loads(pickle.dumps(result))) == seen(result), what


def test_arrays_of_results_are_read_only() -> None:
    """Later results are computed from the arrays of earlier ones."""
    asked = np.array([150.0, 160.0])
    solution = planmethod.solve(planmethod.load(path_of("levers/six-link")), positions=asked)
    before = [numbers_of.velocity.copy() for numbers_of in solution.points.values()]
    asked[:] = 170.0
    assert solution.positions.tolist() == [150.0, 160.0]
    statics, drafting = planmethod.statics(solution), planmethod.drafting(solution)
    arrays = [solution.positions, solution.margin, solution.place(PointName("B")), statics.balance]
    arrays += [getattr(one, n) for kind in (solution.points, solution.links)
               for one in kind.values() for n in one.__struct_fields__]  # fmt: skip
    arrays += [array for s in solution.segments(PlanKind.VELOCITY) for array in (s.exact, s.read)]
    arrays += [solution.exact(q) for q in solution.construction.legend if q.size is not None]
    arrays += [solution.read_off(label) for label in solution.legend]
    arrays += [spread.sigma for spread in drafting.spreads.values()]
    arrays += [joint.force for joint in statics.reactions]
    for array in arrays:
        with pytest.raises(ValueError, match="read-only"):
            array[...] = 0.0
    after = [point.velocity for point in solution.points.values()]
    assert all(map(np.array_equal, before, after))
