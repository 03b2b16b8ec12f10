"""The chapter on structure: links, pairs, mobility, groups, class (структурный анализ)."""

from __future__ import annotations

from collections.abc import Iterator

from msgspec.structs import replace

from planmethod.mechanism.describe import PairKind, pairs, stated_pairs
from planmethod.mechanism.groups import AssurGroup
from planmethod.mechanism.model import FRAME
from planmethod.mechanism.structure import roman
from planmethod.note.document import Chapter, Node, Part
from planmethod.note.formula import Rich
from planmethod.note.narrate.structure import (
    aligned_group,
    group_joints,
    link_table,
    local_letters,
    pair_classes,
    pair_table,
    replacement_lines,
    signed,
    spatial_sum,
)
from planmethod.note.wording import Words
from planmethod.project.report.context import NBSP, Report, displayed, items, lettered, sentences
from planmethod.project.report.figures import figure
from planmethod.render.pictures.structural import Mobile, mechanism_picture
from planmethod.solved.aligned.schemes import self_aligning


def structure_chapter(report: Report) -> Iterator[Node]:
    """Yield the chapter."""
    said: Words = report.said["structure"]
    mechanism = report.one.problem.mechanism
    yield Chapter(said.title.format())
    yield Part(said.mobility.format())
    named = [report.link(link, "of") for link in mechanism.links]
    counts = report.said["counts"]
    many = len(mechanism.links)
    count = counts["links"][many] if many < len(counts["links"]) else counts.many.format(count=many)
    yield sentences(
        said.links.format(frame=report.project.frame, count=count, links=report.listed(named))
    )
    words = report.words
    yield replace(link_table(mechanism, words), name=said.links_table.format(), key="links")
    yield replace(pair_table(mechanism, words), name=said.pairs_table.format(), key="pairs")
    yield from _mobility(report, said)
    yield Part(said.groups.format())
    yield from _groups(report, said)
    yield from _aligned(report, said)


def _mobility(report: Report, said: Words) -> Iterator[Node]:
    structure, mechanism = report.one.structure, report.one.problem.mechanism
    low, spatial = structure.lower_pairs, structure.spatial_mobility
    revolute = sum(pair.kind is PairKind.REVOLUTE for pair in stated_pairs(mechanism))
    classes = pair_classes(report.one.problem.sheet.notation, report.words)
    high, notation = structure.higher_pairs, report.one.problem.sheet.notation
    counts = {"n": structure.moving_links, "low": low, "high": high, **classes}
    letters, numbers = spatial_sum(structure.moving_links, {1: low, 4: high}, notation)
    yield sentences(said.chebyshev.format())
    yield displayed(said.chebyshev_formula.format(w=signed(structure.mobility), **counts))
    yield sentences(
        said.chebyshev_where.format(revolute=revolute, prismatic=low - revolute, **counts),
        said.one_driver.format(role=report.role(mechanism.driver), link=mechanism.driver)
        if structure.mobility - structure.local_mobility == 1
        else said.drivers.format(w=structure.mobility),
    )
    if mechanism.higher:
        yield sentences(*map(lettered, replacement_lines(mechanism, structure, report.words)))
    yield sentences(said.redundant.format())
    yield displayed(
        said.redundant_formula.format(letters=letters, numbers=numbers, w=signed(spatial))
    )
    bracketed = f"({signed(spatial)})" if spatial < 0 else str(spatial)
    yield sentences(
        said.redundant_found.format(
            plane=structure.mobility, bracketed=bracketed, q=signed(structure.redundant)
        )
    )


def _groups(report: Report, said: Words) -> Iterator[Node]:
    structure, mechanism = report.one.structure, report.one.problem.mechanism
    if len(structure.groups) == 1:
        (only,) = structure.groups
        yield sentences(said.only.format(group=_group(only, report, said)))
    else:
        yield sentences(said.first.format())
        yield from items(_group(one, report, said) for one in reversed(structure.groups))
    letters = report.words.note["letters"]
    yield sentences(said.letters.format(revolute=letters["R"], prismatic=letters["P"]))
    ends = {FRAME, mechanism.driver}
    kind = next(pair.kind for pair in pairs(mechanism) if set(pair.links) == ends)
    yield sentences(
        str(said["rest"]["one" if len(structure.groups) == 1 else "many"]).format(
            role=report.role(mechanism.driver),
            link=mechanism.driver,
            frame=report.project.frame,
            pair=said["pair"][kind.value],
        )
    )
    yield displayed(f"{structure.formula}.", "structure")
    yield sentences(said.mechanism_class.format(roman=roman(structure.class_number)))


def _aligned(report: Report, said: Words) -> Iterator[Node]:
    problem, structure, words = report.one.problem, report.one.structure, report.words
    aligned = self_aligning(problem, structure)
    if not aligned.schemes or not aligned.groups or problem.mechanism.higher:
        return
    yield Part(said.aligned.format())
    classes = words.structure["pair_classes"]
    yield sentences(said.aligned_way.format(**{f"c{key}": value for key, value in classes.items()}))
    yield from items(
        next(aligned_group(problem.mechanism, group, words)).rstrip(".") for group in aligned.groups
    )
    yield sentences(said.aligned_shown.format())
    mobile = Mobile(aligned, classes)
    yield figure(
        lambda letter: mechanism_picture(
            problem.mechanism, structure, width=150.0, height=80.0, letter_height=letter,
            sense=-1 if problem.drive.rate < 0 else 1, mobile=mobile,
        ),
        said.aligned_figure.format(),
        "aligned",
        height=80.0,
    )  # fmt: skip
    yield sentences(said.aligned_sum.format())
    letters, numbers = spatial_sum(structure.moving_links, aligned.counts, problem.sheet.notation)
    yield displayed(said.redundant_formula.format(letters=letters, numbers=numbers, w=1))
    yield sentences(
        said.aligned_rank.format(
            rows=aligned.rows,
            columns=6 * len(problem.mechanism.links),
            rank=aligned.rank,
            q=aligned.rows - aligned.rank,
        )
    )


def _group(group: AssurGroup, report: Report, said: Words) -> Rich:
    kind = ""
    if group.kind is not None:
        letters = local_letters(group.signature, report.words.note)
        kind = said.group_kind.format(kind=group.kind, letters=letters)
    outer, inner = group_joints(report.every.problem.mechanism, group, report.words.note)
    joints = said.joints if len(inner) == 1 else said.joints_many
    return lettered(
        said.group.format(
            links="–".join(group.links),
            roman=roman(group.class_number),
            order=group.order,
            kind=kind,
            joints=joints.format(outer=", ".join(outer), inner=", ".join(inner)),
        ).replace(f"{NBSP} ", NBSP)
    )
