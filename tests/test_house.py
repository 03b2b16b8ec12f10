"""The order of imports that the contracts of import-linter do not see."""

from __future__ import annotations

import ast
from graphlib import TopologicalSorter
from importlib import import_module
from pathlib import Path

import pytest

import planmethod


def test_the_public_names_are_those_that_type_checkers_see() -> None:
    tree = ast.parse(Path(planmethod.__file__).read_text("utf-8"))
    seen = next(node for node in tree.body if isinstance(node, ast.If))
    told = [one for one in ast.walk(seen) if isinstance(one, ast.ImportFrom)]
    public = {alias.asname: (one.module, alias.name) for one in told for alias in one.names}
    assert sorted(filter(None, public)) == planmethod.__all__
    for name, (module, inner) in public.items():
        assert getattr(planmethod, str(name)) is getattr(import_module(str(module)), inner)


def test_no_module_imports_itself_through_others() -> None:
    grimp = pytest.importorskip("grimp")  # comes with import-linter
    # Import-linter looks at siblings; a package and its own modules are seen here.
    graph = grimp.build_graph("planmethod", cache_dir=None)
    found = {module: graph.find_modules_directly_imported_by(module) for module in graph.modules}
    assert len(found) > 300
    TopologicalSorter(found).prepare()  # raises CycleError, with the circle
