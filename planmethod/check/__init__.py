"""Checking of answers: keys, students' submissions, verdicts, mistakes, marks (проверка работ)."""
