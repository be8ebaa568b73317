"""Hinges: where a door may turn, which class fits, and the hardware that carries it."""
