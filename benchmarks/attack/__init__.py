"""Hostile input, generated in bulk from a seed, for every entry point of the program."""
