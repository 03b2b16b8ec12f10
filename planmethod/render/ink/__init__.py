"""Marks on the paper: display list, pens, lettering, typesetting (перо)."""
