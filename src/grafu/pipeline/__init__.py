"""From an asset to a working object and its report, as functions. It reads and writes no files."""
