"""One result, changed: a hinge on the other side, a handle of another style, an added part removed."""

import grafu

result = grafu.functionalize("samples/wardrobe.glb", top="rounded")
door = "door_3"

changed = result.with_hinge(door, side="left", count=3).with_handle(door, "bar-slim")
for name, each in (("before", result), ("after", changed)):
    joint = each.joint(door)
    print(f"{name}: {door} turns about x = {joint.origin[0]:.2f} m on {joint.count} x {joint.template}")

still = changed.with_motion(door, "fixed")
print(f"stopped: {[joint.part for joint in still.joints]}")

for added in changed.added:
    print(f"added: {added.part} ({added.category}, {added.style}), for {added.why}")
changed.save("results/changed", overwrite=True)
