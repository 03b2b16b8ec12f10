"""Questions on two wheels in mesh (зацепление)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import cos, degrees
from types import MappingProxyType

from planmethod.defence.case import Case, Template
from planmethod.defence.model import ChoiceAnswer, Instance, Place
from planmethod.gears.involute.geometry import MeshingProblem, Pair
from planmethod.note.formula import Rich
from planmethod.project.parts import PartName


def _meshing(case: Case) -> tuple[MeshingProblem, Pair] | None:
    problem = case.problem_of(MeshingProblem)
    return None if problem is None else (problem, Pair.of(problem))


def _on_mesh(case: Case, *marks: str) -> Place:
    return case.of_part(case.own_part(PartName.MESHING), "meshing", *marks)


def _of_mesh(
    case: Case, about: str, value: float, unit: str, mark: str, facts: Mapping[str, Rich]
) -> Instance:
    """Return a question on a size of the pair."""
    answer = case.computed(value, unit)
    return Instance(
        about, answer, _on_mesh(case, mark), {**facts, "value": case.number(value, unit)}
    )


def _wheels(meshing: tuple[MeshingProblem, Pair]) -> Iterator[tuple[int, str]]:
    """Yield the wheels that a rack cuts: their indices and numbers."""
    for k in (0,) if meshing[1].cutter else (0, 1):
        yield k, str(k + 1)


def _overlap(case: Case) -> Iterator[Instance]:
    found = _meshing(case)
    if found is not None:
        yield _of_mesh(case, "", float(found[1].epsilon), "", "(N_{1}|P)".replace("{", "\\{"), {})


def _overlap_limit(case: Case) -> Iterator[Instance]:
    if _meshing(case) is not None:
        yield Instance("", ChoiceAnswer("continuous"), _on_mesh(case, "P"))


def _line_of_action(case: Case) -> Iterator[Instance]:
    if _meshing(case) is not None:
        yield Instance("", ChoiceAnswer("bases"), _on_mesh(case, r"N_\{1\}"))


def _working_angle(case: Case) -> Iterator[Instance]:
    found = _meshing(case)
    if found is not None:
        value = degrees(float(found[1].alpha_w))
        facts = {"symbol": "α_{w}"}
        yield _of_mesh(case, "", value, "deg", "dimension α_w", facts)


def _centre_distance(case: Case) -> Iterator[Instance]:
    found = _meshing(case)
    if found is not None:
        yield _of_mesh(case, "", abs(float(found[1].a_w)), "mm", "dimension a_w", {})


def _wider_centres(case: Case) -> Iterator[Instance]:
    found = _meshing(case)
    if found is not None and not found[1].cutter:
        yield Instance("", ChoiceAnswer("angle"), _on_mesh(case, "dimension a_w"))


def _base_radius(case: Case) -> Iterator[Instance]:
    found = _meshing(case)
    if found is None or found[1].beta:
        return
    problem, pair = found
    for k, number in _wheels(found):
        facts = {"wheel": number, "z": str(problem.z[k]), "m": case.input_number(problem.m, "mm"),
                 "alpha": case.input_number(degrees(problem.rack.alpha)) + "°"}  # fmt: skip
        value = abs(float(pair.d_b[k])) / 2.0
        yield _of_mesh(case, number, value, "mm", rf"dimension r_\{{b{number}\}}", facts)


def _pitch(case: Case) -> Iterator[Instance]:
    found = _meshing(case)
    if found is not None:
        facts = {"m": case.input_number(found[0].m, "mm")}
        yield _of_mesh(case, "", found[1].p, "mm", "dimension p", facts)


def _shift_sign(case: Case) -> Iterator[Instance]:
    found = _meshing(case)
    if found is None:
        return
    for k, number in _wheels(found):
        x = float(found[1].x[k])
        facts = {"wheel": number, "z": str(found[0].z[k]), "x": case.input_number(round(x, 4)),
                 "least": case.number(float(found[1].x_min[k])),
                 "bound": case.number(found[1].z_min)}  # fmt: skip
        if x > 0.0:
            right = "undercut" if found[0].z[k] < found[1].z_min else "thick"
            yield Instance(number, ChoiceAnswer(right), _on_mesh(case, rf"O_\{{{number}\}}"), facts)


def _least_shift(case: Case) -> Iterator[Instance]:
    found = _meshing(case)
    if found is None or found[1].beta:
        return
    for k, number in _wheels(found):
        if found[0].z[k] < found[1].z_min:
            value = float(found[1].x_min[k])
            facts = {"wheel": number, "z": str(found[0].z[k]),
                     "bound": case.number(found[1].z_min)}  # fmt: skip
            yield _of_mesh(case, number, value, "", rf"O_\{{{number}\}}", facts)


def _tip_thickness(case: Case) -> Iterator[Instance]:
    found = _meshing(case)
    if found is None:
        return
    for k, number in _wheels(found):
        value = float(found[1].s_na[k])
        facts = {"wheel": number, "thickness": case.number(value, "mm"),
                 "share": case.number(value / found[0].m)}  # fmt: skip
        yield Instance(number, ChoiceAnswer("break"), _on_mesh(case, rf"d_\{{a{number}\}}"), facts)


def _clearance(case: Case) -> Iterator[Instance]:
    found = _meshing(case)
    if found is not None and not found[1].cutter:
        pair, problem = found[1], found[0]
        value = abs(float(pair.a_w)) - (float(pair.d_a[0]) + float(pair.d_f[1])) / 2.0
        facts = {"m": case.input_number(problem.m, "mm"), "c": case.input_number(problem.rack.c)}
        yield _of_mesh(case, "", value, "mm", "dimension c", facts)


def _sliding(case: Case) -> Iterator[Instance]:
    if _meshing(case) is not None:
        yield Instance("", ChoiceAnswer("pole"), _on_mesh(case, "P"))


def _thickness(case: Case) -> Iterator[Instance]:
    found = _meshing(case)
    if found is None:
        return
    for k, number in _wheels(found):
        facts = {"wheel": number}
        value = float(found[1].s[k])
        mark = rf"dimension s_\{{{number}\}}"
        if value > 0.0 and case.sheets.find(case.own_part(PartName.MESHING), "meshing", mark):
            yield _of_mesh(case, number, value, "mm", mark, facts)


def _working_radius(case: Case) -> Iterator[Instance]:
    found = _meshing(case)
    if found is None:
        return
    pair = found[1]
    for k, number in _wheels(found):
        value = abs(float(pair.d_w[k])) / 2.0
        facts = {"wheel": number, "cosine": case.number(cos(float(pair.alpha_w)))}
        yield _of_mesh(case, number, value, "mm", rf"dimension r_\{{w{number}\}}", facts)


def _mesh_ratio(case: Case) -> Iterator[Instance]:
    found = _meshing(case)
    if found is not None:
        one, two = (abs(z) for z in found[0].z)
        facts = {"first": str(one), "last": str(two)}
        yield _of_mesh(case, "", two / one, "", "P", facts)


def _radius_of(case: Case, key: str, index: str) -> Iterator[Instance]:
    """Yield the radius of a circle of each wheel."""
    found = _meshing(case)
    if found is None:
        return
    for k, number in _wheels(found):
        value = abs(float(getattr(found[1], key)[k])) / 2.0
        mark = rf"dimension r_\{{{index}{number}\}}"
        yield _of_mesh(case, number, value, "mm", mark, {"wheel": number})


def _pitch_radius(case: Case) -> Iterator[Instance]:
    yield from _radius_of(case, "d", "")


def _tip_radius(case: Case) -> Iterator[Instance]:
    yield from _radius_of(case, "d_a", "a")


def _root_radius(case: Case) -> Iterator[Instance]:
    yield from _radius_of(case, "d_f", "f")


def _tooth_height(case: Case) -> Iterator[Instance]:
    found = _meshing(case)
    if found is not None:
        for k, number in _wheels(found):
            value = abs(float(found[1].d_a[k]) - float(found[1].d_f[k])) / 2.0
            yield _of_mesh(case, number, value, "mm", "dimension h", {"wheel": number})


def _base_pitch(case: Case) -> Iterator[Instance]:
    found = _meshing(case)
    if found is not None and not found[1].beta:
        value = float(found[1].p) * cos(float(found[0].rack.alpha))
        yield _of_mesh(case, "", value, "mm", r"N_\{1\}", {})


def _sum_of_shifts(case: Case) -> Iterator[Instance]:
    found = _meshing(case)
    if found is not None and not found[1].cutter:
        total = float(found[1].x[0] + found[1].x[1])
        right = "equal" if abs(total) < 1e-9 else "positive" if total > 0.0 else "negative"
        facts = {"value": case.input_number(round(total, 4))}
        yield Instance("", ChoiceAnswer(right), _on_mesh(case, "dimension a_w"), facts)


def _why_constant(case: Case) -> Iterator[Instance]:
    if _meshing(case) is not None:
        yield Instance("", ChoiceAnswer("pole"), _on_mesh(case, "P"))


def _involute_of(case: Case) -> Iterator[Instance]:
    if _meshing(case) is not None:
        yield Instance("", ChoiceAnswer("base"), _on_mesh(case, r"dimension r_\{b1\}"))


def _force_line(case: Case) -> Iterator[Instance]:
    if _meshing(case) is not None:
        yield Instance("", ChoiceAnswer("action"), _on_mesh(case, r"N_\{1\}"))


def _doubled_module(case: Case) -> Iterator[Instance]:
    if _meshing(case) is not None:
        yield Instance("", ChoiceAnswer("overlap"), _on_mesh(case, "dimension p"))


TEMPLATES: Mapping[str, Template] = MappingProxyType(
    {
        "overlap": _overlap,
        "overlap_limit": _overlap_limit,
        "line_of_action": _line_of_action,
        "working_angle": _working_angle,
        "centre_distance": _centre_distance,
        "wider_centres": _wider_centres,
        "working_radius": _working_radius,
        "base_radius": _base_radius,
        "pitch": _pitch,
        "thickness": _thickness,
        "shift_sign": _shift_sign,
        "least_shift": _least_shift,
        "tip_thickness": _tip_thickness,
        "clearance": _clearance,
        "sliding": _sliding,
        "mesh_ratio": _mesh_ratio,
        "pitch_radius": _pitch_radius,
        "tip_radius": _tip_radius,
        "root_radius": _root_radius,
        "tooth_height": _tooth_height,
        "base_pitch": _base_pitch,
        "sum_of_shifts": _sum_of_shifts,
        "why_constant": _why_constant,
        "involute_of": _involute_of,
        "force_line": _force_line,
        "doubled_module": _doubled_module,
    }
)
"""Templates of two wheels in mesh by their keys in the catalogue."""
