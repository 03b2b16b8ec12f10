"""Tasks, answers and marks as learning management systems exchange them (обмен с СДО)."""
