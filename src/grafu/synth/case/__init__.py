"""The still part of a cabinet: construction, base, legs, panels, top and frame. It knows no fronts but their places."""
