"""Joints: initial motions become real hinges and rails, with axes and limits that hold.

It knows neither where a motion came from nor any file format, and adds no parts.
"""
