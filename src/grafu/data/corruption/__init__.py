"""Inputs made from functional graphs by taking things away (supplement, Data Augmentation)."""
