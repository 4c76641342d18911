"""The scene of page 0."""
