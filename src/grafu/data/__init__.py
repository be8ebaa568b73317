"""Training pairs, corruption, and data sets on disk."""
