"""GLBs whose meshes are compressed by Draco: smaller files with the same scene, for readers that know the extension."""

from dataclasses import replace

from grafu.articulation.articulated_object import ArticulatedObject
from grafu.export.files import ExportFiles
from grafu.export.glb import DEFAULT_GLB_CONFIG, GlbConfig, export_glb, export_merged_glb
from grafu.export.gltf_packing import DEFAULT_DRACO_CONFIG, require_draco


def export_draco_glb(articulated: ArticulatedObject, config: GlbConfig = DEFAULT_GLB_CONFIG) -> ExportFiles:
    """Returns `model_draco.glb`: what `export_glb` returns, with compressed meshes.

    Raises:
        ExportError: if DracoPy is not installed, or the file would exceed the 4 GiB of the format.
    """
    made = export_glb(articulated, _compressing(config))
    return ExportFiles({"model_draco.glb": made["model.glb"]}, notes=made.notes)


def export_merged_draco_glb(articulated: ArticulatedObject, config: GlbConfig = DEFAULT_GLB_CONFIG) -> ExportFiles:
    """Returns `model_merged_draco.glb`: what `export_merged_glb` returns, with compressed meshes.

    Raises:
        ExportError: if DracoPy is not installed, or the file would exceed the 4 GiB of the format.
    """
    made = export_merged_glb(articulated, _compressing(config))
    return ExportFiles({"model_merged_draco.glb": made["model_merged.glb"]}, notes=made.notes)


def _compressing(config: GlbConfig) -> GlbConfig:
    require_draco()
    return replace(config, draco=config.draco or DEFAULT_DRACO_CONFIG)
