"""What static functionalization found missing and made, as the judges of `grafu.judging` see it before and after.

Judges read meshes and motions alone. Two figures are the builder's own: which compartments there are, and how a moving
body can be grasped where it has no handle.
"""

from collections.abc import Sequence
from hashlib import sha256
from typing import final

import numpy as np

from grafu.additions.handle.grasp import find_grasp
from grafu.additions.interior.request import NOTHING, CompartmentChoice
from grafu.additions.interior.turned import compartments_of, furnish_scene
from grafu.additions.step import Addition, StepResult
from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.evaluation.moving_parts import MovingPart
from grafu.geometry.transform import invert, transform_points
from grafu.judging.coverage import coverage_ratio
from grafu.judging.handles import handle_faults
from grafu.judging.panels import empty_rooms, panel_faults
from grafu.judging.piece import JudgedPiece
from grafu.judging.tops import open_ratio
from grafu.metrics.judged import judged_piece
from grafu.pipeline.additions import fitted_object
from grafu.pipeline.functionalize import Functionalized
from grafu.vocabulary import PartLabel

SKIN = 0.001  # of the largest side: deeper cuts are cuts
_PANELS = (1, 2, 3)  # one of these for each compartment, shelves or dividers: the paper's numbers


@final
@dataclass(frozen=True)
class GraspChange:
    """How a moving body can be grasped before and after, as the same search finds it: handle, recess, edge or none."""

    part: str
    before: str
    after: str


@final
@dataclass(frozen=True)
class HandleChange:
    """Whether a part that counts has a handle before and after; a carved grip is none."""

    part: str
    before: bool
    after: bool


@final
@dataclass(frozen=True)
class TopChange:
    """How far a piece is covered from above before and after: `covered` by the paper's test, `opened` past its rim.

    `added` counts the tops that were added.
    """

    covered: tuple[float, float]
    opened: tuple[float, float]
    added: int


@final
@dataclass(frozen=True)
class RandomPanels:
    """What comes of 1 to 3 shelves or dividers at random in each compartment.

    `filled` compartments hold at least one new panel. `faulty` panels float, cut into something or block a motion.
    `rooms` counts empty rooms that rays find in a piece without a compartment.
    """

    compartments: int
    filled: int
    asked: int
    placed: int
    faulty: int
    rooms: int


@final
@dataclass(frozen=True)
class Completeness:
    """What of a model's statics was missing, and what is there now. `blocked` counts new handles in the way."""

    top: TopChange
    handles: tuple[HandleChange, ...]
    grasps: tuple[GraspChange, ...]
    added_handles: int
    blocked: int
    panels: RandomPanels


def completeness_of(asset: Asset, truth: Sequence[MovingPart], result: Functionalized) -> Completeness:
    """Returns what was missing and what was made in one result; compartments are furnished for the count alone."""
    piece = judged_piece(result.object)
    new = [part for part in piece.parts if part.is_handle and part.origin == "added"]
    blocked = {fault[0] for fault in handle_faults(piece, SKIN * piece.largest_side)} if new else set()
    return Completeness(
        _top(piece, result), _handles(asset, truth, piece), _grasps(result), len(new), len(blocked), _panels(result)
    )


def _top(piece: JudgedPiece, result: Functionalized) -> TopChange:
    """Returns how the closed piece is covered, without handles and hardware, as it came and with what was added."""
    own = [p for p in piece.parts if p.origin != "hardware" and p.label is not PartLabel.HANDLE and len(p.mesh.faces)]
    before = [part.mesh for part in own if part.origin == "input"]
    after = [part.mesh for part in own]
    added = sum(addition.part.label is PartLabel.TOP_PANEL for addition in result.body.additions)
    opened = tuple(open_ratio(meshes) if meshes else 0.0 for meshes in (before, after))
    return TopChange((coverage_ratio(before), coverage_ratio(after)), (opened[0], opened[1]), added)


def _handles(asset: Asset, truth: Sequence[MovingPart], piece: JudgedPiece) -> tuple[HandleChange, ...]:
    """Returns of each part that counts whether it has a handle: stated by the annotation, or on its body."""
    body_of = {part.name: body for body in piece.bodies for part in body.parts}
    stated = {part.carried_by for part in asset.parts if part.label is PartLabel.HANDLE}
    found = []
    for part in truth:
        on_body = [] if part.id not in body_of else [handle.origin for handle in body_of[part.id].handles]
        before = part.id in stated or "input" in on_body
        found.append(HandleChange(part.id, before, before or "added" in on_body))
    return tuple(found)


def _grasps(result: Functionalized) -> tuple[GraspChange, ...]:
    """Returns the change of each moving body; only where nothing was found before is looked at again."""
    found = []
    for moving, grasp in result.fittings.grasps.items():
        after = grasp.kind if grasp.kind != "none" else find_grasp(result.fittings.scene, moving).kind
        found.append(GraspChange(moving, grasp.kind, after))
    return tuple(found)


def random_choices(name: str, count: int) -> dict[int, CompartmentChoice]:
    """Returns 1 to 3 shelves or dividers for each compartment, drawn by the model's name."""
    rng = np.random.default_rng(int.from_bytes(sha256(name.encode()).digest()[:8]))
    found = {}
    for number in range(count):
        panels, is_shelf = int(rng.choice(_PANELS)), bool(rng.integers(2))
        found[number] = CompartmentChoice(panels if is_shelf else 0, 0 if is_shelf else panels)
    return found


def _panels(result: Functionalized) -> RandomPanels:
    scene = result.fittings.scene
    compartments, back = compartments_of(scene)
    if not compartments:
        return RandomPanels(0, 0, 0, 0, 0, len(empty_rooms(judged_piece(result.object))))
    chosen = random_choices(result.asset.name, len(compartments))
    made = furnish_scene(scene, NOTHING, chosen=chosen)
    names = {addition.part.id for addition in made.additions}
    piece = judged_piece(fitted_object(result.object, StepResult(scene, made.additions)))
    faulty = {fault[0] for fault in panel_faults(piece, names, SKIN * piece.largest_side)} if names else set()
    boxes = [compartment.box.grown(SKIN * piece.largest_side) for compartment in compartments]
    middles = [transform_points(invert(back), _middle(addition))[0] for addition in made.additions]
    filled = sum(any(bool(box.contains(middle[None])[0]) for middle in middles) for box in boxes)
    asked = sum(choice.shelves + choice.dividers for choice in chosen.values())
    return RandomPanels(len(compartments), filled, asked, len(names), len(faulty), 0)


def _middle(addition: Addition) -> np.ndarray:
    return np.asarray(addition.part.box.center)[None]
