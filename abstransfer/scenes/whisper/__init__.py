"""The scene of page 11: whispered advice."""
