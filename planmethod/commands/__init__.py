"""Commands of the command line, a module for each: parse, call, print, exit code."""
