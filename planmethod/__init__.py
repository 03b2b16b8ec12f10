"""The graphical plan method of the theory of mechanisms."""
