"""Sheets: their contents and order; one module a sheet."""
