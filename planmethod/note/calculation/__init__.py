"""A calculation as data: given values and formulas in letters (расчёт в буквах)."""
