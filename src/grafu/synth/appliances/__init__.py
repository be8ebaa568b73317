"""Appliances for tests: bodies with doors, racks and trays in them, knobs and buttons on them. No family has them."""
