"""Baselines that run an installed copy of another system on each model and read what it wrote."""
