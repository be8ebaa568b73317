"""Pictures without a window, a GPU or Blender: furniture, functional graphs, galleries of templates."""
