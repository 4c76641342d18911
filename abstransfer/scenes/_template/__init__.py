"""A scene to copy; README.md, one folder up, says how."""
