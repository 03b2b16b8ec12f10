"""What strangers may send, made in masses from a seed, and every door of the program with it."""
