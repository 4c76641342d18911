"""This one paper: its claims, all experiments of the book, verdicts, figures."""
