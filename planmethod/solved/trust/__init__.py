"""How far float64 results can be trusted: conditioning, the referee (достоверность)."""
