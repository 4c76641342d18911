"""Running and marking what a class hands in: ``abstransfer class``."""
