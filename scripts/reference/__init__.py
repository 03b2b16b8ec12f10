"""The pages of the reference that follow from the program, and the schema: ``make reference``.

Each module returns the text of its pages in a language; `PAGES` of `scripts.reference.pages` lists
them. What the program does not declare is data beside the modules: introductions and the words of
the tables (``texts.toml``), sentences of keys (``keys.en.toml``, ``keys.ru.toml``), terms
(``glossary.toml``).
"""
