"""The command `grafu`: one verb per file."""
