"""Doors and windows of buildings: specimens for tests; no family of the generator makes them."""
