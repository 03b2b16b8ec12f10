"""Writers of documents: a module for each format; none knows what a document is about."""
