"""Words and tables: what a solution says, in Russian and English, and its plain record."""
