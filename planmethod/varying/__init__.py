"""Generated variants of a task: numbers varied, evaluated, chosen (варианты задания)."""
