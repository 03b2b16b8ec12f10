"""Tools run by hand that generate files of the package; they are not in the wheel."""
