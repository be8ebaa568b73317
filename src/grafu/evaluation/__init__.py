"""Runs over data sets: what each method makes of each model, measured, and the tables of it. It needs no torch."""
