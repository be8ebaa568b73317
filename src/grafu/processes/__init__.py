"""Processes and what they may do: limits, signals, ends, privacy, results that are kept."""
