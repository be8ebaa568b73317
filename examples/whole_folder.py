"""Many models: what moves in each, and what is wrong with those that cannot be read."""

from pathlib import Path

import grafu

for path in sorted(Path("samples").glob("*.glb")):
    try:
        result = grafu.functionalize(path, interior="none")
    except grafu.FunctionalizationError as error:
        print(f"{path.name}: {error}")
        continue
    doors = sum(joint.type == "revolute" for joint in result.joints)
    drawers = len(result.joints) - doors
    print(f"{path.name}: {doors} doors, {drawers} drawers, {len(result.skipped)} skipped, {len(result.added)} added")
    result.save(Path("results") / "folder" / path.stem, formats="urdf", page=False, overwrite=True)
