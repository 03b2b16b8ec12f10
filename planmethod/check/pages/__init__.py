"""What checking writes: the key, tables of results, a page for each student (ключ и листы)."""
