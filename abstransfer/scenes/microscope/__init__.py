"""The scene of page 3."""
