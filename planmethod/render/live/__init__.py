"""A mechanism that moves in a browser: one file without a server (живая страница)."""
