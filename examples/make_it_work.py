"""One model in, one folder out, and its joints and hardware printed."""

from math import degrees

import grafu

result = grafu.functionalize("samples/sideboard.glb")
print(result)
for joint in result.joints:
    opening = f"{degrees(joint.upper):.0f} degrees" if joint.type == "revolute" else f"{joint.upper:.2f} m"
    print(f"{joint.part}: {joint.type}, {joint.count} x {joint.template}, opens {opening}")
for skipped in result.skipped:
    print(f"{skipped.request}: skipped, {skipped.reason}")

folder = result.save("results/sideboard", formats=["glb", "urdf"], overwrite=True)
print(f"look at {folder / 'report.html'}")
