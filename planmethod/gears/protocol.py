"""The construction of the pictures told step by step (протокол построения картин)."""

from __future__ import annotations

import re

from planmethod.construct.drafting import Profile
from planmethod.construct.steps import Join, LayOff, MeetLines, PointName, Step
from planmethod.gears.construction import POLE, Construction, Reading, Spot, construct, read
from planmethod.gears.model import GearProblem
from planmethod.gears.motion import Motion, solve_motion
from planmethod.gears.picture import draw
from planmethod.gears.told import calculation, given, symbol
from planmethod.note.numbers import raised
from planmethod.note.plaintext import plain_text
from planmethod.note.rounding import rounded_to, sigma_text
from planmethod.note.wording import Language, language
from planmethod.note.writers.plain import heading, wrap
from planmethod.note.writers.steps import Steps


def protocol_text(problem: GearProblem, lang: str, profile: Profile) -> str:
    """Tell what is given, the calculation, the construction of the pictures, and what is read.

    Raises
    ------
    ProblemError
        The train cannot be, or its inputs do not fit.
    """
    motion = solve_motion(problem)
    words = language(lang)
    say = words.gears.sheet
    out = Steps(words.note)
    out.lines += heading(say.protocol.format(title=problem.title), "═")
    if problem.source:
        out.lines += wrap(say.source.format(source=problem.source))
    out.chapter(say.given)
    out.lines += wrap("; ".join(plain_text(fact) for fact in given(motion, words)) + ".")
    out.chapter(say.calculation)
    for line in calculation(motion, words):
        out.lines += wrap(_plain(line), rest="  ")
    picture = draw(motion)
    if picture is None:
        out.chapter(words.gears.picture)
        out.lines += wrap(words.gears.no_picture)
    else:
        drawn = construct(motion, picture)
        _Teller(out, drawn, read(drawn, profile), profile, words).tell()
    return "\n".join(out.lines) + "\n"


def _plain(rich: str) -> str:
    """Return rich text as plain; carriers above stay behind a sign: ``U^H_1-2``."""
    return plain_text(re.sub(r"\^\{([^}−]+)\}", r"^\1", rich))


class _Teller:
    """Tells a construction, step after step."""

    def __init__(
        self, out: Steps, drawn: Construction, seen: Reading, profile: Profile, words: Language
    ) -> None:
        self.out, self.drawn, self.seen, self.profile = out, drawn, seen, profile
        self.words, self.say, self.notation = words, words.gears.sheet, words.say
        self.ends = {spot.end: spot for spot in drawn.spots}
        self.bodies = {line: body for body, line in drawn.lines.items()}

    @property
    def motion(self) -> Motion:
        return self.drawn.motion

    def tell(self) -> None:
        """Write the chapters."""
        out, say, steps = self.out, self.say, self.drawn.program.steps
        out.chapter(say.pictures)
        self._item("axis")
        rays = next(k for k, step in enumerate(steps) if step.out == POLE)
        for step in steps[:rays]:
            self._step(step)
        out.chapter(say.steps["rays"])
        self._item("pole", pole=self.notation.given(float(self.drawn.picture.pole_mm)))
        for body in self.drawn.rays:
            self._item("ray", body=self.drawn.label(body))
        out.chapter(say.steps["readings"])
        name = self.words.note.profiles.get(self.profile.name, self.profile.name)
        out.item([say.ruler.format(ruler=self.notation.given(self.profile.ruler), profile=name)])
        self._readings()
        self._found()

    def _item(self, key: str, **facts: str) -> None:
        self.out.item([self.say.steps[key].format(**facts)])

    def _step(self, step: Step) -> None:
        """Tell a step; numbers and level lines are told where they are used."""
        match step:
            case LayOff(out, origin, _, length) if out in self.ends and str(length)[:4] == "laid":
                spot = self.ends[out]
                self._start(spot, origin)
            case LayOff(out, _, _, length):
                height = float(self.drawn.data[length])
                what = ", ".join(self._what(s) for s in self.drawn.spots if s.foot == out)
                what = what or self._axis_at(height)
                self._item("foot", point=out, what=what, height=self._mm(height))
            case Join(out, one, other):
                body = self.drawn.label(self.bodies[out])
                self._item("line", one=one, other=other, body=body)
            case MeetLines(out, _, line):
                spot = self.ends[out]
                facts = {"foot": spot.foot, "point": out, "what": self._what(spot, "of ")}
                self._item("meet", body=self.drawn.label(self.bodies[line]), **facts)
            case _:
                pass

    def _what(self, spot: Spot, case: str = "") -> str:
        """Return what a point of the picture is; ``of `` is what something is of."""
        kind, _, name = spot.contact.partition(" ")
        return self.say.steps[case + ("pitch" if kind == "pitch" else "own")].format(name=name)

    def _axis_at(self, height: float) -> str:
        """Return whose fixed axis is at a height that no contact has."""
        axes = self.motion.axes.heights
        scale = float(self.motion.train.unit_m / self.drawn.picture.mu_l)
        own = [b for b in self.drawn.lines if abs(float(axes[b]) * scale - height) < 1e-6]
        return self.say.steps["own"].format(name=", ".join(own))

    def _start(self, spot: Spot, origin: PointName) -> None:
        body = next((b for b in self.drawn.starts if b in spot.bodies), spot.bodies[0])
        facts = {"foot": origin, "point": spot.letter, "what": self._what(spot, "of ")}
        mu_v = self.notation.short(self.drawn.picture.mu_v, 4)
        length = self._mm(abs(float(spot.speed)))
        lines = [self.say.steps["laid"].format(**facts, length=length, mu_v=mu_v)]
        if body in self.drawn.calculated:
            lines.append(self.say.steps["calculated"].format(body=self.drawn.label(body)))
        elif body not in self.motion.train.inputs:
            inputs = ", ".join(self.motion.train.inputs)
            told = {"body": self.drawn.label(body), "input": inputs}
            lines.append(self.say.steps["any"].format(**told))
        self.out.item(lines)

    def _mm(self, value: float) -> str:
        return self.notation.number(f"{value + 0.0:.2f}")

    def _readings(self) -> None:
        lines = []
        named = [(s.read, f"{s.foot}{s.letter}") for s in self.drawn.spots if s.read is not None]
        named += [(n, f"o{self.drawn.label(body)}") for body, n in self.drawn.segments.items()]
        for number, name in named:
            lines.append(
                self.say.steps["read"].format(
                    name=name,
                    read=self.notation.ruled(float(self.seen.read.value[number])),
                    exact=self._mm(float(self.seen.exact.value[number])),
                    sigma=self.notation.number(sigma_text(self.seen.sigma[number])),
                )
            )
        self.out.item(lines)

    def _found(self) -> None:
        train = self.motion.train
        known, unit = tuple(train.body_of), raised(self.words.gears.units[train.units[0]])
        inputs = set(train.inputs) & set(self.drawn.starts)
        mu = float(self.seen.read.value["mu"])  # type: ignore[index]
        scale, per_mm = f"μ_{{{train.letter}}}", self.notation.short(mu, 4)
        said = {"symbol": scale, "value": per_mm, "unit": unit}
        by_input = "input" in self.drawn.data and not inputs
        said["from_what"] = self.say.steps["input" if by_input else "chosen"]
        self.out.item([self.say.steps["scale"].format(**said)])
        lines = []
        for one in self.drawn.found:
            rays = [self.drawn.label(body) for body in one.rays]
            ratio = one.name.startswith("U")
            parts = [f"(o{ray})" for ray in rays[: 2 if ratio else 1]]
            if "^" in one.name:
                parts = [f"[{part} − (o{rays[-1]})]" for part in parts]
            formula = "/".join(parts) if ratio else f"{scale}·{parts[0]}"
            if one.name.startswith("omega") and train.unit == "n":
                formula = f"π/30·{formula}"
            value, sigma = float(self.seen.read.value[one.read]), self.seen.sigma[one.read]
            other = "1/s" if one.name.startswith("omega") else "1/min"
            shown = "" if ratio else raised(self.words.gears.units[other])
            lines.append(
                self.say.steps["found"]
                .format(
                    formula=_plain(f"{symbol(one.name, known)} = {formula}"),
                    read=self.notation.number(rounded_to(value, sigma)),
                    unit=shown,
                    exact=self.notation.found(float(one.exact)),
                    sigma=self.notation.number(sigma_text(sigma)),
                )
                .replace("  ", " ")
            )
        self.out.item(lines)
