"""The order of imports that the contracts of import-linter do not see."""

from __future__ import annotations

import ast
from collections import defaultdict
from collections.abc import Iterator
from functools import cache
from graphlib import TopologicalSorter
from importlib import import_module
from typing import NamedTuple

from worked import ROOT

import planmethod

FILES = {
    ".".join(path.relative_to(ROOT).with_suffix("").parts).removesuffix(".__init__"): path
    for path in sorted((ROOT / "planmethod").rglob("*.py"))
}

LATE_IN = (
    "planmethod.__main__",
    "planmethod.arguments",  # trains and structures need no NumPy
    "planmethod.cams.kind",
    "planmethod.commands.",
    "planmethod.gears.kind",
    "planmethod.gears.involute.kind",
    "planmethod.kinds",
    "planmethod.moving.kind",
    "planmethod.options",
    "planmethod.render.backends",
    "planmethod.render.sheets.blocks",
)
"""Where imports stand in functions: of a command, a kind, a format or a block, used when it is; of
the launcher, which is to know of Ctrl+C first."""

LATE_OF = {
    "ezdxf": "drawings as DXF",
    # Only problems with loads have forces, only some ask for the drafting errors.
    "planmethod.solved.selectors.forces": "forces",
    "planmethod.solved.forces.statics": "forces",
    "planmethod.note.narrate.forces": "forces",
    "planmethod.note.audit": "printed values",
    "planmethod.note.tables.causes": "drafting errors",
    "planmethod.note.tables.forces": "forces",
    "planmethod.note.tables.friction": "friction",
    "planmethod.gears.audit": "printed values of gear trains",
    "planmethod.gears.angles": "wheels with shifts",
    "planmethod.gears.choice": "teeth to be chosen",
    "planmethod.gears.drawn": "pens, for the sheets of gear trains alone",
    "planmethod.gears.figures": "answers of students",
    "planmethod.moving.figures": "answers of students",
    "planmethod.gears.protocol": "the construction of pictures",
    "planmethod.note.audit.machine": "machines",
    "planmethod.note.records.balancing": "counterweights",
    "planmethod.note.records.machine": "machines",
    "planmethod.note.tables.balancing": "counterweights",
    "planmethod.note.tables.machine": "machines",
    "planmethod.note.tables.turn": "the turn of a crank",
    "planmethod.problem.dynamics": "forces, counterweights",
    "planmethod.problem.higher": "higher pairs",
    "planmethod.problem.machine": "machines",
    "planmethod.solved": "forces, drafting errors, the trust in float64",
    "planmethod.compiled.csource": "machine code",
    "planmethod.compiled.native": "machine code",
    "planmethod.construct.drafting": "the hand",
    "planmethod.moving.audit": "printed values",
    "planmethod.moving.protocol": "what is drawn",
    "planmethod.moving.sheet": "what is drawn",
    "planmethod.note.wording": "words of drafting errors",
    "planmethod.render.backends.output": "why nothing can be written",
    "planmethod.gears.involute.sheet": "the sheet of a meshing, what solves it has no pens",
    # Third parties that take long to import; a mistake in a file is rare.
    "csv": "variants in a table",
    "decimal": "numbers that a file has as text",
    "difflib": "hints",
    "fcntl": "the lock of a server; some systems have none",
    "importlib.resources": "templates",
    "json": "messages that are not in English",
    "locale": "the language of a system without variables for it",
    "mpmath": "the referee",
    "openpyxl": "workbooks",
    "pkgutil": "public names",
    "resource": "limits of processes; some systems have none",
    "shapely": "areas",
    "tomllib": "descriptions of compositions",
}
"""What may be imported in a function elsewhere, and who needs it: not every run does."""


class Read(NamedTuple):
    """What is asked of a module, whose tree is large."""

    imports: frozenset[str]
    late: tuple[tuple[str, int], ...]
    classes: tuple[str, ...]


def statements(body: ast.AST, is_late: bool = False) -> Iterator[tuple[ast.AST, bool]]:
    """Yield all statements below a node, and whether they stand in a function."""
    for node in ast.iter_child_nodes(body):
        if isinstance(node, ast.stmt | ast.ExceptHandler | ast.match_case):
            yield node, is_late
            yield from statements(node, is_late or isinstance(node, ast.FunctionDef))


def imported(node: ast.AST) -> Iterator[str]:
    """Yield what a statement imports, names of a package as modules of it."""
    if isinstance(node, ast.Import):
        yield from (alias.name for alias in node.names)
    elif isinstance(node, ast.ImportFrom):
        assert node.module is not None and not node.level, "imports are absolute"
        for alias in node.names:
            inner = f"{node.module}.{alias.name}"
            yield inner if inner in FILES else node.module


def parsed(module: str) -> ast.Module:
    return ast.parse(FILES[module].read_text("utf-8"))


@cache
def read(module: str) -> Read:
    every, late, classes = set(), [], []
    for node, is_late in statements(parsed(module)):
        names = [*imported(node)]
        every.update(names)
        if names and is_late:
            late += [(name, node.lineno) for name in names]  # type: ignore[attr-defined]
        if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
            classes.append(node.name)
    return Read(frozenset(every), tuple(late), tuple(classes))


def test_an_import_in_a_function_is_of_what_few_runs_need() -> None:
    late = [
        f"{FILES[module].relative_to(ROOT)}:{line} imports {name}"
        for module in FILES
        if not module.startswith(LATE_IN)
        for name, line in read(module).late
        if not any(f"{name}.".startswith(f"{known}.") for known in LATE_OF)
    ]
    assert not late, "put these at the head of the file, or say in LATE_OF who alone needs them"


def test_the_public_names_are_those_that_type_checkers_see() -> None:
    seen = next(node for node in parsed("planmethod").body if isinstance(node, ast.If))
    told = [one for one in ast.walk(seen) if isinstance(one, ast.ImportFrom)]
    public = {alias.asname: (one.module, alias.name) for one in told for alias in one.names}
    assert sorted([*filter(None, public), "solve"]) == planmethod.__all__
    for name, (module, inner) in public.items():
        assert getattr(planmethod, str(name)) is getattr(import_module(str(module)), inner)


def test_no_module_imports_itself_through_others() -> None:
    # Import-linter looks at siblings; a package and its own modules are seen here.
    graph = {module: {name for name in read(module).imports if name in FILES} for module in FILES}
    TopologicalSorter(graph).prepare()  # raises CycleError, with the circle


def test_a_public_class_name_stands_in_one_module_only() -> None:
    homes: defaultdict[str, list[str]] = defaultdict(list)
    for module in FILES:
        for name in read(module).classes:
            homes[name].append(module)
    shared = {name: modules for name, modules in homes.items() if len(modules) > 1}
    assert not shared, "give each a name that says what it is of, as BlockKind beside ProblemKind"
