"""Problem files: reading, checking, variants, and templates for new ones."""

from planmethod.problem.model import Problem
from planmethod.problem.reader import load, load_each, loads, variant_names
from planmethod.problem.tasks import FAMILIES, OTHER_FAMILIES, schema_text, template

__all__ = [
    "FAMILIES",
    "OTHER_FAMILIES",
    "Problem",
    "load",
    "load_each",
    "loads",
    "schema_text",
    "template",
    "variant_names",
]
