"""Baselines that ask a language model: for a completed graph, or for a list of edits. None of its output is run."""
