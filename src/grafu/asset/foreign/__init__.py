"""Motions that other systems predicted: files read, parts matched with an asset's, joints attached to these."""
