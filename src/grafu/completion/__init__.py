"""Completes a functional graph: which joint each door and drawer has, from rules of geometry and habit. No torch."""
