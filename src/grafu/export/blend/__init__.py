"""Blender: an articulated object as a `.blend` file, and as objects in a running Blender.

`exporter` is what everybody may import; `objects`, `materials` and `worker` import `bpy`, and only run where it is.
"""
