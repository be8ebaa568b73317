"""Joints: initial motions become real hinges and rails, with axes and limits that hold."""
