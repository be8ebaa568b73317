"""Runs over datasets: one table for each of the paper's, for any method, on any data."""
