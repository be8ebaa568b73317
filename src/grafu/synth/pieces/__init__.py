"""Solids, surfaces and boards, and the asset that pieces make up."""
