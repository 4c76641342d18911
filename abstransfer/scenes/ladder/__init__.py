"""The scene of page 7."""
