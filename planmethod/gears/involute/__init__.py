"""Two wheels with involute teeth: sizes, limits, profiles, sheet (эвольвентное зацепление)."""
