"""Additions: parts that the input lacks (tops, boards, drawer boxes, handles, grips, interiors) are made.

It moves nothing: joints stand, or will stand, by other rules.
"""
