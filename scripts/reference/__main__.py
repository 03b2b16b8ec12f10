"""Write the schema, in both languages, and the generated pages."""

from __future__ import annotations

from scripts.reference import pages, schema


def main() -> None:
    """Write the files; pages last, since they read the schema."""
    schema.SCHEMA.write_text(schema.schema_text(), "utf-8")
    schema.RUSSIAN_SCHEMA.write_text(schema.russian_schema_text(), "utf-8")
    for path, text in pages.texts():
        path.write_text(text, "utf-8")


if __name__ == "__main__":
    main()
