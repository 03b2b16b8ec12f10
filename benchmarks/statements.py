"""Tasks of section 2.1 that print angles of their figure: written, solved, stated again.

Run ``python -m benchmarks.statements BANK``, where BANK is the folder with ``tasks_linkage.yaml``.
A problem file of each task is made of the bank's numbers and of the reading of its lost figure in
``statements.toml``. Its places are compared with Newton's method for the printed distances and
angles, its velocities with those of the distances, and the problem is built again from its "Given".
``--written FOLDER`` keeps the files.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Callable, Iterator, Mapping
from importlib import import_module
from itertools import chain, combinations, pairwise
from pathlib import Path
from typing import Any, TypeAlias

import click
import numpy as np
import numpy.typing as npt
from msgspec import Struct, convert, field

from benchmarks.rebuilt import rebuilt
from planmethod import loads
from planmethod.errors import AssemblyError, ProblemError
from planmethod.note.narrate.statement import drawn, given_facts
from planmethod.note.wording import get_language
from planmethod.problem.model import Problem
from planmethod.solved.solution import Solution

TABLE = Path(__file__).with_suffix(".toml")
SAME = 1e-9
"""Share of the size, or of the greatest velocity, up to which two answers are one."""

Reals: TypeAlias = npt.NDArray[np.float64]
Equation: TypeAlias = Callable[[Mapping[str, complex]], float]


class Reading(Struct, frozen=True):
    """How the figure of a task is read; see ``statements.toml``."""

    chain: str
    pivot: str = "drawn"
    guide: tuple[str, str] | None = None
    shown: dict[str, str] | None = None
    points: dict[str, list[str]] = field(default_factory=dict)
    angles: dict[str, dict[str, str]] = field(default_factory=dict)
    sides: dict[str, str] = field(default_factory=dict)
    sizes: dict[str, str] = field(default_factory=dict)
    text: str = ""
    rules: list[str] = field(default_factory=list)
    part: str = "whole"
    little: bool = False
    dead: bool = False

    @property
    def reason(self) -> str:
        """What becomes of the task."""
        if self.dead:
            return "its data contradict each other"
        return "prints too little" if self.little else f"solved, {self.part}"


class Task(Struct, frozen=True):
    """A task of the bank: its name, its numbers by name, m and degrees, and its reading."""

    name: str
    numbers: dict[str, float]
    positions: list[float]
    omega: float
    reading: Reading

    @property
    def shown(self) -> dict[str, float]:
        """What the figure shows."""
        own = self.reading.shown
        if own is None:
            own = {k: k for k in self.numbers if k.startswith("phi_") and k != "phi_1"}
        return {key: self.numbers[name] for key, name in own.items()}

    def length(self, one: str, two: str) -> float:
        """Return a printed length, m, in either order of its letters."""
        both = f"{one}{two}"
        if both in self.reading.sizes:
            return sum(self.numbers[n.strip(" {}")] for n in self.reading.sizes[both].split("+"))
        return self.numbers[both] if both in self.numbers else self.numbers[f"{two}{one}"]

    def filled(self, text: str) -> str:
        """Return a text with the bank's numbers in place of their names."""
        return re.sub(r"\{(\w+)\}", lambda name: str(self.numbers[name[1]]), text)

    # The problem file ------------------------------------------------------------------------

    def text(self) -> str:
        """Return the problem file."""
        reading, names = self.reading, self.reading.chain.split()
        head = self.filled(reading.text) if reading.text else "".join(self._chain(names))
        phi: object = self.positions if len(self.positions) > 1 else '"drawn"'
        phi = self.positions[0] if len(self.positions) == 1 else phi
        rules = (f"{rule.split()[0]} = {_rule(rule.partition(' ')[2])}\n" for rule in reading.rules)
        return (
            f'title = "{self.name}"\n{head}\n[driver]\nlink = "1"\nphi = {phi}\n'
            f"omega = {self.omega}\n[assembly]\n{''.join(rules)}"
        )

    def _chain(self, names: list[str]) -> Iterator[str]:
        reading = self.reading
        pivots = {names[0]: "[0, 0]"}
        if reading.guide is None:
            level = {"drawn": '"drawn"', "level": '["drawn", 0]'}
            pivot = level.get(reading.pivot, reading.pivot)
            pivots[names[-1]] = self.filled(pivot)
        yield "[frame]\n" + "".join(f"{name} = {place}\n" for name, place in pivots.items())
        if reading.guide is not None:
            through, angle = map(self.filled, reading.guide)
            yield f"guides.x-x = {{ through = {through}, angle = {angle} }}\n"
        yield from self._figure('"drawn"' in str((reading.guide, *pivots.values())))
        for k, (p, q) in enumerate(pairwise(names), 1):
            start, end = (q, p) if k == 3 else (p, q)
            yield from self._link(str(k), (start, end), names)
        if reading.guide is not None:
            yield f'[links.3]\npoints = ["{names[-1]}"]\nslides = {{ on = "x-x" }}\n'

    def _figure(self, sought: bool) -> Iterator[str]:
        if sought:
            yield "[drawn]\n" + "".join(f"{key} = {value}\n" for key, value in self.shown.items())

    def _link(self, link: str, ends: tuple[str, str], names: list[str]) -> Iterator[str]:
        reading = self.reading
        lines = [self.filled(line) for line in reading.points.get(link, [])]
        more = [line.split()[0] for line in lines]
        points = ", ".join(f'"{name}"' for name in (*ends, *more))
        yield f"[links.{link}]\npoints = [{points}]\n"
        yield f"{''.join(ends)} = {self.length(*ends)}\n"
        placed = [line for line in lines if "=" in line]
        yield "".join(f"{line}\n" for line in placed)
        for angle, name in reading.angles.get(link, {}).items():
            yield f"angle.{angle} = {self.numbers[name]}\n"
        for point in more:
            if not any(line.startswith(f"{point} =") for line in placed):
                for other in (*ends, *more):
                    if other != point and self._has(other, point):
                        yield f"{other}{point} = {self.length(other, point)}\n"
                if point in reading.sides:
                    yield f'{point}.side = "{reading.sides[point]}"\n'

    def _has(self, one: str, two: str) -> bool:
        return f"{one}{two}" in self.numbers or f"{two}{one}" in self.numbers

    # The same by Newton's method ---------------------------------------------------------------

    def equations(self, problem: Problem) -> list[Equation]:
        """Return what the print says of the figure: distances, angles, level pivots."""
        told: list[Equation] = []
        names = self.reading.chain.split()
        axes = {str(k): (p, q) for k, (p, q) in enumerate(pairwise(names), 1)}
        if "3" in axes:
            axes["3"] = axes["3"][::-1]
        told += [_distance(p, q, self.length(p, q)) for p, q in axes.values()]
        for body in problem.bodies.values():
            extra = [p for p in body.points if p not in names]
            for p, q in combinations(body.points, 2):
                if {p, q} & {*extra} and self._has(p, q):
                    told.append(_distance(p, q, self.length(p, q)))
        for angles in self.reading.angles.values():
            told += [_corner(letters, self.numbers[name]) for letters, name in angles.items()]
        for line in chain.from_iterable(self.reading.points.values()):
            if on := re.search(r'^(\w+) = .*on = "([A-Z]\d?)([A-Z]\d?)"', line):
                told.append(_straight(*on.groups()))
        for key, value in self.shown.items():
            told += self._shown_equations(key, value, axes)
        if len(self.positions) and "1" in axes:
            told.append(_course(*axes["1"], self.positions[0]))
        if self.reading.pivot == "level":
            told.append(lambda at: at[names[-1]].imag)
        return told

    def _shown_equations(
        self, key: str, value: float, axes: Mapping[str, tuple[str, str]]
    ) -> Iterator[Equation]:
        if not key.startswith("phi"):
            yield _distance(key[0], key[1], value)
            return
        one, *others = (axes.get(link) for link in key.split("_")[1:])
        if one is None:  # a guide's own direction has no points
            return
        if not others:
            yield _course(*one, value)
        elif others[0] is not None:
            yield _between(one, others[0], value)
        elif self.reading.guide is not None and '"' not in self.reading.guide[1]:
            yield _to_guide(one, float(self.filled(self.reading.guide[1])), value)


def _rule(text: str) -> str:
    word, _, place = text.partition(" ")
    return f"{{ near = [{place}] }}" if word == "near" else f'"{text}"'


def _distance(p: str, q: str, size: float) -> Equation:
    return lambda at: abs(at[q] - at[p]) / size - 1.0


def _course(p: str, q: str, degrees: float) -> Equation:
    return lambda at: float(np.angle((at[q] - at[p]) * np.exp(-1j * np.radians(degrees))))


def _corner(letters: str, degrees: float) -> Equation:
    p, vertex, q = re.findall(r"[A-Z]\d?", letters)
    turn = np.exp(-1j * np.radians(degrees))
    return lambda at: float(np.angle((at[q] - at[vertex]) / (at[p] - at[vertex]) * turn))


def _straight(p: str, a: str, b: str) -> Equation:
    return lambda at: float(((at[p] - at[a]) / (at[b] - at[a])).imag)


def _rigid(p: str, q: str, r: str, turn: complex, part: Callable[[complex], Any]) -> Equation:
    return lambda at: float(part((at[r] - at[p]) / (at[q] - at[p]) - turn))


def _along(p: str, vertex: str, q: str, degrees: float) -> Equation:
    turn = np.exp(-1j * np.radians(degrees))
    return lambda at: float(((at[q] - at[vertex]) / (at[p] - at[vertex]) * turn).imag)


def _to_guide(line: tuple[str, str], guide: float, degrees: float) -> Equation:
    """Return the equation of an unsigned angle to a guide."""
    course = complex(np.exp(1j * np.radians(guide)))
    return lambda at: _cosine(at[line[1]] - at[line[0]], course, degrees)


def _between(one: tuple[str, str], two: tuple[str, str], degrees: float) -> Equation:
    """Return the equation of an unsigned angle: that of the axes, or its supplement."""
    (p, q), (r, s) = one, two
    return lambda at: _cosine(at[q] - at[p], at[s] - at[r], degrees)


def _cosine(u: complex, v: complex, degrees: float) -> float:
    wanted = float(np.cos(np.radians(degrees)))
    found = float((u.conjugate() * v).real / abs(u) / abs(v))
    return min(found - wanted, found + wanted, key=abs)


def newton(
    told: list[Equation], start: Mapping[str, complex], fixed: set[str]
) -> dict[str, complex]:
    """Solve equations for the places that are not fixed, by least squares of differentials."""
    names = [name for name in start if name not in fixed]
    at = dict(start)
    for _ in range(60):
        value = np.array([equation(at) for equation in told])
        columns = []
        for name in names:
            for way in (1.0, 1j):
                step = 1e-6 * way
                ahead, behind = at | {name: at[name] + step}, at | {name: at[name] - step}
                columns.append([(f(ahead) - f(behind)) / 2e-6 for f in told])
        move = np.linalg.lstsq(np.array(columns).T, -value, rcond=1e-9)[0]
        at |= {name: at[name] + complex(*move[2 * k : 2 * k + 2]) for k, name in enumerate(names)}
        if np.max(np.abs(move)) < 1e-13:
            break
    return at


def difference(task: Task, problem: Problem) -> float:
    """Return how far the places and velocities are from those by Newton, as a share of the size."""
    solution = Solution(problem)
    own = {name for body in problem.bodies.values() for name in body.points}
    at = {p: complex(point.place[0]) for p, point in solution.points.items() if p in own}
    size = max(map(abs, at.values()))
    rng = np.random.default_rng(1)
    near = {p: z + 1e-4 * size * complex(*rng.normal(size=2)) for p, z in at.items()}
    first, ground = task.reading.chain.split()[:1], problem.bodies["0"].points
    fixed = {*first} | ({*ground} if problem.drawn is None else set())
    if not first:  # the crank is where the file has it
        fixed |= {*problem.bodies[problem.drive.link].points}
    told = task.equations(problem)
    if problem.drawn is None:  # nothing is sought: the links and guides as the file has them
        told += links_of(problem)
    found = newton(told, near | {name: at[name] for name in fixed}, fixed)
    off = max(abs(found[name] - z) for name, z in at.items()) / size
    return max(off, velocity_difference(problem, solution, at))


def links_of(problem: Problem) -> list[Equation]:
    """Return the constraints of a mechanism: distances in links, and guides."""
    told: list[Equation] = []
    for link, body in problem.bodies.items():
        if link != "0":
            p, *others = body.points
            told += [_distance(p, q, abs(body.points[q] - body.points[p])) for q in others[:1]]
            for r in others[1:]:
                q, start = others[0], body.points[p]
                turn = (body.points[r] - start) / (body.points[q] - start)
                told += [_rigid(p, q, r, turn, part) for part in (np.real, np.imag)]
    for slide in problem.slides.values():
        if slide.host == "0":
            turn = np.exp(-1j * np.radians(slide.angle))
            told.append(lambda at, s=slide, t=turn: ((at[s.pin] - s.base) * t).imag)  # type: ignore[misc]
        elif slide.through is not None:
            host = problem.bodies[slide.host].points
            other = next(p for p in host if p != slide.through)
            course = float(np.angle(host[other] - host[slide.through], deg=True))
            ends = other, slide.through, slide.pin
            told.append(_along(*ends, slide.angle - course))
    return told


def velocity_difference(problem: Problem, solution: Solution, at: dict[str, complex]) -> float:
    """Return how far velocities are from those that keep all distances and guides."""
    drive, fixed = problem.drive, {*problem.bodies["0"].points}
    pivot = drive.pivot
    assert pivot is not None
    crank = problem.bodies[drive.link].points
    first = next(p for p in crank if p != pivot)

    def ahead(step: float) -> dict[str, complex]:
        turned = at[pivot] + (at[first] - at[pivot]) * np.exp(1j * step * drive.rate)
        return newton(links_of(problem), at | {first: complex(turned)}, {*fixed, first})

    step = 1e-4 / abs(drive.rate)
    far, near = (
        {p: (one[p] - two[p]) / (2 * h) for p in at}
        for h in (step, step / 2)
        for one, two in [(ahead(h), ahead(-h))]
    )
    exact = {name: complex(solution.points[name].velocity[0]) for name in at}
    top = max(map(abs, exact.values())) or 1.0
    return max(abs((4 * near[p] - far[p]) / 3 - v) for p, v in exact.items()) / top


def is_stated(problem: Problem) -> bool:
    """Return whether the problem can be built again from its "Given", in both languages."""
    solution = Solution(problem)
    for language in map(get_language, ("ru", "en")):
        again = Solution(rebuilt([drawn(problem, language), *given_facts(problem, language)]))
        for name, point in solution.points.items():
            if not np.allclose(again.points[name].place, point.place, rtol=0.0, atol=SAME):
                return False
    return True


def outcome(task: Task) -> tuple[str, float]:
    """Return what becomes of a task, and how far it is from Newton's method."""
    reading = task.reading
    try:
        problem = loads(task.text(), name=task.name)
        off = difference(task, problem)
    except (ProblemError, AssemblyError) as error:
        missing = "does not determine" in str(error) or "More than one" in str(error)
        fits = reading.dead or (reading.little and missing)
        return (reading.reason if fits else f"not as expected: {error}"), 0.0
    if reading.little or reading.dead:
        return "not as expected: solved", off
    if not is_stated(problem):
        return "not as expected: another problem is stated", off
    return (reading.reason if off < SAME else f"not as expected: {off:.1e} from Newton"), off


def read_tasks(bank: Path) -> Iterator[tuple[str, Task | None, str, bool]]:
    """Yield the tasks with angles of the figure.

    A name, a task or why there is none, and whether angles of links are among them.
    """
    table = tomllib.loads(TABLE.read_text(encoding="utf-8"))
    readings = {name: convert(one, Reading) for name, one in table["tasks"].items()}
    yaml = import_module("yaml")  # one of the tools of the website
    listed = yaml.safe_load((bank / "tasks_linkage.yaml").read_text(encoding="utf-8"))
    for one in listed["tasks"]:
        angles = {key: value for key, value in one["angles"].items() if key != "phi_1"}
        if not angles:
            continue
        turned = any(key.startswith("phi") for key in angles)
        name = one["id"]
        number = name.rpartition(".")[2]
        if number not in readings:
            lost = number in table["lost"]
            yield name, None, "its figure is lost" if lost else "prints too little", turned
            continue
        sizes = {key.removeprefix("l_"): value for key, value in one["lengths"].items()}
        positions = [float(phi) for phi in one["phi1"]]
        reading = readings[number]
        yield name, Task(name, sizes | angles, positions, one["omega1"], reading), "", turned


@click.command()
@click.argument("bank", type=click.Path(exists=True, file_okay=False, path_type=Path))
@click.option("--written", type=click.Path(path_type=Path), help="Folder that keeps the files.")
def run(bank: Path, written: Path | None) -> None:
    """Print the tasks by what becomes of them: of all, and of those with angles of links."""
    found: dict[str, list[tuple[str, bool]]] = {}
    worst = 0.0
    for name, task, reason, turned in read_tasks(bank):
        said = reason
        if task is not None:
            said, off = outcome(task)
            worst = max(worst, off)
            if written is not None:
                written.mkdir(parents=True, exist_ok=True)
                (written / f"{name}.toml").write_text(task.text(), encoding="utf-8")
        found.setdefault(said, []).append((name.rpartition(".")[2], turned))
    every = [one for those in found.values() for one in those]
    click.echo("| 2.1 | α, β or angles of links | angles of links | tasks |")
    click.echo("| --- | ---: | ---: | --- |")
    for said, those in sorted(found.items(), key=lambda item: -len(item[1])):
        names = ", ".join(name for name, _ in those)
        click.echo(f"| {said} | {len(those)} | {sum(turned for _, turned in those)} | {names} |")
    click.echo(f"| all | {len(every)} | {sum(turned for _, turned in every)} | |")
    click.echo(f"\nPlaces and velocities are within {worst:.1e} of Newton's method.")


if __name__ == "__main__":
    run()
