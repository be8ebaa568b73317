"""`functionalize`: the paper's figure as one function. It reads and writes no files."""
