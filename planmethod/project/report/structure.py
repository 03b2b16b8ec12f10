"""The chapter on structure: links, pairs, mobility, groups, class (структурный анализ)."""

from __future__ import annotations

from collections.abc import Iterator

from msgspec.structs import replace

from planmethod.mechanism.groups import AssurGroup
from planmethod.mechanism.structure import PairKind, roman, stated_pairs
from planmethod.note.accounts.voice import displayed, lettered, sentences
from planmethod.note.document import Chapter, Node, Part
from planmethod.note.formula import Rich
from planmethod.note.narrate.structure import (
    aligned_group,
    aligned_rank,
    group_caption,
    joints_text,
    link_table,
    pair_classes,
    pair_table,
    replacement_lines,
    signed,
    spatial_sum,
)
from planmethod.note.wording import MessageTable
from planmethod.project.report.context import Report, figure, items
from planmethod.project.report.drivers import given_motion, primary_mechanisms
from planmethod.project.report.theory import composition, counted_links
from planmethod.render.pictures.structural import Mobile, SchemeArea, mechanism_picture
from planmethod.solved.aligned.schemes import self_aligning


def structure_chapter(report: Report) -> Iterator[Node]:
    """Yield the chapter."""
    texts: MessageTable = report.texts["structure"]
    mechanism = report.one.problem.mechanism
    yield Chapter(report.language.structure.title)
    yield Part(texts.mobility.format())
    named = [report.link(link, "of") for link in mechanism.links]
    counts = report.texts["counts"]
    many = len(mechanism.links)
    count = counts["links"][many] if many < len(counts["links"]) else counts.many.format(count=many)
    yield sentences(
        texts.links.format(frame=report.project.frame, count=count, links=report.listed(named))
    )
    language = report.language
    names = language.structure
    yield replace(link_table(mechanism, language), name=names.links, key="links")
    yield replace(pair_table(mechanism, language), name=names.pairs, key="pairs")
    yield from _mobility(report, texts)
    yield Part(texts.groups.format())
    yield from _groups(report, texts)
    yield from _aligned(report, texts)


def _mobility(report: Report, texts: MessageTable) -> Iterator[Node]:
    structure, mechanism = report.one.structure, report.one.problem.mechanism
    low, spatial = structure.lower_pairs, structure.spatial_mobility
    revolute = sum(pair.kind is PairKind.REVOLUTE for pair in stated_pairs(mechanism))
    classes = pair_classes(report.one.problem.sheet.notation, report.language)
    high, notation = structure.higher_pairs, report.one.problem.sheet.notation
    counts = {"n": structure.moving_links, "low": low, "high": high, **classes}
    letters, numbers = spatial_sum(structure.moving_links, {1: low, 4: high}, notation)
    yield sentences(texts.chebyshev.format())
    yield displayed(texts.chebyshev_formula.format(w=signed(structure.mobility), **counts))
    yield sentences(
        texts.chebyshev_where.format(revolute=revolute, prismatic=low - revolute, **counts),
        given_motion(report),
    )
    yield from counted_links(report)
    if mechanism.higher:
        yield sentences(*map(lettered, replacement_lines(mechanism, structure, report.language)))
    yield sentences(texts.redundant.format())
    yield displayed(
        texts.redundant_formula.format(letters=letters, numbers=numbers, w=signed(spatial))
    )
    bracketed = f"({signed(spatial)})" if spatial < 0 else str(spatial)
    yield sentences(
        texts.redundant_found.format(
            plane=structure.mobility, bracketed=bracketed, q=signed(structure.redundant)
        )
    )


def _groups(report: Report, texts: MessageTable) -> Iterator[Node]:
    structure = report.one.structure
    if len(structure.groups) == 1:
        (only,) = structure.groups
        yield sentences(texts.only.format(group=_group(only, report)))
    else:
        yield sentences(texts.first.format())
        yield from items(_group(one, report) for one in reversed(structure.groups))
    letters = report.language.note["letters"]
    yield sentences(texts.letters.format(revolute=letters["R"], prismatic=letters["P"]))
    yield sentences(primary_mechanisms(report))
    yield displayed(f"{structure.formula}.", "structure")
    yield from composition(report)
    yield sentences(texts.mechanism_class.format(roman=roman(structure.class_number)))


def _aligned(report: Report, texts: MessageTable) -> Iterator[Node]:
    problem, structure, language = report.one.problem, report.one.structure, report.language
    aligned = self_aligning(problem, structure)
    if not aligned.schemes or not aligned.groups or problem.mechanism.higher:
        return
    yield Part(texts.aligned.format())
    classes = language.structure["pair_classes"]
    yield sentences(
        texts.aligned_way.format(**{f"c{key}": value for key, value in classes.items()})
    )
    yield from items(
        next(aligned_group(problem.mechanism, group, language)).rstrip(".")
        for group in aligned.groups
    )
    yield sentences(texts.aligned_shown.format())
    mobile = Mobile.of(aligned, classes)
    yield figure(
        lambda letter: mechanism_picture(
            problem.mechanism, structure, SchemeArea(150.0, 80.0, letter),
            senses=problem.drive.senses, mobile=mobile,
        ),
        language.structure.aligned_scheme,
        "aligned",
        height=80.0,
    )  # fmt: skip
    yield sentences(texts.aligned_sum.format())
    letters, numbers = spatial_sum(structure.moving_links, aligned.counts, problem.sheet.notation)
    w = structure.driver_count + structure.local_mobility + aligned.local[0]
    yield displayed(texts.redundant_formula.format(letters=letters, numbers=numbers, w=w))
    yield sentences(texts.aligned_same.format(), aligned_rank(structure, aligned, language))


def _group(group: AssurGroup, report: Report) -> Rich:
    name, *_ = group_caption(group, report.language)
    joints = joints_text(report.every.problem.mechanism, group, report.language)
    return lettered(f"{name[:1].lower()}{name[1:]}; {joints}")
