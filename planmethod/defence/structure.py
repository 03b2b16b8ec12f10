"""Questions on the structure of a mechanism (вопросы по структуре)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from types import MappingProxyType

from planmethod.defence.case import Case, Template
from planmethod.defence.model import ChoiceAnswer, Instance, TextAnswer
from planmethod.mechanism.groups import AssurGroup
from planmethod.mechanism.structure import (
    PairKind,
    driver_formula,
    kind_of_motion,
    roman,
    stated_pairs,
)
from planmethod.note.formula import Rich
from planmethod.note.narrate.naming import point_name
from planmethod.note.narrate.structure import (
    local_letters,
    mobility_formula,
    signed,
    spatial_sum,
)

CLASSES = ("II", "III", "IV", "V")
"""Classes of a mechanism that are offered."""

KINDS = ("RRR", "RRP", "RPR", "PRP", "RPP")
"""Signatures of the dyads, by their kind."""


def _links(group: AssurGroup) -> Rich:
    return "–".join(group.links)


def _moving_links(case: Case) -> Iterator[Instance]:
    structure, mechanism = case.solution.structure, case.solution.problem.mechanism
    yield Instance(
        "", case.exactly(structure.moving_links), case.scheme(),
        {"links": ", ".join(mechanism.links), "frame": mechanism.frame},
    )  # fmt: skip


def _lower_pairs(case: Case) -> Iterator[Instance]:
    structure, mechanism = case.solution.structure, case.solution.problem.mechanism
    kinds = [pair.kind for pair in stated_pairs(mechanism)]
    sliding = kinds.count(PairKind.PRISMATIC)
    facts = {"revolute": str(structure.lower_pairs - sliding), "prismatic": str(sliding)}
    yield Instance("", case.exactly(structure.lower_pairs), case.scheme(), facts)


def _prismatic_pairs(case: Case) -> Iterator[Instance]:
    mechanism = case.solution.problem.mechanism
    found = [pair for pair in stated_pairs(mechanism) if pair.kind is PairKind.PRISMATIC]
    listed = ", ".join("–".join(map(mechanism.called, pair.links)) for pair in found)
    if found:
        yield Instance("", TextAnswer(listed), case.scheme())


def _mobility(case: Case) -> Iterator[Instance]:
    structure, problem = case.solution.structure, case.solution.problem
    formula = mobility_formula(structure, case.language, problem.sheet.notation)
    yield Instance("", case.exactly(structure.mobility), case.scheme(), {"formula": formula})


def _redundant(case: Case) -> Iterator[Instance]:
    structure, problem = case.solution.structure, case.solution.problem
    if problem.mechanism.higher or problem.mechanism.meshes:
        return
    pairs = {1: structure.lower_pairs, 4: structure.higher_pairs}
    letters, numbers = spatial_sum(structure.moving_links, pairs, problem.sheet.notation)
    facts = {
        "sum": f"{letters} = {numbers} = {signed(structure.spatial_mobility)}",
        "q": signed(structure.redundant), "w": str(structure.mobility),
    }  # fmt: skip
    yield Instance("", case.exactly(structure.redundant), case.scheme(), facts)


def _class_of_mechanism(case: Case) -> Iterator[Instance]:
    structure = case.solution.structure
    options = {one: one for one in CLASSES}
    right = roman(structure.class_number)
    if structure.groups and right in options:
        yield Instance(
            "", ChoiceAnswer(right, options), case.scheme(), {"formula": structure.formula}
        )


def _formula(case: Case) -> Iterator[Instance]:
    structure = case.solution.structure
    first, *groups = structure.formula.split(" → ")
    options = {
        "right": structure.formula,
        "swapped": " → ".join([first, *groups[::-1]]),
        "backwards": " → ".join([*groups[::-1], first]),
        "last": " → ".join([*groups, first]),
    }
    if len(groups) > 1 and len(set(options.values())) == len(options):
        yield Instance("", ChoiceAnswer("right", options), case.scheme())


def _dyad_kind(case: Case) -> Iterator[Instance]:
    texts = case.language.note
    options = {one: local_letters(one, texts) for one in KINDS}
    for group in case.solution.structure.groups:
        if group.is_dyad:
            yield Instance(
                _links(group), ChoiceAnswer(group.signature, options), case.scheme(),
                {"links": _links(group), "kind": str(group.kind)},
            )  # fmt: skip


def _role(case: Case) -> Iterator[Instance]:
    mechanism = case.solution.problem.mechanism
    known = ("crank", "rocker", "slider", "rod", "stone", "slotted link")
    names = case.language.report["roles"]["who"]
    for row in kind_of_motion(mechanism):
        if row.role.value in known and row.link in mechanism.links:
            motions = case.language.structure["motions"]
            options = {one: str(names[one]) for one in known}
            yield Instance(
                row.link, ChoiceAnswer(row.role.value, options), case.scheme(),
                {"link": row.link, "motion": motions[row.motion.value]},
            )  # fmt: skip


def _shared_hinge(case: Case) -> Iterator[Instance]:
    for joint in case.solution.problem.mechanism.revolutes:
        if len(joint.links) > 2:
            links = ", ".join(map(case.solution.problem.mechanism.called, joint.links))
            yield Instance(
                joint.point, case.exactly(joint.pairs), case.scheme(),
                {"point": point_name(joint.point), "links": links, "count": str(len(joint.links))},
            )  # fmt: skip


def _other_driver(case: Case) -> Iterator[Instance]:
    mechanism = case.solution.problem.mechanism
    for link in mechanism.links:
        if link not in mechanism.drivers and any(
            set(pair.links) == {"0", link} for pair in stated_pairs(mechanism)
        ):
            yield Instance(link, ChoiceAnswer("groups"), case.scheme(), {"link": link})


def _group_condition(case: Case) -> Iterator[Instance]:
    for group in case.solution.structure.groups:
        if group.is_dyad:
            facts = {"links": _links(group)}
            yield Instance(_links(group), case.exactly(3), case.scheme(), facts)


def _removed_group(case: Case) -> Iterator[Instance]:
    structure, mechanism = case.solution.structure, case.solution.problem.mechanism
    if len(structure.groups) > 1:
        last = structure.groups[-1]
        facts = {"links": _links(last), "w": str(structure.mobility)}
        yield Instance(_links(last), ChoiceAnswer("same"), case.scheme(), facts)
    elif structure.groups:
        facts = {"links": _links(structure.groups[0]), "driver": driver_formula(mechanism)}
        facts["w"] = str(structure.mobility)
        yield Instance("only", ChoiceAnswer("same"), case.scheme(), facts)


def _higher_replaced(case: Case) -> Iterator[Instance]:
    if not case.solution.problem.mechanism.higher:
        yield Instance("", ChoiceAnswer("two"), case.scheme())


TEMPLATES: Mapping[str, Template] = MappingProxyType(
    {
        "moving_links": _moving_links,
        "lower_pairs": _lower_pairs,
        "prismatic_pairs": _prismatic_pairs,
        "mobility": _mobility,
        "redundant": _redundant,
        "class_of_mechanism": _class_of_mechanism,
        "formula": _formula,
        "dyad_kind": _dyad_kind,
        "role": _role,
        "shared_hinge": _shared_hinge,
        "other_driver": _other_driver,
        "group_condition": _group_condition,
        "removed_group": _removed_group,
        "higher_replaced": _higher_replaced,
    }
)
"""Templates by their keys in the catalogue."""
