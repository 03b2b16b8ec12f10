"""Results for machines: JSON, CSV, NPZ (записи)."""
