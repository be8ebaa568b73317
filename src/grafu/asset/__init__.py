"""Input assets: readers of part-segmented models, labels from names, the frame and scale."""
