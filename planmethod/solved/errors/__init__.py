"""How far what a hand draws may be off (погрешности построения)."""
