"""Families of furniture: each draws a spec; `table` lists them all with their weights."""
