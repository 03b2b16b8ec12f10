"""Printed values of sources compared with exact and read values (проверка источников)."""
