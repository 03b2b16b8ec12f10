"""Reading of composition files (компоновка); the records are in `sheets.model`."""
