"""Forces in a group as a student finds them: moments, the force plan, the lever (силы)."""

from __future__ import annotations

from benchmarks.checking.drawing import ACCELERATIONS, FORCES, VELOCITIES, Drawing, component
from benchmarks.checking.scheme import at_angle, cross, dot, lines


def slider_crank_forces(student: Drawing, names: tuple[str, str, str, str], guide: str) -> None:
    """Find the reactions and the balancing moment of a rod 2, a slider 3 and a crank.

    Parameters
    ----------
    names : (str, str, str, str)
        Pivot and pin of the crank, pin of the slider, centre of mass of the rod.
    """
    if student.stage == FORCES:
        way = at_angle(float(student.data["frame"]["guides"][guide]["angle"]))
        _Forces(student, names[:3], {"2": names[3], "3": names[2]}, way=way).find()


def four_bar_forces(
    student: Drawing, names: tuple[str, str, str, str], centres: dict[str, str]
) -> None:
    """Find the same of a rod 2 and a rocker 3.

    Parameters
    ----------
    names : (str, str, str, str)
        Pivot and pin of the crank, joint of rod and rocker, pivot of the rocker.
    centres : dict of str to str
        Centres of mass by links.
    """
    if student.stage == FORCES:
        _Forces(student, names[:3], centres, ground=names[3]).find()


class _Forces:
    """Forces of a crank 1 and a group of a rod 2 and a link 3, which slides or turns.

    Attributes
    ----------
    force : dict of str to complex, N
        Inertia, weight and load by their names.
    couple : dict of str to float, N·m
        Of inertia and load, by links and "load".
    way : complex
        Of the guide of link 3.
    ground : str
        Pivot of link 3; empty where it slides.
    """

    def __init__(
        self,
        student: Drawing,
        names: tuple[str, ...],
        centres: dict[str, str],
        *,
        way: complex = 0j,
        ground: str = "",
    ) -> None:
        self.student, self.centres, self.way, self.ground = student, centres, way, ground
        self.pivot, self.pin, self.joint = names
        self.links = student.data["dynamics"]["links"]
        self.gravity = float(student.data["dynamics"]["gravity"])
        self.mu_l = student.scale("mu_l")
        self.force: dict[str, complex] = {}
        self.couple: dict[str, float] = {}
        self.ends = {"2": self.pin, **({"3": ground} if ground else {})}

    def find(self) -> None:
        """Find all in a student's order."""
        self._given()
        self._load()
        self.sides = {link: self._side_force(link) for link in self.ends}
        self._plan()
        self._balance()
        self._lever()

    def _given(self) -> None:
        student, plan = self.student, self.student.plan[ACCELERATIONS]
        for link, point in self.centres.items():
            key, kilograms = f"inertia {link}", float(self.links[link]["mass"])
            mass = kilograms
            if student.slips("mass in grams", key):
                mass *= 1000
            size = student.say(key, mass * student.known[f"a {point}"], self._mm(key, mass, point))
            along = student.slips("inertia force along the acceleration", key)
            way = student.hand.carry(key, plan[point])
            self.force[key] = way * size * (1 if along else -1)
            weight = student.hand.calculate(kilograms * self.gravity)
            if student.slips("mass taken for weight", f"weight {link}"):
                weight = kilograms
            if student.slips("weight left out", f"weight {link}"):
                weight = 0.0
            self.force[f"weight {link}"] = -1j * weight
        for link in self.ends:
            self._inertia_couple(link)

    def _inertia_couple(self, link: str) -> None:
        student, key = self.student, f"inertia couple {link}"
        self.couple[link] = -float(self.links[link]["inertia"]) * student.known[f"epsilon {link}"]
        if student.slips("inertia couple left out", key):
            self.couple[link] = 0.0
            student.leave_out(key)
            return
        student.say(key, abs(self.couple[link]))
        side = f"Ft {link} {self._by(link)} {self.ends[link]} {self.joint}"
        if student.slips("inertia couple turned the other way", side):
            self.couple[link] = -self.couple[link]

    def _load(self) -> None:
        (load,) = self.student.data["loads"]
        if "couple" in load:
            turns = 1 if self.student.turns["3"] > 0 else -1
            self.couple["load"] = -float(load["couple"]) * turns
            return
        moving = self.student.plan[VELOCITIES][self.joint]
        sense = 1 if dot(self.way, moving) > 0 else -1
        self.force["load"] = -float(load["force"]) * self.way * sense

    def _by(self, link: str) -> str:
        return "1" if link == "2" else "0"

    def _mm(self, key: str, mass: float, point: str) -> float:
        value = mass * self.student.known[f"a {point}"]
        return self.student.hand.read(key, value / self.student.scale("mu_F"))

    def _arm(self, name: str, force: complex, where: str, centre: str) -> float:
        """Return the signed arm of a force, read from the scheme, mm."""
        if abs(force) == 0.0:
            return 0.0
        exact = cross(self.student.at[where] - self.student.at[centre], force / abs(force))
        read = self.student.hand.read(f"arm {name}", abs(exact))
        return read if exact > 0 else -read

    def _side_force(self, link: str) -> complex:
        """Return R^τ of a link, found from the moments about the joint of the group, N."""
        student, outer = self.student, self.ends[link]
        key = f"Ft {link} {self._by(link)} {outer} {self.joint}"
        factor, length = self.mu_l, student.length(student.pair_of(outer, self.joint))
        if student.slips("arms in mm", key):
            factor = 1.0
        if student.slips("moment of a weight left out", key):
            moment = 0.0
        else:
            moment = self._moment(f"weight {link}", factor)
        moment += self._moment(f"inertia {link}", factor) + self.couple[link]
        moment += self.couple.get("load", 0.0) if link == "3" else 0.0
        arm = student.at[outer] - student.at[self.joint]
        side = -moment / length
        if student.slips("R^τ of the other sense", key):
            side = -side
        mm = student.hand.read(key, abs(side) / student.scale("mu_F"))
        student.say(key, abs(side), mm)
        return side * 1j * student.hand.carry(f"across {outer}{self.joint}", arm)

    def _moment(self, name: str, factor: float) -> float:
        force, where = self.force[name], self.centres[name.split()[1]]
        return abs(force) * self._arm(name, force, where, self.joint) * factor

    def _plan(self) -> None:
        """Close the force plan of the group, and read it."""
        student, scale = self.student, self.student.scale("mu_F")
        point = student.hand.put("force side", self.sides["2"] / scale)
        marks = {"side": point}
        for name in ("inertia 2", "weight 2", "inertia 3", "weight 3", "load"):
            if name in self.force:
                point = student.hand.put(f"force {name}", point + self.force[name] / scale)
                marks[name] = point
        loaded, at = point, student.at
        along = student.hand.carry("force AB", at[self.joint] - at[self.pin])
        if self.ground:
            point = student.hand.put("force side 3", point + self.sides["3"] / scale)
            closing = student.hand.carry("force CB", at[self.joint] - at[self.ground])
        else:
            closing = 1j * student.hand.carry("force guide", self.way)
        start = lines(0j, along, point, closing)  # R^n goes from here to the first mark
        self._read("F 2 1", marks["side"] - start)
        self._read("F 3 0", start - loaded)
        self._read("F 2 3", marks["weight 2"] - start)
        self.reaction = (marks["side"] - start) * scale

    def _read(self, key: str, segment: complex) -> None:
        student = self.student
        mm = student.hand.read(key, abs(segment))
        if student.slips("force × 1000", key):
            student.say(key, mm * student.scale("mu_F") * 1000, mm)
            student.known[key] = student.said[key].value
        else:
            student.known[key] = student.scaled(key, "F", mm)

    def _balance(self) -> None:
        student, on_crank = self.student, -self.reaction
        factor = self.mu_l
        if student.slips("arms in mm", "balance"):
            factor = 1.0
        arm = self._arm("balance", on_crank, self.pin, self.pivot) * factor
        value = -student.known["F 2 1"] * arm
        if student.slips("moment of the other sense", "balance"):
            value = -value
        student.say("balance", value, turns=True)

    def _lever(self) -> None:
        """Take moments of all forces about the pole of the turned plan of velocities."""
        student, plan = self.student, self.student.plan[VELOCITIES]
        total = 0.0
        for name, force in self.force.items():
            if abs(force) == 0.0:
                continue
            at = self.joint if name == "load" else self.centres[name.split()[1]]
            exact = component(plan[at], force)
            read = student.hand.read(f"lever {name}", abs(exact))
            if name == "load" and student.slips("load left out of the lever", "lever"):
                continue
            total += abs(force) * read * (1 if exact > 0 else -1)
        for name, couple in self.couple.items():
            total += couple * self._turned(name)
        crank = student.hand.read("lever crank", abs(plan[self.pin]))
        sense = 1 if student.turns["1"] > 0 else -1
        value = -total / crank * student.length(self.pivot + self.pin) * sense
        student.say("lever", value, turns=True)

    def _turned(self, name: str) -> float:
        """Return ab/l of the link that a couple acts on, with the sense of its rotation, mm/m."""
        student, plan = self.student, self.student.plan[VELOCITIES]
        outer = self.ends["3" if name == "load" else name]
        relative = plan[self.joint] - plan[outer]
        sense = 1 if cross(student.at[self.joint] - student.at[outer], relative) > 0 else -1
        read = student.hand.read(f"lever couple {name}", abs(relative))
        if name == "load":
            if student.slips("load left out of the lever", "lever"):
                read = 0.0
        elif student.slips("couple left out of the lever", "lever"):
            read = 0.0
        return sense * read / student.length(student.pair_of(outer, self.joint))
