"""Doors and windows of buildings."""
