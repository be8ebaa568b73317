"""The carousel of a corner cabinet: round trays on a post, which turn without end. The cabinet states its room."""

from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.mesh import TriangleMesh
from grafu.synth.appliances.appliance import turn_of
from grafu.synth.pieces.assembly import PieceDraft, solid
from grafu.synth.pieces.finish import Finish
from grafu.synth.pieces.shapes import rod, turned
from grafu.vocabulary import PartLabel

POST = 0.0125  # metres: the radius of the post
FLOOR, RIM, WALL = 0.008, 0.05, 0.006  # metres: how thick a tray's floor is, how high its rim, how thick that
LIFT, PLAY = 0.02, 0.001  # metres between the cabinet's floor and the lowest tray; between post and floor or top
SIDES = 24
LEAST = 0.12  # metres: trays of a smaller radius hold nothing


def carousel_piece(
    center: tuple[float, float], radius: float, span: tuple[float, float], trays: int, look: Finish
) -> PieceDraft:
    """Returns so many trays on a post between two heights, metres, with their true motion.

    Raises:
        ValueError: if the trays are too small to hold anything.
    """
    (x, y), (low, high) = center, span
    pitch = (high - low) / trays
    if radius < LEAST or pitch < 2 * RIM:
        raise ValueError(f"a carousel has no room: got trays of {radius:.3f} m, {pitch:.3f} m above each other")
    meshes = [rod(vec3(x, y, low + PLAY), vec3(x, y, high - PLAY), POST, 12)]
    for k in range(trays):
        meshes += _tray(x, y, low + LIFT + k * pitch, radius)
    turn = turn_of(Axis(vec3(x, y, low), vec3(0.0, 0.0, 1.0)))
    made = solid(PartLabel.MISC, "carousel", look.metal, meshes)
    return PieceDraft(made.label, made.stem, made.surfaces, turn)


def _tray(x: float, y: float, z: float, radius: float) -> list[TriangleMesh]:
    """Returns a round tray that stands at the height z: its floor, and its rim as a ring of one outline."""
    outline = ((0.0, radius), (1.0, radius), (1.0, radius - WALL), (FLOOR / RIM, radius - WALL))
    return [turned(vec3(x, y, z), vec3(x, y, z + RIM), outline, SIDES)]
