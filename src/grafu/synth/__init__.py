"""Furniture made by rules, for samples, tests and training."""
