"""The studio: one page in a browser that does what the commands do, and its server (студия).

It has no geometry and no algorithms of its own: all computations are made by the function that it
is given, in separate processes with limits.
"""
