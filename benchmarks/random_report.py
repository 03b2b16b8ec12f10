"""Section of the document on random mechanisms."""

from __future__ import annotations

from benchmarks.random_run import BOUNDS, POSITIONS, Tally
from planmethod.bench.report import Table, number, table


def random_section(tally: Tally, branches: tuple[int, int]) -> Table:
    """Return the outcomes of random mechanisms and of crank-rockers."""
    total = tally.results
    shares = []
    names = [f"up to {bound:g}" for bound in BOUNDS] + [f"above {BOUNDS[-1]:g}"]
    for name, count in zip(names, tally.within, strict=True):
        shares.append((name, f"{count:,}".replace(",", " "), f"{100 * count / total:.4f} %"))
    looked, wrong = branches
    lines = [
        "## Random mechanisms",
        "",
        f"{tally.mechanisms} mechanisms of one to three dyads of all kinds, {POSITIONS} positions "
        f"each ({tally.positions} in all, {tally.impossible} of them impossible with a step "
        "named). Every result is judged by a referee of 40 digits; its reach is taken to first "
        "order.",
        "",
        f"- exceptions: {len(tally.exceptions)}; results that are NaN without a reason: "
        f"{tally.unexplained}; positions where float64 and the referee do not find the same "
        f"results to exist: {tally.disagreed};",
        f"- random crank-rockers on a wrong branch: {wrong} of {looked} positions.",
        "",
        *table(("error in units of κ·u", "results", "share"), shares),
        "",
        "The largest multiples. Each is a result that does not depend on a badly conditioned step "
        "through which the plan nevertheless finds it: a group that follows a nearly dead one and "
        "turns as if that were not there.",
        "",
        *table(
            ("seed", "position", "result", "κ of the result", "error in units of κ·u"),
            [
                (str(seed), f"{at:g}", label, number(kappa), f"{multiple:.3g}")
                for multiple, seed, at, label, kappa in tally.worst
            ],
        ),
    ]
    if tally.exceptions:
        lines += ["", *(f"- {error}" for error in tally.exceptions)]
    return lines
