"""Accuracy of float64 results: conditioning and the multiprecision check (достоверность)."""
