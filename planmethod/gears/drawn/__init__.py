"""What is drawn of gear trains: the scheme, pictures of velocities, the sheet (чертежи)."""
