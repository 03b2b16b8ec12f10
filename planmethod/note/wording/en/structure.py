"""Words of the structural sheet in English (структурный лист по-английски)."""

from planmethod.note.wording.sheet_model import StructureWording

STRUCTURE = StructureWording(
    title="Structural analysis of the mechanism",
    scheme="Structural scheme of the mechanism",
    parts="Primary mechanism and structural groups",
    pairs="Kinematic pairs",
    links="Links of the mechanism",
    formulas="Structural formulas",
    columns_pairs=("Pair", "Links", "Kind of pair", "Class", "Mobility"),
    columns_links=("Link", "Name", "Motion", "Pairs"),
    pair_kinds={
        "revolute": "revolute",
        "prismatic": "prismatic",
    },
    motions={
        "fixed": "fixed",
        "rotation": "rotation",
        "translation": "translation",
        "plane": "plane motion",
    },
    counts="n\u00a0=\u00a0{n}; p_{{1}}\u00a0=\u00a0{low} (revolute\u00a0{revolute}, "
    "prismatic\u00a0{prismatic}); p_{{2}}\u00a0=\u00a0{high}",
    chebyshev="Chebyshev: W = 3n − 2p_{{1}} − p_{{2}} = 3·{n} − 2·{low} − {high} = {w}",
    spatial="Spatial scheme: W_{{sp}} = 6n − 5p_{{1}} = 6·{n} − 5·{low} = {w}",
    redundant="Redundant constraints: q = W_{{0}} + W_{{loc}} − W_{{sp}} = {ways} + {local} − {w} "
    "= {q}",
    formula="Structural formula: {order}",
    mechanism_class="Class of the mechanism: {roman}",
    kinematic_order="Order of the kinematic analysis: {order}",
    force_order="Order of the force analysis: {order}",
    primary="Primary mechanism, class\u00a0I ({kind} pair): links\u00a0{links}",
    group="Group of class\u00a0{roman}, order\u00a0{order}{kind}: links\u00a0{links}",
    group_kind=", kind\u00a0{kind} ({letters})",
    group_leads={
        2: " (two leads)",
        3: " (three leads)",
        4: " (four leads)",
        5: " (five leads)",
        6: " (six leads)",
    },
)
