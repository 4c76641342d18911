"""The scene of page 10 that operates on notes."""
