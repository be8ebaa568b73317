"""Interiors: the compartments of storage furniture, and the shelves and dividers that furnish them."""
