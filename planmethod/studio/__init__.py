"""The studio: one page in a browser that does what the commands do, and its server (студия).

It has no geometry and no second way to anything: what is computed is computed by what it is given
to act with, in processes of their own with limits.
"""
