"""The three builders of an abstract policy."""
