"""Clearance for parts that interpenetrate at rest or in motion: attached, trimmed, shrunk or carved, and recorded."""
