"""The scene of page 11."""
