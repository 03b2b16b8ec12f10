"""What is drawn of gear trains: views of the scheme, pictures of velocities, the sheet (чертежи)."""
