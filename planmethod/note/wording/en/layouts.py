"""Words of shipped layouts and ready problem files in English (компоновки по-английски)."""

from types import MappingProxyType

LAYOUTS = MappingProxyType(
    {
        "compact_head": "For a printer at home, up to five positions: several sheets of A4 in "
        "place of a large one. So planmethod sheet --compact draws.\n# What each key means: "
        "docs/layout.md.",
        "compact_about": "for a printer at home: sheets of A4 with the scheme, the velocity plan, "
        "the acceleration plan, the table",
        "compact_sizes": "no letters below 2.5 mm",
        "coursework_head": "Sheet of a course project: twelve positions on A1.\n# On the left the "
        "scheme in all positions, the statement and the equations; on the right the velocity\n# "
        "plans in two rows of six, below them the acceleration plans, the table over the title "
        "block.",
        "coursework_about": "course project: twelve positions on one A1 sheet",
        "coursework_scheme": "Position plans of the mechanism",
        "coursework_results": "Results by positions",
        "turn_head": "Sheet 1 of a coursework: the turn of the crank on A1. Positions are those of "
        "[cycle] (or its defaults).\n# The scheme in twelve positions with the extreme ones, "
        "velocity plans, chosen acceleration plans,\n# hodographs, diagrams of s, v and a, "
        "the table.",
        "turn_about": "sheet 1 of a coursework: the turn, position 0, twelve positions, diagrams, "
        "hodographs",
        "turn_title": "Kinematic analysis of the mechanism",
        "cycle_head": "Force analysis over the cycle: reactions and balancing moment in all "
        "positions.\n# The problem file needs [dynamics] and [[loads]], and several positions.",
        "cycle_about": "force analysis over the cycle: diagrams of reactions and balancing "
        "moment, polar diagrams, table by positions",
        "cycle_title": "Force analysis over the cycle",
        "flywheel_head": "Sheet 3 of a course work: the choice of the flywheel.\n# Needs [machine] "
        "in the problem file.",
        "flywheel_about": "flywheel: moments, work, inertia, energy-mass diagram, sizes",
        "flywheel_title": "Choice of the flywheel",
        "balancing_head": "Static balancing by counterweights.\n# Needs [balancing] and masses in "
        "[dynamics] of the problem file.",
        "balancing_about": "balancing: the mechanism with counterweights, polygons of m·r, "
        "hodographs of inertia before and after, tables",
        "balancing_title": "Balancing of the mechanism",
        "runup_head": "Run-up and stop of a machine with its flywheel.\n# Needs motor or brake in "
        "[machine] of the problem file.",
        "runup_about": "run-up and stop: the motor, angular velocity over time and angle, tables",
        "runup_title": "Run-up and stop of the machine",
        "forces_head": "Sheet 2 of a course work: forces in one position. Groups are cut free "
        "from the last to the first.\n# The problem file needs [dynamics] and [[loads]]; of "
        "several positions each has its sheet.",
        "forces_about": "force analysis: loads, groups and force plans, Zhukovsky lever, table of "
        "reactions; one position",
        "forces_title": "Force analysis of the mechanism",
        "forces_each": "These three blocks are drawn for every group and for the driving link.",
        "forces_reactions": "not narrower than the title block",
        "homework_head": "Sheet of a homework: one A2 sheet in the order of the textbook.\n# On "
        "the left the scheme and the statement, beside them the velocity plan with its equations, "
        "below\n# the acceleration plan with equations and calculation; the results over the "
        "title block.",
        "homework_about": "homework: one A2 sheet in the order of the textbook, one position",
        "homework_stamp": "title in the title block; without it that of the problem file",
        "homework_title": "Kinematic analysis of the mechanism",
        "homework_scheme": "Scheme of the mechanism",
        "homework_results": "Table of results",
        "few_head": "A few positions, up to five: plans of each in a row, the calculation of one. "
        "So planmethod sheet draws a homework.\n# What each key means: docs/layout.md.",
        "few_about": "two to five positions: scheme, equations, plans of each, calculation of one",
        "many_head": "Many positions: up to twelve on a sheet. So planmethod sheet draws several "
        "positions.\n# What each key means: docs/layout.md.",
        "many_about": "many positions: scheme, equations, rows of plans, calculation of one, table",
        "many_sizes": "Without [sizes] the letters are as high as in the layout one-position.",
        "many_scheme": "all positions thin, one of them in full",
        "one_head": "One position: everything on one sheet. So planmethod sheet draws when no "
        "layout is named.\n# What each key means: docs/layout.md. A layout of your own: "
        "planmethod layouts one-position my.toml,\n# edit it, then planmethod sheet --layout "
        "my.toml PROBLEM.toml.",
        "one_about": "one position: scheme and statement, plans with equations and calculation, "
        "table of results",
        "one_formats": "in this order, until all fits; --paper outranks it",
        "one_per_sheet": "positions on a sheet, if there are several",
        "one_grow": "true: draw the plans larger where the sheet has room",
        "one_sizes": "Height of the letters, mm (GOST 2.304: 2.5, 3.5, 5, 7, 10...), and the "
        "width that texts are set to.\n# letter: letters on scheme and plans; title: names of the "
        "views; text: everything else.",
        "one_blocks": "Blocks in the order in which they are read. Blocks of one group stand "
        "together.",
        "one_statement": "what is given and what to find",
        "one_height": "smaller where it does not fit otherwise",
        "one_droppable": "and left out where there is no room",
        "one_results": "the last block stands over the title block",
        "one_width": "no wider than this part of the sheet",
    }
)
"""By the places of the files in `planmethod.render.sheets.compositions`."""

FAMILIES = MappingProxyType(
    {
        "slider-crank": "slider-crank mechanism",
        "four-bar": "four-bar linkage",
        "slotted-link": "slotted-link mechanism with a rotating slotted link",
        "swinging-block": "mechanism with a swinging cylinder (stone)",
        "sine": "sine mechanism (Scotch yoke)",
        "six-link": "six-link mechanism with a slotted link and a slider",
        "driving-slider": "mechanism with a driving slider",
        "RRR+RRP": "four-bar linkage with a rod and a slider",
        "RRP+RPR": "slider-crank mechanism with a rocking slotted link",
        "RRP+PRP": "slider-crank mechanism with a stone on the rod and a second slider",
        "RPR+RPP": "slotted-link mechanism with a translating link 5",
        "RRR+RPR": "four-bar linkage with a swinging block",
        "RRR+RRR": "six-bar linkage of revolute joints",
        "moving-guide": "mechanism with a guide on a moving link",
        "shaper": "shaper mechanism",
        "whitworth": "Whitworth mechanism with a slotted link that turns round",
        "toggle-press": "toggle press",
        "v-engine": "V engine",
        "oscillating-cylinder": "engine with an oscillating cylinder",
        "pantograph": "pantograph",
        "watt": "Watt six-bar linkage",
        "stephenson": "Stephenson six-bar linkage",
        "ordinary-train": "gear train with fixed axes",
        "planetary-train": "planetary gear train",
        "differential-train": "differential gear train",
        "moving-point": "motion of a point",
    }
)

TASKS = MappingProxyType(
    {
        "linkage": "Linkages without groups",
        "gears": "Gear trains",
        "meshing": "Wheels in mesh",
        "point": "A moving point",
        "none": "No such task. All of them: `planmethod tasks`.",
    }
)
"""Of the list of shipped tasks: kinds of problem that have no groups, and that there is none."""
