"""Judges of what was made of furniture: they read meshes and motions, and share no code with what makes them."""
