"""Cuts a compartment behind each door and drawer of a body that is drawn solid: what opens must open onto something.

Walls as thick as boards are left around it; two doors side by side share one, each drawer has its own. A watertight
mesh stays so. One that is not is opened behind the front, and the compartment is lined in the body's own material.
"""

from collections.abc import Sequence
from dataclasses import replace
from itertools import groupby

import numpy as np

from grafu.additions.closed_scene import closed_scene
from grafu.additions.compartment.config import SolidBodyConfig
from grafu.additions.compartment.solid import SolidBehind, solids_behind
from grafu.additions.likeness import surface_like
from grafu.additions.step import (
    Changes,
    CutCompartment,
    Deficiency,
    DeficiencyKind,
    StepRequest,
    StepResult,
)
from grafu.asset.part import Part
from grafu.geometry.config_checks import at_scale
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.solids import ConvexSolid, clip, subtract
from grafu.scene.scene import Scene

_LINING = np.array(
    [(2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 7, 3), (1, 5, 7), (0, 1, 3), (0, 3, 2), (4, 7, 5), (4, 6, 7)]
)
"""All faces of a box but the nearest, looking inwards, by the numbers of `Box.corners`."""


def cut_compartments(scene: Scene, request: StepRequest, config: SolidBodyConfig | None) -> StepResult:
    """Returns the scene with a compartment behind each front; without a config it is only said what lacks one."""
    sizes = at_scale(config or SolidBodyConfig(), scene.metre)
    found = sorted(solids_behind(closed_scene(scene, request.plan, request.drawers), sizes), key=lambda s: s.part)
    groups = {name: tuple(group) for name, group in groupby(found, key=lambda s: s.part)}
    lacking = tuple(
        Deficiency(DeficiencyKind.COMPARTMENT, front, f"{name} is drawn solid behind it")
        for name, group in groups.items()
        for solid in group
        for front in solid.fronts
    )
    if config is None:
        return StepResult(scene, deficiencies=lacking)
    cut = tuple(
        CutCompartment(_opened(scene.parts[name], group), tuple(s.fronts for s in group))
        for name, group in groups.items()
    )
    return StepResult(scene.replaced([c.part for c in cut]), changes=Changes(compartments=cut), deficiencies=lacking)


def _opened(part: Part, solids: Sequence[SolidBehind]) -> Part:
    """Returns a part with the compartments cut into it."""
    blocks = [block for s in solids if (block := ConvexSolid.around(s.cut())) is not None]
    if len(part.surfaces) == 1 and part.mesh.is_watertight:
        return replace(part, surfaces=(subtract(part.surfaces[0], blocks),))
    open_surfaces = tuple(clip(surface, blocks) for surface in part.surfaces)
    linings = tuple(surface_like(_lining(s), [part]) for s in solids)
    return replace(part, surfaces=(*(s for s in open_surfaces if len(s.mesh.faces)), *linings))


def _lining(solid: SolidBehind) -> TriangleMesh:
    """Returns the walls of a compartment but its front, seen from within."""
    return TriangleMesh(solid.corners(), _LINING)
