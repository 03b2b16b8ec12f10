"""Benchmarks that are not part of the package: peers, hard cases, random mechanisms."""
