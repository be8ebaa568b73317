"""Furniture that is a case with fronts: cabinets, chests, bureaus, corner cabinets, racks, ensembles."""
