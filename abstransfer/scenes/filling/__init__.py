"""The scene of page 9."""
