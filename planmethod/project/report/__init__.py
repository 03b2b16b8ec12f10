"""The explanatory note of a project or of one homework, as a document (пояснительная записка)."""

from planmethod.project.report.note import note_document

__all__ = ["note_document"]
