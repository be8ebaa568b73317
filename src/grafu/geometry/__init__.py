"""Numbers only: arrays in, arrays out. No files, no labels, no furniture."""
