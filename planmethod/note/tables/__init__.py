"""Tables of results for a terminal (таблицы результатов)."""
