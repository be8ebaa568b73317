"""Compartments cut into bodies that are drawn solid behind their doors and drawers."""
