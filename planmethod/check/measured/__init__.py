"""Plans drawn in a CAD program, measured as submissions (чертёж измеряется)."""
