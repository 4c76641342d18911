"""The scene of page 4."""
