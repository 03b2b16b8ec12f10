"""Structural analysis: pairs, links, formulas, Assur groups (структурный анализ)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from planmethod.mechanism.groups import AssurGroup, Joint, letter_of, links_of
from planmethod.mechanism.model import FRAME, Mechanism, Revolute
from planmethod.mechanism.structure import (
    PairKind,
    Structure,
    driver_formula,
    kind_of_motion,
    pairs,
    roman,
    stated_pairs,
)
from planmethod.note.document import Caption, Document, Item, Node, Step, Table, Title, table_of
from planmethod.note.formula import Rich
from planmethod.note.narrate.naming import pair_letters
from planmethod.note.numbers import MINUS
from planmethod.note.wording import Language, MessageTable
from planmethod.solved.aligned.schemes import AlignedGroup, AlignedScheme, MovablePair, SelfAligning

NBSP = "\u00a0"

MAX_SCHEMES = 8
"""Largest number of schemes of a group that the text gives beside the best."""


def structure_document(
    mechanism: Mechanism,
    structure: Structure,
    language: Language,
    pair_notation: str | None = None,
    aligned: SelfAligning | None = None,
) -> Document:
    """Return the structural analysis of a mechanism with its numbers (структурный анализ).

    ``pair_notation`` is that of the numbers of pairs: `pair_classes`. ``aligned``: with the scheme
    without redundant constraints.
    """
    return Document.of(_analysis(mechanism, structure, language, pair_notation, aligned))


def _analysis(
    mechanism: Mechanism,
    structure: Structure,
    language: Language,
    pair_notation: str | None,
    aligned: SelfAligning | None,
) -> Iterator[Node]:
    texts = language.structure
    yield Title(texts.title)
    yield Caption(texts.pairs)
    yield pair_table(mechanism, language, aligned, lettered=True)
    yield Caption(texts.links)
    yield link_table(mechanism, language)
    yield Caption(texts.formulas)
    yield from map(Item, mobility_formulas(mechanism, structure, language, pair_notation))
    yield Caption(texts.parts)
    for driver in mechanism.drivers:
        named, *counts = driver_caption(mechanism, driver, language)
        yield Step((named, "; ".join(counts)))
    for group in structure.groups:
        named, *counts = group_caption(group, language)
        told = "; ".join(counts)
        yield Step(
            (named, f"{joints_text(mechanism, group, language)}.", *([told] if told else []))
        )
    yield from map(Item, order_formulas(mechanism, structure, language))
    if aligned is not None and (aligned.groups or aligned.schemes):
        yield Caption(texts.aligned)
        yield from map(Item, aligned_lines(mechanism, structure, aligned, language, pair_notation))
    yield Item(_static_counts(structure, language.note))


# Pairs and links -----------------------------------------------------------------------------


MOBILITY = {
    PairKind.REVOLUTE: ("V", "1", "1"),
    PairKind.PRISMATIC: ("V", "1", "1"),
    PairKind.HIGHER: ("IV", "2", "4"),
    PairKind.ROLLING: ("V", "1", "2"),
}
"""Class of a pair by its constraints (Artobolevsky), its mobility in the plane and in space."""


def pair_table(
    mechanism: Mechanism,
    language: Language,
    aligned: SelfAligning | None = None,
    *,
    lettered: bool = False,
) -> Table:
    """Return the table of kinematic pairs (кинематические пары).

    ``aligned``: with the kind of each pair in its first scheme. ``lettered``: with the letter of
    each kind, by which `group_caption` calls it.
    """
    scheme = aligned.schemes[0] if aligned is not None and aligned.schemes else None
    kinds = {kind: language.structure["pair_kinds"][kind.value] for kind in PairKind}
    if lettered:
        signs = {PairKind.REVOLUTE: "R", PairKind.PRISMATIC: "P"}
        kinds |= {
            kind: f"{kinds[kind]} ({language.note['letters'][signs[kind]]})" for kind in signs
        }
    named = language.structure["pair_classes"]
    rows = []
    for pair in stated_pairs(mechanism):
        links = " – ".join(map(mechanism.called, pair.links))
        row = (pair_letters(pair.name), links, kinds[pair.kind], *MOBILITY[pair.kind])
        key = f"{pair.point} {'-'.join(pair.links)}"
        rows.append(row if scheme is None else (*row, named.get(scheme.get(key, ""), "–")))
    columns = language.structure["columns_pairs"]
    return table_of(columns if scheme else columns[:-1], rows, names=6)


def link_table(mechanism: Mechanism, language: Language) -> Table:
    """Return the table of links (звенья)."""
    every, texts = stated_pairs(mechanism), language.structure
    replacing = {pair.by for pair in mechanism.higher}
    replacing |= {mesh.carrier for mesh in mechanism.rolling}
    kinds = [
        (row.link, row.role.value, row.motion.value)
        for row in kind_of_motion(mechanism)
        if row.link not in replacing
    ]
    kinds += [(pair.roller, "roller", "plane") for pair in mechanism.higher if pair.roller]
    rows = (
        (
            mechanism.called(link),
            language.note["roles"][role],
            texts["motions"][motion],
            ", ".join(pair_letters(pair.name) for pair in every if link in pair.links),
        )
        for link, role, motion in kinds
    )
    return table_of(texts["columns_links"], rows, names=4)


# Formulas ------------------------------------------------------------------------------------


def pair_classes(pair_notation: str | None, language: Language) -> dict[str, str]:
    """Return the indices of the numbers of lower and higher pairs, as ``[sheet] notation`` says."""
    said = language.structure["notation"]
    lower, higher = said[pair_notation or said["usual"]]
    return {"lower": lower, "higher": higher}


def pair_counts(
    structure: Structure, language: Language, pair_notation: str | None
) -> dict[str, int | str]:
    """Return the numbers of links and pairs, with the indices of the pairs."""
    low, high = structure.lower_pairs, structure.higher_pairs
    indices = pair_classes(pair_notation, language)
    return {"n": structure.moving_links, "low": low, "high": high, **indices}


def mobility_formula(structure: Structure, language: Language, pair_notation: str | None) -> Rich:
    """Return the mobility by the formula of Chebyshev (формула Чебышёва)."""
    counts = pair_counts(structure, language, pair_notation)
    found: Rich = language.structure.chebyshev.format(w=signed(structure.mobility), **counts)
    return found


def mobility_formulas(
    mechanism: Mechanism, structure: Structure, language: Language, pair_notation: str | None = None
) -> Iterator[Rich]:
    """Yield mobility and redundant constraints of the whole (подвижность, избыточные связи)."""
    texts, low, high = language.structure, structure.lower_pairs, structure.higher_pairs
    kinds = [pair.kind for pair in stated_pairs(mechanism)]
    revolute, rolling = kinds.count(PairKind.REVOLUTE), kinds.count(PairKind.ROLLING)
    counts = pair_counts(structure, language, pair_notation)
    form = texts.counts_rolling if rolling else texts.counts
    sliding = low - revolute - rolling
    yield form.format(revolute=revolute, prismatic=sliding, rolling=rolling, **counts)
    yield mobility_formula(structure, language, pair_notation)
    letters, numbers = spatial_sum(structure.moving_links, {1: low, 4: high}, pair_notation)
    spatial = structure.spatial_mobility
    yield texts.spatial.format(letters=letters, numbers=numbers, w=signed(spatial))
    yield texts.redundant.format(
        ways=structure.driver_count,
        local=structure.local_mobility,
        w=_bracketed(spatial),
        q=signed(structure.redundant),
    )
    yield from replacement_lines(mechanism, structure, language)


def replacement_lines(
    mechanism: Mechanism, structure: Structure, language: Language
) -> Iterator[Rich]:
    """Yield what replaces higher pairs, and rollers that turn about themselves (замена пар)."""
    texts = language.structure
    for mesh in mechanism.meshes:
        links = "–".join(map(mechanism.called, mesh.links))
        wheel = next(link for link in mesh.links if link != FRAME)
        form = texts.rolling_counted if mesh.rolls else texts.mesh_replaced
        yield form.format(pair=pair_letters(mesh.name), links=links, link=wheel)
    for one in mechanism.passive:
        yield texts.passive.format(link=one.link, like=one.like)
    for pair in mechanism.higher:
        joints = [one for one in pairs(mechanism) if pair.by in one.links]
        text = ", ".join(
            f"{pair_letters(one.point)}{NBSP}({'–'.join(map(mechanism.called, one.links))})"
            for one in joints
        )
        links = "–".join(map(mechanism.called, (pair.links[0], pair.roller or pair.links[1])))
        yield texts.replaced.format(
            pair=pair_letters(pair.name), links=links, by=pair.by, pairs=text
        )
        if pair.roller:
            yield texts.roller.format(roller=pair.roller, link=mechanism.called(pair.links[1]))
    if mechanism.higher:
        n, p = len(mechanism.links), mechanism.lower_pairs
        yield texts.replacing.format(n=n, p=p, w=signed(3 * n - 2 * p))


def spatial_sum(
    n: int, pairs_of: Mapping[int, int], pair_notation: str | None
) -> tuple[Rich, Rich]:
    """Return the sum of Somov and Malyshev, in letters and in numbers (формула Сомова – Малышева).

    Parameters
    ----------
    n : int
        Moving links.
    pairs_of : mapping of int to int
        Number of pairs by their mobility.
    pair_notation : str or None
        Where it is ``p5 p4``, pairs are numbered by their constraints, else by their mobilities.
    """
    by_class = pair_notation == "p5 p4"
    letters, numbers = "6n", f"6·{n}"
    for mobility in range(1, 6):
        held, index = 6 - mobility, 6 - mobility if by_class else mobility
        letters += f" − {held if held > 1 else ''}p_{{{index}}}"
        if pairs_of.get(mobility):
            numbers += f" − {held}·{pairs_of[mobility]}"
    return letters, numbers


def order_formulas(
    mechanism: Mechanism, structure: Structure, language: Language
) -> Iterator[Rich]:
    """Yield the structural formula, the class, the orders of both analyses (формула строения)."""
    texts = language.structure
    first = driver_formula(mechanism)
    steps = [
        f"{roman(group.class_number)}({','.join(group.links)})"
        for group in structure.groups
        if not group.is_passive
    ]
    order, backwards = " → ".join([first, *steps]), " → ".join([*steps[::-1], first])
    yield texts.formula.format(order=order)
    yield texts.mechanism_class.format(roman=roman(structure.class_number))
    yield texts.kinematic_order.format(order=order)
    yield texts.force_order.format(order=backwards)


def _static_counts(structure: Structure, texts: MessageTable) -> Rich:
    """Return equations and unknowns of the force analysis: without friction as many as needed."""
    equations = 3 * structure.moving_links
    reactions = 2 * structure.lower_pairs + structure.higher_pairs
    unknowns = reactions + structure.mobility
    verdict = texts.statically_determinate if equations == unknowns else texts.statically_not
    return texts.static_counts.format(
        n=structure.moving_links,
        equations=equations,
        pairs=reactions,
        w=signed(structure.mobility),
        unknowns=unknowns,
        verdict=verdict,
        higher=texts.static_higher.format() if structure.higher_pairs else "",
    )


def signed(number: int) -> str:
    """Return a whole number with the sign of print."""
    return f"{MINUS}{-number}" if number < 0 else str(number)


def _bracketed(number: int) -> str:
    return f"({signed(number)})" if number < 0 else str(number)


# Without redundant constraints -----------------------------------------------------------------


def aligned_lines(
    mechanism: Mechanism,
    structure: Structure,
    aligned: SelfAligning,
    language: Language,
    pair_notation: str | None = None,
) -> Iterator[Rich]:
    """Yield how each group loses its redundant constraints, and the whole (устранение связей)."""
    texts = language.structure
    if aligned.random:
        yield texts.aligned_random.format()
    for group in aligned.groups:
        if group.schemes:
            yield from aligned_group(mechanism, group, language)
    if not aligned.schemes:
        links = "; ".join("–".join(group.links) for group in aligned.without)
        yield texts.aligned_none.format(links=links)
        return
    yield from aligned_sums(structure, aligned, language, pair_notation)
    yield aligned_rank(structure, aligned, language)
    used = {name for scheme in aligned.schemes[:1] for name in scheme.values()}
    named = texts["pair_classes"]
    yield texts.aligned_legend.format(
        legend=", ".join(
            f"{named[k]}{NBSP}– {v}" for k, v in texts["class_names"].items() if k in used
        )
    )


def aligned_rank(structure: Structure, aligned: SelfAligning, language: Language) -> Rich:
    """Return the rank of the constraint matrix, with q and W that follow."""
    rows, columns, rank = aligned.rows, 6 * structure.moving_links, aligned.rank
    return language.structure.aligned_rank.format(
        rows=rows, columns=columns, rank=rank, q=rows - rank, w=columns - rank
    )


def aligned_sums(
    structure: Structure,
    aligned: SelfAligning,
    language: Language,
    pair_notation: str | None = None,
) -> Iterator[Rich]:
    """Yield the formulas of the scheme without redundant constraints, where there is one."""
    if not aligned.schemes or not structure.groups:
        return
    n, counts = structure.moving_links, aligned.counts
    local = structure.local_mobility + aligned.local[0]
    _, numbers = spatial_sum(n, counts, pair_notation)
    by_class = pair_notation == "p5 p4"
    text = ", ".join(
        f"p_{{{6 - mobility if by_class else mobility}}}{NBSP}={NBSP}{count}"
        for mobility, count in sorted(counts.items())
    )
    w = 6 * n - sum((6 - mobility) * count for mobility, count in counts.items())
    yield language.structure.aligned_counts.format(counts=text)
    count_of_drivers = structure.driver_count
    yield language.structure.aligned_whole.format(
        numbers=numbers, w=w, ways=count_of_drivers, local=local, q=count_of_drivers + local - w
    )


def _pair_text(mechanism: Mechanism, pair: MovablePair) -> tuple[Rich, Rich]:
    """Return the letter of a pair and its links."""
    point, links = pair.key.split()
    return pair_letters(point), "–".join(map(mechanism.called, links.split("-")))


def _aligned_numbers(group: AlignedGroup) -> Rich:
    """Return the spatial sum of the best scheme of a group, in numbers."""
    classes = group.schemes[0].classes
    counts = {k: sum(int(name[0]) == k for name in classes) for k in range(1, 6)}
    return spatial_sum(len(group.links), counts, None)[1]


def aligned_caption(group: AlignedGroup, language: Language) -> list[Rich]:
    """Return own mobility W and redundant constraints q = 0 of a group in its best scheme."""
    local, numbers = group.schemes[0].local, _aligned_numbers(group)
    whole: Rich = language.structure.aligned_whole.format(
        numbers=numbers, w=local, ways=0, local=local, q=0
    )
    return [line.replace(" ", NBSP) for line in whole.split("; ")]


def aligned_group(mechanism: Mechanism, group: AlignedGroup, language: Language) -> Iterator[Rich]:
    """Yield the best scheme of a group, the others, and those correct by count alone."""
    texts = language.structure
    best, *others = group.schemes
    numbers = _aligned_numbers(group)

    def scheme_text(scheme: AlignedScheme) -> Rich:
        named = texts["pair_classes"]
        changed = [
            (*_pair_text(mechanism, pair), name)
            for pair, name in zip(group.pairs, scheme.classes, strict=True)
            if name != pair.classes[0]
        ]
        text = ", ".join(
            f"{point}{NBSP}({links}){NBSP}– {named[name]}" for point, links, name in changed
        )
        return text or texts.aligned_unchanged.format()

    links = "–".join(group.links)
    yield texts.aligned_group.format(
        links=links, scheme=scheme_text(best), numbers=numbers.replace(" ", NBSP), w=best.local
    )
    if best.local:
        yield texts.aligned_local.format(local=best.local)
    if others:
        yield texts.aligned_others.format(
            schemes="; ".join(scheme_text(one) for one in others[:MAX_SCHEMES])
        )
    if not best.steady:
        yield texts.aligned_loose.format()
    if group.counted:
        wrong = max(group.counted, key=lambda one: "3s" in one.classes and "3pl" not in one.classes)
        yield texts.aligned_counted.format(scheme=scheme_text(wrong), loose=wrong.loose)


# Groups --------------------------------------------------------------------------------------


def driver_caption(mechanism: Mechanism, driver: str, language: Language) -> list[Rich]:
    """Return name, mobility and redundant constraints of a driver (первичный механизм)."""
    ends = {FRAME, driver}
    kind = next(pair.kind for pair in pairs(mechanism) if set(pair.links) == ends)
    texts = language.structure
    links = _listed(mechanism.frame, driver)
    named = texts.primary.format(kind=texts["pair_kinds"][kind.value], links=links)
    return [named, *_counts(1, 1, 1)]


def group_caption(group: AssurGroup, language: Language) -> list[Rich]:
    """Return class, order, kind, mobility and redundant constraints of a group."""
    if group.is_toothed or group.is_passive:
        return [group_title(group, language.note)]
    count = len(group.legs) + sum(len(_inside(joint, group)) - 1 for joint in group.inner)
    texts, kind = (
        language.structure,
        language.structure["group_leads"].get(str(len(group.legs)), ""),
    )
    if group.kind is not None:
        signature = local_letters(group.signature, language.note)
        kind = texts.group_kind.format(kind=group.kind, letters=signature)
    named = texts.group.format(
        roman=roman(group.class_number), order=group.order, kind=kind, links=_listed(*group.links)
    )
    return [named, *_counts(0, len(group.links), count)]


def _counts(drivers: int, n: int, p: int) -> list[Rich]:
    """Return own mobility W and redundant constraints q of a part, for a number of drivers."""
    meshes = 3 * n - 2 * p - drivers  # a group has no mobility: meshes take the rest
    high, across = (f" − {meshes}", f" − 2·{meshes}") if meshes else ("", "")
    q = drivers - (6 * n - 5 * p - 2 * meshes)
    lines = (
        f"W = 3·{n} − 2·{p}{high} = {signed(drivers)}",
        f"q = {drivers} − (6·{n} − 5·{p}{across}) = {signed(q)}",
    )
    return [line.replace(" ", NBSP) for line in lines]


def _listed(*links: str) -> str:
    return f",{NBSP}".join(links)


def joints_text(mechanism: Mechanism, group: AssurGroup, language: Language) -> Rich:
    """Return the outer and the inner pairs of a group."""
    outer, inner = group_joints(mechanism, group, language.note)
    if not inner:
        held = (
            [f"{pair_letters(group.mesh)} ({language.note['letters']['Z']})"] if group.mesh else []
        )
        alone: Rich = language.structure["joints"]["outer"]
        return alone.format(outer=", ".join([*outer, *held]))
    template: Rich = language.structure["joints"]["one" if len(inner) == 1 else "many"]
    return template.format(outer=", ".join(outer), inner=", ".join(inner))


def group_joints(
    mechanism: Mechanism, group: AssurGroup, texts: MessageTable
) -> tuple[list[Rich], list[Rich]]:
    """Return the outer and the inner pairs of a group, each by point, kind and links."""
    called = mechanism.called
    outer = [_joint(lead.joint, (called(lead.to), lead.link), texts) for lead in group.legs]
    inner = [_joint(joint, _inside(joint, group), texts) for joint in group.inner]
    return outer, inner


def _joint(joint: Joint, links: Sequence[str], texts: MessageTable) -> Rich:
    """Return a pair by its point, the letter of its kind and its links: ``B (В, 1–2)``."""
    point = joint.point if isinstance(joint, Revolute) else joint.pin
    return f"{pair_letters(point)} ({texts['letters'][letter_of(joint)]}, {'–'.join(links)})"


def _inside(joint: Joint, group: AssurGroup) -> list[str]:
    return [link for link in group.links if link in links_of(joint)]


def local_letters(signature: str, texts: MessageTable) -> str:
    """Return a signature in the letters of a language: RPR is ВПВ in Russian."""
    return "".join(texts["letters"].get(letter, letter) for letter in signature)


def group_title(group: AssurGroup, texts: MessageTable) -> Rich:
    """Return a group's heading: links, letters, class, order and kind."""
    links = "–".join(group.links)
    if group.is_toothed:
        return texts.wheel_group.format(links=links)
    if group.is_passive:
        return texts.passive_group.format(links=links)
    if group.kind is None:
        return texts.higher_group.format(
            links=links, roman=roman(group.class_number), order=group.order
        )
    letters = local_letters(group.signature, texts)
    return texts.group.format(links=links, letters=letters, kind=group.kind)


def links_of_group(group: AssurGroup, texts: MessageTable) -> Rich:
    """Return a group by its links alone: ``Группа 4–5``."""
    return texts.plain_group.format(links="–".join(group.links))
