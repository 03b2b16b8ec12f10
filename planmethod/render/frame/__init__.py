"""Frame and title block of a sheet (рамка и основная надпись)."""
