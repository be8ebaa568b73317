"""Synthetic furniture: parametric models with ground truth, for samples, tests and training. It touches no files."""
