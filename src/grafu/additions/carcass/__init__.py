"""The still body of storage furniture: backs and bottoms that are missing, and boards that close it."""
