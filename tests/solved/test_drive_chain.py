"""The machine as one chain, beside closed formulas of the planing machine and its motion.

The independent calculation knows the mechanism only by its geometry: angle of the slotted link,
place of the tool, energies. It uses no velocity plan, no lever, and no reduced moment.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from doors import Flywheel, check_module, cli, kinds_load as load, machine_chain
from numpy.typing import NDArray
from worked import path_of

PATH = path_of("machines/planer-drive")
TEXT = PATH.read_text("utf-8")
Reals = NDArray[np.float64]

OA, OC, CD, DE, LEVEL = 0.12, 0.35, 0.65, 0.25, 0.27
N_CRANK = 1420 * 18 * 20 / 72 / 90
OMEGA = N_CRANK * np.pi / 30
FORCE, G = 5000.0, 9.81


def solved(path: Path) -> dict[str, Any]:
    """Return the record of a file."""
    told = CliRunner().invoke(cli, ["solve", str(path), "--json"])
    assert told.exit_code == 0, told.output
    record = json.loads(told.output)
    return record if isinstance(record, dict) else record[0]


def pose(phi: Reals) -> tuple[Reals, ...]:
    """Return the slotted link's and the rod's angle, and the places of D, E and their centres."""
    a = OA * np.exp(1j * phi) + 1j * OC
    beta = np.angle(a)
    d = CD * np.exp(1j * beta) - 1j * OC
    across = LEVEL - d.imag
    e = d.real - np.sqrt(DE**2 - across**2)
    return beta, np.arcsin(across / DE), d, e, (d + e + 1j * LEVEL) / 2


def analogues(at: Reals) -> tuple[Reals, ...]:
    """Return twice the energy of all links over omega², slopes of tool and of weights."""
    # closed derivatives: of beta, then D, then E and the rod
    a = OA * np.exp(1j * at) + 1j * OC
    beta, reach = np.angle(a), np.abs(a)
    turning = (1j * OA * np.exp(1j * at) * np.exp(-1j * beta)).imag / reach
    d = CD * np.exp(1j * beta) - 1j * OC
    moved = 1j * turning * CD * np.exp(1j * beta)
    across = LEVEL - d.imag
    along = np.sqrt(DE**2 - across**2)
    tool = moved.real + across * (-moved.imag) / along
    rod = moved.imag / along  # E stays on its level while D moves up
    centre = (moved + tool) / 2
    link = CD / 2 * turning
    energy = (
        0.4 + 20 * link**2 + 0.7 * turning**2 + 4 * np.abs(centre) ** 2
        + 0.03 * rod**2 + 40 * tool**2
    )  # fmt: skip
    return energy, tool, G * (20 * moved.imag / 2 + 4 * centre.imag)


def slopes(phi: Reals) -> tuple[Reals, Reals]:
    """Return twice the energy of all links over omega², and its derivative by differences."""
    step = 2e-4  # a difference of the sixth order
    parts = ((1, 0.75), (2, -0.15), (3, 1 / 60))
    ends = [[analogues(phi + s * k * step)[0] for s in (1, -1)] for k, _ in parts]
    slope = sum(w * (b - a) / step for (b, a), (_, w) in zip(ends, parts, strict=True))
    return analogues(phi)[0], np.asarray(slope)


class Planer:
    """Independent motion of the planing machine from one dead position over a turn."""

    def __init__(self) -> None:
        self.stroke = 2 * CD * OA / OC
        self.start = -np.arcsin(OA / OC)  # where the slotted link is farthest to the right
        ends = [self.start, np.pi - self.start]
        _, _, _, place, _ = pose(np.array(ends))
        assert place[0] - place[1] == pytest.approx(self.stroke, rel=1e-12)
        self.right = float(place[0])
        self.work = 0.9 * FORCE * self.stroke
        self.constant = self.work / (2 * np.pi)
        cuts = [self.crossing(share) for share in (0.05, 0.95)]
        self.edges = [self.start, *cuts, ends[1], self.start + 2 * np.pi]

    def crossing(self, share: float) -> float:
        """Return where the tool has made a share of its stroke."""
        low, high = self.start, np.pi - self.start
        for _ in range(200):
            middle = (low + high) / 2
            made = (self.right - float(pose(np.array([middle]))[3][0])) / self.stroke
            low, high = (middle, high) if made < share else (low, middle)
        return float(low)

    def gain(self, phi: Reals) -> Reals:
        """Return the energy gained since the start, by works and heights alone."""
        _, _, d, e, centre = pose(phi)
        cut = np.clip((self.right - e) / self.stroke - 0.05, 0.0, 0.9) * self.stroke
        cut = np.where(phi < np.pi - self.start, cut, 0.9 * self.stroke)
        heights = 20 * ((d.imag - OC) / 2) + 4 * centre.imag
        _, _, d0, _, c0 = pose(np.array([self.start]))
        first = 20 * ((d0.imag - OC) / 2) + 4 * c0.imag
        found = self.constant * (phi - self.start) - FORCE * cut - G * (heights - first)
        return np.asarray(found)

    def motion(self, flywheel: float) -> tuple[Callable[[Reals], Reals], float, float]:
        """Return omega² at angles, and both extreme speeds, of which the mean is half the sum."""

        def squares(phi: Reals, energy: float) -> Reals:
            return 2 * (energy + self.gain(phi)) / (flywheel + slopes(phi)[0])

        def extremes(energy: float) -> tuple[float, float]:
            high = self.best(lambda at: squares(at, energy))
            low = -self.best(lambda at: -squares(at, energy))
            return float(np.sqrt(high)), float(np.sqrt(low))

        low, high = 0.3 * flywheel * OMEGA**2, 3 * (flywheel + 9) * OMEGA**2
        for _ in range(80):
            energy = (low + high) / 2
            low, high = (low, energy) if sum(extremes(energy)) > 2 * OMEGA else (energy, high)
        return lambda phi: squares(phi, energy), *extremes(energy)

    def best(self, function: Callable[[Reals], Reals]) -> float:
        """Return the greatest value, between edges where moments jump."""
        found = []
        for low, high in zip(self.edges[:-1], self.edges[1:], strict=True):
            low, high = low + 1e-13, high - 1e-13
            for _ in range(8):
                at = np.linspace(low, high, 161)
                values = function(at)
                k = int(np.argmax(values))
                low, high = at[max(k - 1, 0)], at[min(k + 1, 160)]
            found.append(float(np.max(values)))
        return max(found)

    def transmitted(self, flywheel: float, own: float) -> float:
        """Return the greatest moment in the train: that of the motor less what its side takes."""
        squares, _, _ = self.motion(flywheel)

        def moment(phi: Reals) -> Reals:
            mass, slope = slopes(phi)
            _, tool, weights = analogues(phi)
            is_cutting = (phi > self.edges[1]) & (phi < self.edges[2])
            push = self.constant + np.where(is_cutting, FORCE * tool, 0.0) - weights
            acceleration = (push - squares(phi) * slope / 2) / (flywheel + mass)
            return np.abs(self.constant - own * acceleration)

        return self.best(moment)


@pytest.mark.dear
def test_the_chain_agrees_with_works_and_energies() -> None:
    machine, planer = solved(PATH)["machine"], Planer()
    chain, power = machine["chain"], machine["power"]
    at_crank = planer.work * N_CRANK / 60
    assert power["crank"] == pytest.approx(at_crank, rel=1e-9)
    assert power["motor"] == pytest.approx(at_crank / (0.97 * 0.96 * 0.85), rel=1e-9)
    assert chain["chosen"] == "100L4"
    assert chain["ratio"] == 18.0
    assert chain["J_rotor"] == pytest.approx(0.011 * 18**2, rel=1e-12)
    whole = chain["slow"]["J"] + chain["J_rotor"]
    assert chain["fast"]["J"] * 18**2 == pytest.approx(chain["slow"]["J"], rel=1e-12)
    _, high, low = planer.motion(whole)
    assert (high - low) / OMEGA == pytest.approx(1 / 25, rel=1e-9)
    for name, own in (("slow", chain["J_rotor"]), ("fast", whole)):
        assert chain[name]["M_train"] == pytest.approx(planer.transmitted(whole, own), rel=1e-9)
        wheel = chain[name]
        hollow = (1 + 0.8**2) / 8
        assert wheel["m"] * wheel["D"] ** 2 * hollow == pytest.approx(wheel["J"], rel=1e-12)
        area = np.pi / 4 * wheel["D"] ** 2 * (1 - 0.8**2)
        assert wheel["m"] == pytest.approx(7800 * area * wheel["b"], rel=1e-12)
    assert chain["flywheel_on"] == "fast"


def test_stages_have_the_module_of_their_row() -> None:
    stages = solved(PATH)["machine"]["chain"]["stages"]
    assert [(one["z"], one["module_mm"], one["row"]) for one in stages] == [
        ([18, 72], 2.5, 1),
        ([20, 90], 4.0, 1),
    ]
    assert check_module(Fraction(35, 10000)).row == 2
    odd = check_module(Fraction(31, 10000))
    assert (odd.row, odd.nearest) == (0, Fraction(4, 1000))
    assert check_module(Fraction(1, 2)).nearest == Fraction(1, 10)


def changed(tmp_path: Path, *changes: tuple[str, str]) -> Path:
    text = TEXT
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    path = tmp_path / "changed.toml"
    path.write_text(text, "utf-8")
    return path


@pytest.mark.dear
def test_forty_random_tables_give_the_least_suitable_motor(tmp_path: Path) -> None:
    rng = np.random.default_rng(1)
    flywheel = Flywheel(load(PATH))
    needed = 2637.142857142857 / 0.79152
    for _ in range(40):
        count = int(rng.integers(1, 7))
        powers = rng.uniform(1500, 8000, count).round(-1).tolist()
        speeds = rng.choice([935, 1340, 1355, 1410, 1480, 1495, 2850], count).tolist()
        table = "".join(
            f'\n[[motors]]\nname = "m{k}"\npower = {p}\nn = {n}\n'
            for k, (p, n) in enumerate(zip(powers, speeds, strict=True))
        )
        path = tmp_path / "random.toml"
        path.write_text(TEXT[: TEXT.index("[[motors]]")] + table, "utf-8")
        found = machine_chain(Flywheel(load(path)), flywheel.exact.inertia)
        assert found is not None
        fits = [
            (p, k)
            for k, (p, n) in enumerate(zip(powers, speeds, strict=True))
            if p >= needed and abs(n / 18 / N_CRANK - 1) <= 0.05
        ]
        name = None if found.chosen is None else found.chosen.motor.name
        assert name == (f"m{min(fits)[1]}" if fits else None)


def test_a_rotor_that_is_enough_needs_no_flywheel(tmp_path: Path) -> None:
    path = changed(tmp_path, ("J = 0.011\n", "J = 1.3\n"))
    chain = solved(path)["machine"]["chain"]
    assert chain["slow"] is None
    assert chain["fast"] is None
    told = CliRunner().invoke(cli, ["solve", str(path), "--lang", "en"]).output
    assert "The rotor replaces the flywheel" in " ".join(told.split())


def test_the_drawn_flywheel_is_without_the_rotor(tmp_path: Path) -> None:
    """The file has its flywheel on the shaft of the motor, whose rotor is on it, too."""
    record = solved(changed(tmp_path))["machine"]
    rest = record["J_f"]["exact"] / 18**2 - 0.011
    assert record["flywheel"]["J"] == pytest.approx(rest, rel=1e-12)
    told = CliRunner().invoke(cli, ["note", str(changed(tmp_path)), "-o", str(tmp_path),
                                    "--format", "ipynb", "--lang", "en"])  # fmt: skip
    assert told.exit_code == 0
    protocol = CliRunner().invoke(cli, ["protocol", str(changed(tmp_path)), "--lang", "en"]).output
    assert "the flywheel has the rest" in " ".join(protocol.split())


def test_without_a_train_the_ratio_is_that_of_the_chosen_motor(tmp_path: Path) -> None:
    gears = TEXT[TEXT.index("[gears]") : TEXT.index("[machine]")]
    crank = ('train = "3" # кривошип вращается с колесом 3', f"n = {N_CRANK!r}")
    chain = solved(changed(tmp_path, (gears, ""), crank))["machine"]["chain"]
    assert chain["stages"] == []
    assert chain["chosen"] == "100L4"
    assert chain["ratio"] == pytest.approx(1410 / N_CRANK, rel=1e-12)


@pytest.mark.parametrize(
    "change, message",
    [
        (("power = 4000", "power = -4000"), r"motors\[3\]\.power.*expected a power in W"),
        (("n = 1430\nn_sync = 1500", "n = 1530\nn_sync = 1500"), "less than the synchronous"),
        (('name = "112M4"', 'name = "100L4"'), "another motor is named 100L4"),
        (('constant = "driving"', 'constant = "resisting"'), "the loads drive already"),
        (("efficiency = 0.85", "efficiency = 85"), "expected an efficiency"),
    ],
)
def test_faults_name_their_place(tmp_path: Path, change: tuple[str, str], message: str) -> None:
    told = CliRunner().invoke(cli, ["solve", str(changed(tmp_path, change))])
    assert told.exit_code == 3
    assert re.search(message, " ".join(told.output.split()))


def test_motors_without_power_and_odd_modules_are_reported(tmp_path: Path) -> None:
    path = changed(tmp_path, ("power = 4000", "power = 2000"), ("power = 5500", "power = 2500"),
                   ('"1-2" = 2.5', '"1-2" = 2.6'))  # fmt: skip
    told = CliRunner().invoke(cli, ["protocol", str(path), "--lang", "en"]).output
    told = " ".join(told.split())
    assert "No motor of the table has enough power" in told
    assert "not standard" in told
