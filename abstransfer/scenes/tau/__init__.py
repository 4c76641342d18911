"""The scene of page 8."""
