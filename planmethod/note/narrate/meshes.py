"""Wheels, racks and rolling wheels in words and formulas (зацепления звеньев: данные и расчёт)."""

# no messages: rules, in the words of the file

from __future__ import annotations

from collections.abc import Iterator

from planmethod.construct.steps import NumberName
from planmethod.mechanism.groups import AssurGroup
from planmethod.mechanism.model import FRAME
from planmethod.note.document import GivenFact
from planmethod.note.formula import Rich, fraction
from planmethod.note.narrate.naming import Formulas, Names, point_name
from planmethod.note.narrate.stated_links import StatedNumbers
from planmethod.plans.build import Construction
from planmethod.plans.model import PlanKind
from planmethod.plans.motion.meshes import mesh_of, turns
from planmethod.problem.mesh_records import GearMesh
from planmethod.problem.names import segment


def mesh_facts(text: StatedNumbers) -> Iterator[GivenFact]:
    """Yield the wheels of the links: teeth or radii, the angle α, an assembled position."""
    for index, mesh in enumerate(one for one in text.problem.meshes if not one.mesh.rolls):
        yield from _mesh(mesh, f"meshes[{index}]", text)
    for mesh in text.problem.meshes:
        if mesh.mesh.rolls:
            yield _rolling(mesh, text)


def _mesh(mesh: GearMesh, path: str, text: StatedNumbers) -> Iterator[GivenFact]:
    note, (one, two) = text.language.note, mesh.mesh.links
    called = text.problem.mechanism.called
    data: dict[str, object] = {
        f"{path}.links": [one, two],
        f"{path}.centres": [*mesh.centres],
        f"{path}.kind": mesh.kind,
    }
    sizes: list[str] = []
    if mesh.teeth:
        data[f"{path}.z"] = [*mesh.teeth]
        for link, z in zip((one, two), mesh.teeth, strict=False):
            sizes.append(f"z_{{{called(link)}}} = {z}")
        if mesh.module is not None:
            data[f"{path}.module"] = mesh.module
            sizes.append(f"m = {text.number(mesh.module, 'mm')}")
    else:
        data[f"{path}.r"] = [r for r in mesh.radii if r]
        for link, r in zip((one, two), mesh.radii, strict=True):
            if r:
                sizes.append(f"r_{{{called(link)}}} = {text.metres(r)}")
    data[f"{path}.alpha"] = mesh.alpha
    sizes.append(f"α = {text.number(mesh.alpha, 'deg')}")
    names = {"one": called(one), "two": called(two), "pole": point_name(mesh.pole)}
    yield GivenFact(f"{note['meshes'][mesh.kind].format(**names)}: {', '.join(sizes)}", data)
    angles = [
        (link, mesh.angle(link))
        for link in (one, two, mesh.mesh.carrier)
        if link != FRAME and turns(text.problem, link) and not (mesh.is_rack and link == two)
    ]
    told = [f"φ_{{{link}}} = {text.number(angle, 'deg')}" for link, angle in angles]
    kept: dict[str, object] = {f"{path}.phi": [angle for _, angle in angles]}
    if mesh.is_rack:
        told.append(f"s_{{{mesh.slider}}} = {text.metres(mesh.place)}")
        kept[f"{path}.s"] = mesh.place
    yield GivenFact(note.mesh_together.format(facts=", ".join(told)), kept)


def _rolling(mesh: GearMesh, text: StatedNumbers) -> GivenFact:
    note = text.language.note
    link = mesh.mesh.links[0] if mesh.is_rack else mesh.mesh.links[1]
    path = f"links.{segment(link)}.rolls"
    radius = mesh.radius(link)
    data: dict[str, object] = {
        f"{path}.radius": radius,
        f"{path}.centre": mesh.centre(link),
        f"{path}.phi": mesh.angle(link),
    }
    said = {"link": link, "radius": text.metres(radius), "centre": point_name(mesh.centre(link))}
    phi = text.number(mesh.angle(link), "deg")
    if mesh.is_rack:
        slide = text.problem.slides[mesh.slider]
        data |= {f"{path}.on": slide.label, f"{path}.at": mesh.place}
        on = text.problem.guide_name(slide.label)
        place = f"s_{{{mesh.centre(link)}}} = {text.metres(mesh.place)}"
        return GivenFact(note.rolls_on_line.format(on=on, phi=phi, place=place, **said), data)
    fixed, arm = mesh.centres[0], mesh.angle(mesh.mesh.carrier)
    data |= {f"{path}.on": fixed, f"{path}.circle": mesh.radii[0], f"{path}.at": arm}
    line = f"{point_name(fixed)}{point_name(mesh.centres[1])}"
    place = f"∠{line} = {text.number(arm, 'deg')}"
    form = note.rolls_inside if mesh.kind == "internal" else note.rolls_outside
    circle = text.metres(mesh.radii[0])
    return GivenFact(
        form.format(on=point_name(fixed), circle=circle, phi=phi, place=place, **said), data
    )


# Calculations ------------------------------------------------------------------------------------


def driven_by_mesh(construction: Construction) -> Iterator[tuple[AssurGroup, GearMesh]]:
    """Yield the groups of wheels and racks with their meshes."""
    for group in construction.structure.groups:
        if group.is_toothed:
            yield group, mesh_of(construction.draft.problem, group)


class MeshFormulas:
    """Formulas of the angles and rates of wheels, and of the ways of racks."""

    def __init__(self, names: Names, formulas: Formulas) -> None:
        self.names, self.formulas, self.texts = names, formulas, names.texts
        self.kinematics = names.kinematics
        self._own = {group.links[0]: mesh for group, mesh in driven_by_mesh(names.construction)}
        self._made: dict[NumberName, tuple[str, PlanKind]] = {}
        for link in self._own:
            self._made[NumberName(f"phi_{link}")] = (link, PlanKind.POSITION)
            self._made[NumberName(f"s_{link}")] = (link, PlanKind.POSITION)
            for kind in (PlanKind.VELOCITY, PlanKind.ACCELERATION):
                rates = self.kinematics.rates(kind)
                if link in rates:
                    self._made[rates[link]] = (link, kind)

    def has(self, number: NumberName) -> bool:
        """Return whether a sum is the angle, way or rate that a mesh gives."""
        return number in self._made

    def lines(self, number: NumberName) -> list[Rich]:
        """Return the formula of such a number."""
        link, kind = self._made[number]
        mesh = self._own[link]
        if number.startswith("s_"):
            return [self._displacement(mesh, number)]
        if kind is PlanKind.POSITION:
            return [self._angle(mesh, link, number)]
        return [self._rate(mesh, link, kind, number)]

    def _signed(self, value: float) -> str:
        text = self.formulas.notation.short(abs(value), 5)
        return f"(−{text})" if value < 0 else text

    def _ratio(self, mesh: GearMesh, link: str) -> tuple[str, float]:
        """Return u of the link over the other, relative to the carrier, in letters and value."""
        called, value = self.names.solution.problem.mechanism.called, mesh.ratio(link)
        letter = "z" if len(mesh.teeth) == 2 else "r"
        other = mesh.counterpart(link)
        over = fraction(f"{letter}_{{{called(other)}}}", f"{letter}_{{{called(link)}}}")
        return (over if value > 0 else f"−{over}"), value

    def _sum(self, symbol: str, parts: list[tuple[str, str]], value: float, unit: str) -> str:
        letters = " + ".join(one for one, _ in parts).replace("+ −", "− ")
        numbers = " + ".join(two for _, two in parts).replace("+ −", "− ")
        end = self.formulas.notation.short(value, 4)
        sides = [side for side in (letters, numbers) if side != end]
        space = "" if unit == "deg" else " "
        return f"{' = '.join([symbol, *sides])} = {end}{space}{self.formulas.unit(unit)}".rstrip()

    def _angle(self, mesh: GearMesh, link: str, number: NumberName) -> Rich:
        """φ_4 = φ_04 + u·Δφ_1: Δφ is counted from the assembled position."""
        start = mesh.angle(link)
        parts = [(f"φ_{{0,{link}}}", self.formulas.notation.short(start))]
        share = self._factors(mesh, link)
        if mesh.is_rack:
            slider = mesh.slider
            way = self.formulas.number(NumberName(f"s_{slider}" if slider not in self._drivers
                                                  else "s")) - mesh.place  # fmt: skip
            sign = "−" if mesh.rack_sign * mesh.offset > 0 else ""
            r = abs(mesh.offset)
            over = fraction(f"s_{{{slider}}} − s_{{0}}", f"r_{{{link}}}")
            numbers = fraction(self._signed(way), self.formulas.notation.short(r))
            parts.append((f"{sign}{over}·{fraction('180°', 'π')}",
                          f"{sign}{numbers}·{fraction('180°', 'π')}"))  # fmt: skip
        for of, letters, value in share:
            turned = NumberName(f"turn_{mesh.pole}_{of}")
            if turned in self.names.step:
                by = self.formulas.number(turned)
                parts.append((f"{letters}Δφ_{{{of}}}", f"{value}{self._signed(by)}°"))
        return self._sum(f"φ_{{{link}}}", parts, self.formulas.number(number), "deg")

    @property
    def _drivers(self) -> set[str]:
        drive = self.names.solution.problem.drive
        return {drive.link} if drive.pivot is None else set()

    def _factors(self, mesh: GearMesh, link: str) -> list[tuple[str, str, str]]:
        """Return by which factor the other link and the carrier turn a wheel: letters, number."""
        carrier, other = mesh.mesh.carrier, mesh.counterpart(link)
        if mesh.is_rack:
            return [(carrier, "", "")]
        letters, value = self._ratio(mesh, link)
        found = [(other, f"{letters}·", f"{self._factor(value)}·")]
        minus = letters.replace("−", "") if letters.startswith("−") else f"− {letters}"
        bracket = f"(1 + {minus})" if value < 0 else f"(1 {minus})"
        return [*found, (carrier, f"{bracket}·", f"{self._factor(1.0 - value)}·")]

    def _factor(self, value: float) -> str:
        text = self.formulas.notation.short(abs(value), 5)
        return f"−{text}" if value < 0 else text

    def _rate(self, mesh: GearMesh, link: str, kind: PlanKind, number: NumberName) -> Rich:
        """ω_4 = u·ω_1 + (1 − u)·ω_H (формула Виллиса)."""
        first = kind is PlanKind.VELOCITY
        letter, unit = ("ω", "1/s") if first else ("ε", "1/s²")
        rates, parts = self.kinematics.rates(kind), []
        if mesh.is_rack:
            made = f"{'omega' if first else 'epsilon'}_{link}*"
            if NumberName(made) in self.names.step:
                slider = mesh.slider
                pin = self.names.solution.problem.slides[slider].pin
                value = self.formulas.number(NumberName(made)) * mesh.offset * -mesh.rack_sign
                sign = "−" if mesh.rack_sign * mesh.offset > 0 else ""
                moving = f"{'v' if first else 'a'}_{{{pin}}}"
                for one in self.kinematics.relatives.values():
                    if one.point == pin and FRAME not in (one.of, one.to):
                        own = self.names.solution.legend[one.label("v" if first else "ar")]
                        moving = own.symbol
                radius = self.formulas.notation.short(abs(mesh.offset))
                parts.append((f"{sign}{fraction(moving, f'r_{{{link}}}')}",
                              f"{sign}{fraction(self._signed(value), radius)}"))  # fmt: skip
        for of, letters, factor in self._factors(mesh, link):
            if of in rates:
                value = self.formulas.number(rates[of])
                parts.append((f"{letters}{letter}_{{{of}}}", f"{factor}{self._signed(value)}"))
        value = self.formulas.number(number)
        more = ""
        if value:
            more = f", {self.texts.ccw if value > 0 else self.texts.cw}"
        return self._sum(f"{letter}_{{{link}}}", parts, value, unit) + more

    def _displacement(self, mesh: GearMesh, number: NumberName) -> Rich:
        """s_4 = s_0 ± r·Δφ of a rack that a wheel moves."""
        wheel, rack = mesh.mesh.links
        by = self.formulas.number(NumberName(f"turn_{mesh.pole}_{wheel}"))
        sign, short = ("−" if mesh.offset > 0 else ""), self.formulas.notation.short
        over = fraction("π", "180°")
        parts = [
            ("s_{0}", short(mesh.place)),
            (f"{sign}r_{{{wheel}}}·Δφ_{{{wheel}}}·{over}",
             f"{sign}{short(abs(mesh.offset))}·{self._signed(by)}·{over}"),
        ]  # fmt: skip
        return self._sum(f"s_{{{rack}}}", parts, self.formulas.number(number), "m")
