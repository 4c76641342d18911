"""The scene of page 6."""
