"""Welded models cut into parts, by geometry alone: shells, what is a front among them, and what belongs to which."""
