"""Plans of velocities and accelerations as a student draws them (планы студента).

Each method is one group of the mechanism. It is called three times: to draw the scheme, the plan
of velocities, the plan of accelerations; each reads its segments and calculates what follows from
them with the student's own numbers.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from benchmarks.checking.hand import ImpossibleError, Student
from benchmarks.checking.scheme import (
    at_angle,
    circle_line,
    circles,
    cross,
    dot,
    lines,
    triangle,
)

SCHEME, VELOCITIES, ACCELERATIONS, FORCES = range(4)
LETTER = {VELOCITIES: "v", ACCELERATIONS: "a"}
OTHER_SCALE = {"v": "mu_a", "a": "mu_v", "F": "mu_a"}


@dataclass(slots=True)
class Drawing(Student):
    """A student who draws plans.

    Attributes
    ----------
    stage : int
    true : dict of str to complex, m
        Points of the mechanism.
    at : dict of str to complex, mm
        The same as drawn, to the scale of the scheme.
    plan : dict of int to dict of str to complex, mm
        Heads of vectors on the two plans, from the pole.
    turns : dict of str to float
        Angular velocities that the student goes on with, by links.
    known : dict of str to float
        All other calculated numbers, by their names.
    """

    stage: int = SCHEME
    true: dict[str, complex] = field(default_factory=dict)
    at: dict[str, complex] = field(default_factory=dict)
    plan: dict[int, dict[str, complex]] = field(
        default_factory=lambda: {VELOCITIES: {}, ACCELERATIONS: {}}
    )
    turns: dict[str, float] = field(default_factory=dict)
    known: dict[str, float] = field(default_factory=dict)

    # Data --------------------------------------------------------------------------------------

    def length(self, name: str) -> float:
        """Return a length of the data by its letters, in either order."""
        for link in self.data["links"].values():
            if name in link:
                return float(link[name])
        raise KeyError(name)

    def scale(self, name: str) -> float:
        """Return a scale of the data."""
        return float(self.data["scales"][name])

    def fixed(self, *names: str) -> None:
        """Place the points of the frame."""
        if self.stage == SCHEME:
            for name in names:
                self.place(name, complex(*self.data["frame"][name]))
        elif self.stage in self.plan:
            for name in names:
                self.plan[self.stage][name] = 0j

    def place(self, name: str, where: complex) -> None:
        """Draw a point of the scheme."""
        self.true[name] = where
        self.at[name] = self.hand.put(f"scheme {name}", where * 1000 / (1000 * self.scale("mu_l")))

    def along(self, tail: str, head: str) -> complex:
        """Return a link's direction, carried from the scheme to the plan."""
        name = f"{self.stage} {tail}{head}"
        return self.hand.carry(name, self.at[head] - self.at[tail])

    def draw(self, name: str, point: complex) -> complex:
        """Draw the head of a vector on the plan."""
        if abs(point) > 1e9:
            raise ImpossibleError(name)
        self.plan[self.stage][name] = self.hand.put(f"{self.stage} {name}", point)
        return self.plan[self.stage][name]

    # Reading and calculating ---------------------------------------------------------------------

    def read(self, key: str, segment: complex) -> float:
        """Read a segment of the plan of this stage, and return the value."""
        if self.stage == VELOCITIES or key.split()[0] in ("a", "at", "ar"):
            others = [
                (name, other)
                for name, other in self.plan[self.stage].items()
                if abs(abs(other) - abs(segment)) > 0.15 * abs(segment) and abs(other) > 5
            ]
            if others and self.slips("another point's segment read", key):
                segment = others[len(key) % len(others)][1]
        return self.scaled(key, LETTER[self.stage], self.hand.read(key, abs(segment)))

    def scaled(self, key: str, plan: str, mm: float) -> float:
        """Turn millimetres into a value, and write both."""
        scale = self.scale(f"mu_{plan}")
        if self.slips(f"μ_{plan} forgotten", key, everywhere=True):
            scale = 1.0
        if self.slips(f"μ_{plan} inverted", key, everywhere=True):
            scale = 1 / scale
        if self.slips(f"μ of another plan for μ_{plan}", key, everywhere=True):
            scale = self.scale(OTHER_SCALE[plan])
        if self.slips("μ forgotten once", key):
            scale = 1.0
        return self.say(key, mm * scale, mm)

    def own_length(self, pair: str) -> float:
        """Return the length of a link that the student divides by."""
        return self.known[pair] if pair in self.known else self.length(pair)

    def rotation(self, link: str, speed: str, pair: str, arm: complex, turned: complex) -> None:
        """Calculate ω of a link: speed by the link's length, the sense from the plan."""
        key, length, value = f"omega {link}", self.own_length(pair), self.known[speed]
        if self.slips("ω with l in mm", key, everywhere=True):
            length *= 1000
        others = [n for n in self.known if n.startswith("v ") and n != speed]
        if others and self.slips("ω by another point's velocity", key):
            value = self.known[others[-1]]
        if self.slips("ω by another link's length", key):
            length = self._other_length(length)
        if self.slips("diameter for radius in ω", key):
            length *= 2
        sense = 1 if cross(arm, turned) > 0 else -1
        if self.slips("ω in the other sense", key):
            sense = -sense
        self.turns[link] = self.say(key, sense * value / length, turns=True)

    def angular(self, link: str, across: str, pair: str, arm: complex, turned: complex) -> None:
        """Calculate ε of a link."""
        key, length, value = f"epsilon {link}", self.own_length(pair), self.known[across]
        whole = "a " + across.split()[1]
        if self.slips("ε with l in mm", key, everywhere=True):
            length *= 1000
        if whole in self.known and self.slips("ε from the whole acceleration", key):
            value = self.known[whole]
        sense = 1 if cross(arm, turned) > 0 else -1
        if self.slips("ε in the other sense", key):
            sense = -sense
        self.known[key] = self.say(key, sense * value / length, turns=True)

    def _other_length(self, length: float) -> float:
        """Return the length of another link."""
        every = [
            value
            for link in self.data["links"].values()
            for name, value in link.items()
            if isinstance(value, float) and abs(value - length) > 0.1 * length
        ]
        return every[0] if every else 1.5 * length

    def normal(self, link: str, end: str, start: str, speed: str) -> complex:
        """Calculate a normal acceleration, and return it as a vector on the plan, mm."""
        key, pair = f"an {end} {start}", self.pair_of(end, start)
        length, velocity = self.own_length(pair), self.known[speed]
        if self.hand.from_omega:
            turn = self.turns[link]
            others = [w for n, w in self.turns.items() if n != link]
            if others and self.slips("aⁿ by another link's velocity", key):
                turn = others[0]
            value = turn**2 * length
        else:
            names = [n for n in self.known if n.startswith("v ") and n != speed]
            if names and self.slips("aⁿ by another link's velocity", key):
                velocity = self.known[names[0]]
            value = velocity**2 / length
        if self.slips("aⁿ without the square", key):
            value = velocity / length
        value = self.say(key, value, self._mm(key, value))
        vector = self.along(end, start) * value / self.scale("mu_a")
        return -vector if self.slips("aⁿ away from the centre", key) else vector

    def _mm(self, key: str, value: float) -> float:
        return self.hand.read(key, value / self.scale("mu_a"))

    def pair_of(self, one: str, two: str) -> str:
        """Return the letters under which a length is given or known."""
        for pair in (one + two, two + one):
            if pair in self.known or any(pair in link for link in self.data["links"].values()):
                return pair
        raise KeyError(one + two)

    def keep(self, key: str, segment: complex) -> None:
        """Read a segment for later use."""
        self.known[key] = self.read(key, segment)

    def keep_both(
        self, whole: str, whole_segment: complex, part: str, part_segment: complex
    ) -> None:
        """Read the segments of an absolute and a relative vector, each for its own or exchanged."""
        if self.slips("absolute and relative exchanged", whole, part):
            whole_segment, part_segment = part_segment, whole_segment
        if self.slips("relative taken for absolute", whole):
            whole_segment = part_segment
        self.keep(whole, whole_segment)
        self.keep(part, part_segment)

    def tangential(self, key: str, start: complex, head: complex) -> None:
        """Read a tangential acceleration, from the end of the normal one."""
        whole = self.slips("whole acceleration read for the tangential", key)
        self.keep(key, head if whole else head - start)

    # Groups --------------------------------------------------------------------------------------

    def crank(self, pivot: str, pin: str) -> None:
        """Draw link 1, from its driver."""
        pair, driver = self.pair_of(pivot, pin), self.data["driver"]
        length = self.length(pair)
        if self.stage == SCHEME:
            self.place(pin, self.true[pivot] + length * at_angle(float(driver["phi"])))
        elif self.stage == VELOCITIES:
            self.turns["1"] = self._driver_speed(f"v {pin}")
            if self.slips("diameter for radius of the crank", f"v {pin}"):
                length *= 2
            speed = abs(self.turns["1"]) * length
            self.known[f"v {pin}"] = self.say(
                f"v {pin}", speed, self.hand.read(f"v {pin}", speed / self.scale("mu_v"))
            )
            way = 1j if self.turns["1"] > 0 else -1j
            if self.slips("crank turned the other way", f"v {pin}"):
                way = -way
            self.draw(
                pin, way * self.along(pivot, pin) * self.known[f"v {pin}"] / self.scale("mu_v")
            )
        elif self.stage == ACCELERATIONS:
            self._crank_acceleration(pivot, pin, length)

    def _driver_speed(self, key: str) -> float:
        driver, hand = self.data["driver"], self.hand
        if "omega" in driver:
            return float(driver["omega"])
        speed = float(driver["n"])
        if self.slips("n taken for ω", key):
            return speed
        if self.slips("n/60 taken for ω", key):
            return hand.calculate(speed / 60)
        if self.slips("n·9.55 taken for ω", key):
            return hand.calculate(speed * 9.55)
        return hand.calculate(hand.pi * speed / 30)

    def _crank_acceleration(self, pivot: str, pin: str, length: float) -> None:
        key = f"a {pin}"
        value = self.turns["1"] ** 2 * length
        if not self.hand.from_omega:
            value = self.known[f"v {pin}"] ** 2 / length
        if self.slips("aⁿ of the crank without the square", key):
            value = abs(self.turns["1"]) * length
        value = self.say(key, value, self._mm(key, value))
        self.known[key] = value
        self.draw(pin, self.along(pin, pivot) * value / self.scale("mu_a"))

    def two_rods(self, joint: str, near: str, far: str, links: tuple[str, str], side: int) -> None:
        """Draw two links with three turning pairs."""
        one, two = self.pair_of(near, joint), self.pair_of(far, joint)
        if self.stage == SCHEME:
            self.place(
                joint,
                circles(self.true[near], self.length(one), self.true[far], self.length(two), side),
            )
        elif self.stage == VELOCITIES:
            plan = self.plan[self.stage]
            first, second = (1j * self.along(end, joint) for end in (near, far))
            if self.slips("relative velocity along the link", f"v {joint}"):
                first *= 1j
            head = self.draw(joint, lines(plan[near], first, plan[far], second))
            self.keep_both(f"v {joint}", head, f"v {joint} {near}", head - plan[near])
            speed = f"v {joint}"
            if self.true[far] and f"v {far}" in self.known:
                speed = f"v {joint} {far}"
                self.keep(speed, head - plan[far])
            self._rod_turns(joint, near, links[0], one, f"v {joint} {near}")
            self._rod_turns(joint, far, links[1], two, speed)
            self.known[f"speed {joint} {far}"] = self.known[speed]
        elif self.stage == ACCELERATIONS:
            plan = self.plan[self.stage]
            starts = []
            for end, link in ((near, links[0]), (far, links[1])):
                speed = f"v {joint} {near}" if end == near else f"speed {joint} {far}"
                starts.append(plan[end] + self.normal(link, joint, end, speed))
            across = [1j * self.along(end, joint) for end in (near, far)]
            head = self.draw(joint, lines(starts[0], across[0], starts[1], across[1]))
            for end, start in zip((near, far), starts, strict=True):
                self.tangential(f"at {joint} {end}", start, head)
            self.keep(f"a {joint}", head)
            for end, link, pair, start in zip((near, far), links, (one, two), starts, strict=True):
                arm = self.at[joint] - self.at[end]
                self.angular(link, f"at {joint} {end}", pair, arm, head - start)

    def _rod_turns(self, joint: str, end: str, link: str, pair: str, speed: str) -> None:
        plan = self.plan[self.stage]
        arm = self.at[joint] - self.at[end]
        self.rotation(link, speed, pair, arm, plan[joint] - plan[end])

    def slider(self, joint: str, near: str, link: str, guide: str, side: int) -> None:
        """Draw a rod and a slider on a fixed guide."""
        told = self.data["frame"]["guides"][guide]
        way = at_angle(float(told["angle"]))
        pair = self.pair_of(near, joint)
        if self.stage == SCHEME:
            through = told["through"]
            start = self.true[through] if isinstance(through, str) else complex(*through)
            self.place(joint, circle_line(self.true[near], self.length(pair), start, way, side))
        elif self.stage == VELOCITIES:
            plan = self.plan[self.stage]
            across = 1j * self.along(near, joint)
            if self.slips("relative velocity along the link", f"v {joint}"):
                across *= 1j
            along = self.hand.carry(f"{self.stage} {guide}", way)
            head = self.draw(joint, lines(plan[near], across, 0j, along))
            self.keep_both(f"v {joint}", head, f"v {joint} {near}", head - plan[near])
            self._rod_turns(joint, near, link, pair, f"v {joint} {near}")
        elif self.stage == ACCELERATIONS:
            plan = self.plan[self.stage]
            start = plan[near] + self.normal(link, joint, near, f"v {joint} {near}")
            along = self.hand.carry(f"{self.stage} {guide}", way)
            head = self.draw(joint, lines(start, 1j * self.along(near, joint), 0j, along))
            self.tangential(f"at {joint} {near}", start, head)
            self.keep(f"a {joint}", head)
            arm = self.at[joint] - self.at[near]
            self.angular(link, f"at {joint} {near}", pair, arm, head - start)

    def slotted(self, pin: str, pivot: str, link: str, full: str) -> None:
        """Draw a block at a pin on a link that turns about a fixed pivot; its full length."""
        twin, pair = pin + link, pivot + pin + link
        if self.stage == SCHEME:
            self.true[twin], self.at[twin] = self.true[pin], self.at[pin]
        elif self.stage == VELOCITIES:
            plan = self.plan[self.stage]
            along = self.along(pivot, pin)
            head = self.draw(twin, lines(plan[pin], along, 0j, 1j * along))
            self.keep_both(f"v {twin}", head, f"vs {twin} {pin}", head - plan[pin])
            arm = self.at[pin] - self.at[pivot]
            mm = self.hand.read(pair, abs(arm))
            length = self.hand.calculate(mm * self.scale("mu_l"))
            if self.slips("whole length of the slotted link for its arm", f"omega {link}"):
                length = self.length(full)
            if self.slips("μ_l forgotten in the arm", f"omega {link}"):
                length = mm
            self.known[pair] = length
            self.rotation(link, f"v {twin}", pair, arm, head)
        elif self.stage == ACCELERATIONS:
            self._slotted_acceleration(pin, pivot, link)

    def _slotted_acceleration(self, pin: str, pivot: str, link: str) -> None:
        twin, pair = pin + link, pivot + pin + link
        plan, key = self.plan[self.stage], f"ak {twin} {pin}"
        turn, sliding = self.turns[link], self.known[f"vs {twin} {pin}"]
        velocity = self.plan[VELOCITIES]
        way = self.hand.carry("ak", velocity[twin] - velocity[pin])
        way *= 1j if turn > 0 else -1j
        factor = 2.0
        if self.slips("2 of Coriolis forgotten", key):
            factor = 1.0
        if self.slips("ω₁ in Coriolis", key):
            turn = self.turns["1"]
        if self.slips("another velocity in Coriolis", key):
            sliding = self.known[f"v {twin}"]
        value = self.hand.calculate(factor * abs(turn) * sliding)
        if self.slips("Coriolis forgotten", key):
            value = 0.0
            self.leave_out(key)
        else:
            value = self.say(key, value, self._mm(key, value))
        if self.slips("Coriolis turned the other way", key):
            way = -way
        start = plan[pin] + way * value / self.scale("mu_a")
        other = self.normal(link, twin, pivot, f"v {twin}")
        along = self.along(pivot, pin)
        head = self.draw(twin, lines(start, along, other, 1j * along))
        self.tangential(f"at {twin} {pivot}", other, head)
        self.keep(f"ar {twin} {pin}", head - start)
        self.keep(f"a {twin}", head)
        arm = self.at[pin] - self.at[pivot]
        self.angular(link, f"at {twin} {pivot}", pair, arm, head - other)

    def carried(
        self,
        point: str,
        start: str,
        end: str,
        ratio: complex,
        *,
        link: str = "",
        pivot: bool = False,
    ) -> None:
        """Draw a point of a link, by the similar figure on start and end.

        Parameters
        ----------
        ratio : complex
            The point from `start`, over `end` from `start`.
        link : str
            Link that turns about `start`: its point may be found from ω.
        """
        if self.stage == SCHEME:
            near, far = self.true[start], self.true[end]
            self.place(point, near + ratio * (far - near))
            return
        if self.stage not in self.plan:
            return
        plan, key = self.plan[self.stage], f"{LETTER[self.stage]} {point}"
        near, far = plan[start], plan[end]
        if abs(ratio - 0.5) > 0.03 and self.slips("similarity from the other end", key):
            near, far = far, near
        if near and abs(ratio.imag) > 0.05 and self.slips("similar figure mirrored", key):
            ratio = ratio.conjugate()
        head = near + ratio * (far - near)
        if pivot and self.stage == VELOCITIES and self.hand.from_omega:
            arm = self._carried_arm(point, start)
            speed = self.say(key, abs(self.turns[link]) * arm)
            self.known[key] = speed
            size = abs(head) or 1.0
            self.draw(point, head / size * speed / self.scale("mu_v"))
            if self.hand.writes_mm:
                self.said[key].mm = self.hand.read(key, speed / self.scale("mu_v"))
            return
        self.draw(point, head)
        self.keep(key, self.plan[self.stage][point])

    def _carried_arm(self, point: str, start: str) -> float:
        return abs(self.true[point] - self.true[start])

    def shape(self, start: str, end: str, third: str, side: int) -> complex:
        """Return the ratio of a triangle with three given sides."""
        lengths = [
            self.length(self.pair_of(*pair))
            for pair in ((start, end), (start, third), (end, third))
        ]
        return triangle(0j, complex(lengths[0]), lengths[1], lengths[2], side) / lengths[0]


def component(vector: complex, way: complex) -> float:
    """Return the component of a vector along a direction."""
    return dot(way / abs(way), vector)
