"""Output of checking: the key, tables of results, a page for each student (ключ и листы)."""
