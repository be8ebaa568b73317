"""Recessed grips: grooves, notches and finger holes carved into doors and drawer fronts.

Built on the final scene: what is taken away changes no motion and brings no collision.
"""
