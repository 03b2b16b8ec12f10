"""Forces in a slider-crank as a student finds them: moments, the force plan, the lever (силы)."""

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
    if student.stage != FORCES:
        return
    _Forces(student, names, at_angle(float(student.data["frame"]["guides"][guide]["angle"]))).find()


class _Forces:
    def __init__(self, student: Drawing, names: tuple[str, str, str, str], way: complex) -> None:
        self.student, self.way = student, way
        self.pivot, self.pin, self.slider, self.centre = names
        links = student.data["dynamics"]["links"]
        self.mass = {link: float(links[link]["mass"]) for link in "23"}
        self.inertia = float(links["2"]["inertia"])
        self.gravity = float(student.data["dynamics"]["gravity"])
        self.load = float(student.data["loads"][0]["force"])
        self.mu_l = student.scale("mu_l")

    def find(self) -> None:
        """Find all in a student's order."""
        self._given()
        self._side_force()
        self._plan()
        self._balance()
        self._lever()

    def _given(self) -> None:
        student, plan = self.student, self.student.plan[ACCELERATIONS]
        self.force: dict[str, complex] = {}
        for link, point in (("2", self.centre), ("3", self.slider)):
            key = f"inertia {link}"
            mass = self.mass[link]
            if student.slips("mass in grams", key):
                mass *= 1000
            size = student.say(key, mass * student.known[f"a {point}"], self._mm(key, mass, point))
            along = student.slips("inertia force along the acceleration", key)
            way = student.hand.carry(key, plan[point])
            self.force[key] = way * size * (1 if along else -1)
            weight = student.hand.calculate(self.mass[link] * self.gravity)
            if student.slips("mass taken for weight", f"weight {link}"):
                weight = self.mass[link]
            if student.slips("weight left out", f"weight {link}"):
                weight = 0.0
            self.force[f"weight {link}"] = -1j * weight
        turn = student.known["epsilon 2"]
        self.couple = -self.inertia * turn
        if student.slips("inertia couple left out", "inertia couple 2"):
            self.couple = 0.0
            student.leave_out("inertia couple 2")
        else:
            student.say("inertia couple 2", abs(self.couple))
            if student.slips("inertia couple turned the other way", "Ft 2 1 A B"):
                self.couple = -self.couple
        moving = student.plan[VELOCITIES][self.slider]
        self.force["load"] = -self.load * self.way * (1 if dot(self.way, moving) > 0 else -1)

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

    def _side_force(self) -> None:
        """Find R^τ of the crank on the rod from moments about the slider's pin."""
        student, key = self.student, f"Ft 2 1 {self.pin} {self.slider}"
        factor, length = self.mu_l, student.length(self.pin + self.slider)
        if student.slips("arms in mm", key):
            factor = 1.0
        if student.slips("moment of a weight left out", key):
            moment = 0.0
        else:
            moment = self._moment("weight 2", factor)
        moment += self._moment("inertia 2", factor) + self.couple
        arm = student.at[self.pin] - student.at[self.slider]
        self.side = -moment / length
        if student.slips("R^τ of the other sense", key):
            self.side = -self.side
        student.say(
            key, abs(self.side), student.hand.read(key, abs(self.side) / student.scale("mu_F"))
        )
        self.side_way = 1j * student.hand.carry("across AB", arm)

    def _moment(self, name: str, factor: float) -> float:
        force = self.force[name]
        return abs(force) * self._arm(name, force, self.centre, self.slider) * factor

    def _plan(self) -> None:
        """Close the force plan of the group, and read it."""
        student, scale = self.student, self.student.scale("mu_F")
        point = self.side * self.side_way / scale
        marks = {"side": student.hand.put("force side", point)}
        point = marks["side"]
        for name in ("inertia 2", "weight 2", "inertia 3", "weight 3", "load"):
            point = student.hand.put(f"force {name}", point + self.force[name] / scale)
            marks[name] = point
        along = student.hand.carry("force AB", student.at[self.slider] - student.at[self.pin])
        across = 1j * student.hand.carry("force guide", self.way)
        start = lines(0j, along, point, across)  # R^n goes from here to the first mark
        self._read("F 2 1", marks["side"] - start)
        self._read("F 3 0", start - point)
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
        where = {"2": plan[self.centre], "3": plan[self.slider]}
        for name, force in self.force.items():
            if abs(force) == 0.0:
                continue
            exact = component(where[name.split()[1] if name != "load" else "3"], force)
            read = student.hand.read(f"lever {name}", abs(exact))
            if name == "load" and student.slips("load left out of the lever", "lever"):
                continue
            total += abs(force) * read * (1 if exact > 0 else -1)
        relative = plan[self.slider] - plan[self.pin]
        sense = 1 if cross(student.at[self.slider] - student.at[self.pin], relative) > 0 else -1
        read = student.hand.read("lever couple", abs(relative))
        if student.slips("couple left out of the lever", "lever"):
            read = 0.0
        total += self.couple * sense * read / student.length(self.pin + self.slider)
        crank = student.hand.read("lever crank", abs(plan[self.pin]))
        sense = 1 if student.turns["1"] > 0 else -1
        value = -total / crank * student.length(self.pivot + self.pin) * sense
        student.say("lever", value, turns=True)
