"""Plans that were drawn in a CAD program, measured as works (чертёж измеряется)."""
