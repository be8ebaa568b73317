"""Frames of doors that are drawn without one."""
