"""What a result is measured by: collision, connectivity, motion agreement. Pure functions."""
