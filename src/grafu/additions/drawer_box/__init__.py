"""The boxes behind drawer fronts: what a drawer lacks of one, and boards that make it whole."""
