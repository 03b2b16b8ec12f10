"""Pictures of a mechanism and of its plans (изображения)."""
