"""What a hand opens doors and drawers by: grasps that are there, and handles that are added."""
