"""Questions for the defence of a student's own work, with answers and places on its sheets."""
