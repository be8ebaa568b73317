"""Processes and what they may do: limits, signals, ends, privacy. It knows no furniture."""
