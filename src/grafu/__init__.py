"""Furniture that only looks right goes in; furniture that works comes out."""

from grafu.version import __version__ as __version__
