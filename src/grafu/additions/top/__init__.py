"""Tops: whether furniture lacks one, judged from above, and the slab that closes it."""
