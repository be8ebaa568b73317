"""Clearance for parts that interpenetrate at rest or on their way: joined, trimmed, eased or carved, and recorded."""
