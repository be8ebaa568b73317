"""Modelling noise: what people who model furniture leave out, join, cut, misname, bend and add."""
