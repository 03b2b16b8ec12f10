"""The course project (курсовой проект): what is decided once for all that is handed in."""
