"""The still part of a cabinet: construction, base, legs, panels, top and frame."""
