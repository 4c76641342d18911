"""The scene of page 10."""
