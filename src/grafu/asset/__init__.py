"""Input assets: readers of part-segmented models, labels from names, the frame and scale.

It knows no motion but what the input itself annotates.
"""
