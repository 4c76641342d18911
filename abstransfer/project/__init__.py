"""A race in a building of one's own, and a card to hand in."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach(
    __name__,
    submod_attrs={
        "racing": ["Race", "race"],
        "setup": ["Setup", "drives", "run"],
        "prediction": ["Prediction"],
        "card": ["card_text", "verify"],
        "student": ["building_of", "seed_of"],
    },
)
