"""Checking of answers: keys, works of students, verdicts, mistakes, marks (проверка работ)."""
