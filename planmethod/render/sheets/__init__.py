"""Sheets: what is on each and in which order; one module a sheet."""
