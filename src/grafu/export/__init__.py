"""Articulated objects and reports as files: one format per module, one function that writes."""
