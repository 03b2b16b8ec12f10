"""Tools that make files of the package, by hand; beside it, not in the wheel."""
