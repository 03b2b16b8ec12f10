"""Long chains of dyads: planning, assembly and compiling cost the same for every further link."""

from __future__ import annotations

import sys
from collections.abc import Callable

import numpy as np
import pytest
from doors import (
    LINK_LIMIT,
    PointName,
    Solution,
    Sweep,
    analyse,
    build_build as build,
    choose_modes,
    triad_of,
)

from benchmarks.scenes import chain


def lines_of(act: Callable[[], object]) -> int:
    """Count the lines of the package's own code that something runs, comprehensions' rounds too."""
    count = 0

    def local(frame: object, event: str, _: object) -> object:
        nonlocal count
        count += event == "line"
        return local

    def watch(frame: object, event: str, _: object) -> object:
        return local if "planmethod" in frame.f_code.co_filename else None  # type: ignore[attr-defined]

    before = sys.gettrace()
    sys.settrace(watch)  # type: ignore[arg-type]
    try:
        act()
    finally:
        sys.settrace(before)
    return count


def prepared(dyads: int) -> dict[str, int]:
    """Count the work of the parts of preparing a chain."""
    problem = chain(dyads)
    structure = analyse(problem.mechanism)
    choice = choose_modes(problem, structure)
    return {
        "structure": lines_of(lambda: analyse(problem.mechanism)),
        "closings": lines_of(lambda: choose_modes(problem, structure)),
        "plans": lines_of(lambda: build(problem, structure, choice)),
        "sweep": lines_of(lambda: Sweep(problem, native=False)),
    }


def test_preparing_grows_with_the_links_and_no_faster() -> None:
    """Twice the links cost twice the lines of code, beyond what the first ones cost."""
    one, two, four = (prepared(dyads) for dyads in (6, 12, 24))
    for part in one:
        first, second = two[part] - one[part], four[part] - two[part]
        assert second <= 2.02 * first, (part, one[part], two[part], four[part])


def test_a_chain_may_have_as_many_links_as_the_reader_takes() -> None:
    dyads = (LINK_LIMIT - 1) // 2
    sweep = Sweep(chain(dyads), [f"C{dyads}", f"a_C{dyads}"], native=False)
    found = sweep.run(np.linspace(0.0, 350.0, 50))
    assert np.isfinite(found).all()
    assert np.ptp(found[0]) > 1e-3


@pytest.mark.parametrize("dyads", [1, 5])
def test_assemblies_are_those_of_the_whole_plan(dyads: int) -> None:
    """Each settled group is computed once; computing the whole plan again agrees to the bit."""
    problem = chain(dyads)
    solution = Solution(problem, positions=[10.0, 200.0])
    assert not any(triad_of(group) for group in solution.structure.groups)
    for k in range(1, dyads + 1):
        assert (solution.si.point(PointName(f"C{k}")).imag > 0).all()  # above D_k, by its rule
