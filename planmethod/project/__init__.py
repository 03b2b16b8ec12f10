"""The course project (курсовой проект): the decisions made once for all its documents."""
