"""Words of the choice of teeth in English (подбор чисел зубьев по-английски)."""

from planmethod.note.wording.gear_model import TeethWording

TEETH = TeethWording(
    title="Choice of teeth: {scheme}",
    schemes={
        "ring": "planetary, one row, 1-2 external, 2-3 internal, 3 fixed; U_1H = 1 + z_3/z_1",
        "external-internal": "planetary, two rows, 1-2 external, 2'-3 internal, 3 fixed; "
        "U_1H = 1 + z_2·z_3/(z_1·z_2')",
        "two-external": "planetary, two rows, both external, 3 fixed; "
        "U_H1 = 1/(1 − z_2·z_3/(z_1·z_2'))",
        "two-internal": "planetary, two rows, both internal, 3 fixed; "
        "U_H1 = 1/(1 − z_2·z_3/(z_1·z_2'))",
        "pair": "a pair of wheels, external; U_12 = −z_2/z_1",
        "two-stage": "two coaxial stages, both external; U_13 = z_2·z_3/(z_1·z_2')",
    },
    wanted="Given: U = {ratio}, off by at most {within} %{satellites}{modules}.",
    satellites=", satellites k = {k}",
    modules=", modules of the rows {first} and {second} mm",
    bounds="Bounds: z from {least} to {most}{rings}. All combinations looked at: {looked}.",
    rings=", wheels with internal teeth up to {ring_most}",
    conditions="Conditions: coaxiality, no interference of teeth (inside z_3 − z_2 at least "
    "{difference}){carried}.",
    carried=", assembly, neighbourhood",
    found="Sets found: {found}. The first {shown}, by size D/m, then by error of U:",
    none="No combination fits. Widen the bounds (--z-max, --ring-max) or the error (--within), "
    "change the number of satellites or the scheme; the sign of U is that of its formula.",
    columns=("No", "U", "fraction", "error, %", "D/m"),
    file="Chosen train, set {number}",
)
