"""The scene of page 2."""
