"""Appliances: bodies with doors, racks and trays in them, knobs and buttons on them."""
