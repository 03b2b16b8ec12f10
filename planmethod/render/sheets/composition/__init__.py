"""How the files of compositions (компоновка) are read; the records are in `sheets.model`."""
