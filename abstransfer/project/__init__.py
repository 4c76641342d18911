"""A race in a building of one's own, and a card to hand in."""
