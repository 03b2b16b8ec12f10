"""Words of the audit of sources in English (сверка источников по-английски)."""

from planmethod.note.wording.audit_model import AuditWording

AUDIT = AuditWording(
    title="Printed values of the sources",
    intro=(
        "What the sources print, beside the exact value and the value that follows from the "
        "segments read with a ruler of {ruler} mm divisions on plans drawn to the source's own "
        "scales. Written by `planmethod audit` from the `[published]` tables of the problem "
        "files; names and remarks are as they stand there.",
        "The difference is printed less exact: in the unit of the value, in percent of the exact "
        "value, and in millimetres of the plan. The millimetres of an ω or ε are those of the "
        "segment from which it follows; of an angle, those at the far end of its link, or of its "
        "force on the plan. Forces are read off force plans in the source's scale, or in the "
        "program's where the source tells none.",
        "- **agrees**: the exact value rounds to the printed digits;\n- **drawing**: no more than "
        "{limit} mm off, which is what careful drafting gives. A slip of the source too small to "
        "tell from drafting is here too, and its remark says so;\n- **differs**: more than that, "
        "or not drawn and not equal; the remark gives the reason.",
    ),
    problem="Problem",
    source="Source",
    values="Values",
    nothing="The source prints no values.",
    summary="{values} values: {agrees} agree, {drawn} within drafting, {differs} differ, {absent} "
    "not computed.",
    columns=(
        "Value",
        "Unit",
        "Printed",
        "Exact",
        "Ruler",
        "Difference",
        "%",
        "mm",
        "Verdict",
        "Remark",
    ),
    verdicts={
        "agrees": "agrees",
        "drawn": "drawing",
        "differs": "**differs**",
        "absent": "not computed",
    },
    counted={
        "agrees": "Agree",
        "drawn": "Within drafting",
        "differs": "Differ",
        "absent": "Not computed",
    },
    whys={
        "no what": "",
        "no position": "the driver has no such position in this file",
        "no scale": "the file does not tell the scale of the source's plan",
        "no point": "the plans have no such point",
        "no link": "no link joins these points",
        "no arm": "the point is on the axis of the crank, its arm is zero",
        "no sliding": "no sliding pair of these points",
        "zero divisor": "the divisor is zero",
        "no machine": "the file has no [machine]",
        "no forces": "the file has no masses and no loads",
        "no joint": "these links have no joint",
        "no direction": "the force is zero: it has no direction and no arm",
        "stands": "the driving link stands: there is no lever",
    },
    chain="From the printed flywheel to the exact one, one cause of error less at each step. "
    "Constructions integrate by trapezoids.",
    chain_columns=("J_f, kg·m²", "change, %", "what is taken", "what is put right"),
    chain_steps={
        "printed": ("the printed KL and the formula", ""),
        "tables": ("the printed tables of M and J, tangents 1 ± δ", "KL is not that of its tables"),
        "inertia": ("the printed table of M, exact J", "errors of the table of kinetic energies"),
        "moments": (
            "exact M with the source's signs, exact J, ω and δ not rounded",
            "velocities of the plans, rounding",
        ),
        "signs": ("the same with true signs", "the sign with which weights are added"),
        "positions": ("the same by twice as many positions", "few positions"),
        "curve": ("the whole curves", "still few positions"),
        "exact": ("the whole curves, tangents (1 ± δ/2)²", "slopes 1 ± δ are approximate"),
    },
)
