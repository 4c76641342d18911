"""The scene of page 5."""
