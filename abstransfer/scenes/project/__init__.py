"""The scene of page 12."""
