"""Rails: what a drawer runs on, where it is mounted, and what supports it."""
