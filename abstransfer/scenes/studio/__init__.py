"""The scene of page 1."""
