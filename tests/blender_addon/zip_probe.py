"""Installs the built extension as Preferences do, in a profile of its own, and uses it. It asserts nothing.

Started as `python zip_probe.py ZIP SAMPLE FOLDER` by a Python that has `bpy` and numpy and nothing else, with
BLENDER_USER_RESOURCES naming an empty folder.
"""

import sys

import bpy
from probe_end import carry_out

built, sample, out = sys.argv[1:4]
FACTS = {}


def main():
    for one in list(bpy.data.objects):
        bpy.data.objects.remove(one)
    install = bpy.ops.extensions.package_install_files
    FACTS["installed"] = list(install(filepath=built, repo="user_default", enable_on_install=True))
    FACTS["enabled"] = "bl_ext.user_default.grafu" in bpy.context.preferences.addons
    bpy.ops.import_scene.gltf(filepath=sample)
    for one in bpy.data.objects:
        one.select_set(one.type == "MESH")
    FACTS["ran"] = list(bpy.ops.grafu.functionalize())
    session = bpy.context.scene.grafu
    FACTS["status"], FACTS["joints"] = session.status, [row.level for row in session.joints]
    final = {"directory": out, "name": "final", "formats": {"glb", "urdf", "mjcf", "blend"}}
    FACTS["with usd"] = list(bpy.ops.grafu.finalize("EXEC_DEFAULT", **{**final, "formats": {"usd", "usdz"}}))
    FACTS["of usd"] = session.status
    final["overwrite"] = True
    FACTS["finalized"] = list(bpy.ops.grafu.finalize("EXEC_DEFAULT", **final))
    FACTS["said"] = session.status
    import grafu

    FACTS["package"], FACTS["torch"] = grafu.__file__, "torch" in sys.modules


carry_out(main, out, FACTS)
