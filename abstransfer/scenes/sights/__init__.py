"""What a robot sees, and what advice makes of it."""
