"""How else a part may move, as options of `grafu functionalize`: the other side, sliding, or not. It moves none.

For what is static the first option makes it move. The last one always states that a part must be static.
"""

from collections.abc import Iterator

from grafu.asset.part import Asset, Part
from grafu.errors import OptionError
from grafu.joints.motion_choice import MotionChoice, Moves, Side, axis_of_motion, motion_as_choice
from grafu.pipeline.functionalize import Functionalized
from grafu.pipeline.motion_choices import motions_of
from grafu.vocabulary import MOVABLE_VALUES, PartLabel

_SIDES = (Side.LEFT, Side.RIGHT, Side.TOP, Side.BOTTOM)
_OTHER = {Side.LEFT: Side.RIGHT, Side.RIGHT: Side.LEFT, Side.TOP: Side.BOTTOM, Side.BOTTOM: Side.TOP}
SLIDES = MotionChoice(Moves.SLIDES)


def move_options(result: Functionalized) -> dict[str, tuple[str, ...]]:
    """Returns the options by part: of all that move, of doors and drawers that do not, and of what may be one.

    Empty where the motions are another system's: no option changes those.
    """
    if result.source.is_foreign:
        return {}
    motions = motions_of(result.object)
    hardware = {link.id for link in result.object.links if not len(link.body_mesh.faces)}
    joints = (joint for joint in result.object.moving_joints if joint.child not in hardware)
    moving = {joint.child: _instead(motions.get(joint.child)) for joint in joints}
    still = {part.id: list(_into_motion(part, result)) for part in _still(result, set(moving))}
    choices = {part: (*found, str(Moves.FIXED)) for part, found in (moving | still).items()}
    return {part: tuple(f"--move {part}={choice}" for choice in found) for part, found in choices.items()}


def _instead(motion: MotionChoice | None) -> list[str]:
    """Returns the side that a part may turn about or fold to instead, where there is one that can be named."""
    if motion and (motion.moves is Moves.LIFTS or (motion.moves is Moves.FOLDS and motion.side is Side.TOP)):
        return ["lift"]
    if motion and motion.moves is Moves.FOLDS and motion.side:
        return [f"fold-{_OTHER[motion.side]}"]
    other = _OTHER.get(motion.side) if motion and motion.moves is Moves.TURNS and motion.side else None
    return [str(other)] if other else []


def _still(result: Functionalized, moving: set[str]) -> list[Part]:
    """Returns the parts of the input that do not move and are called doors or drawers, were to move, or may be one."""
    known = {node.id: node.label for node in result.completion.completed.nodes}
    named = {name for name, label in known.items() if label.is_movable}
    named |= {skip.part for skip in result.report.skipped}
    named |= {d.part for d in result.completion.decisions if d.question == "label" and d.runner_up in MOVABLE_VALUES}
    handles = {name for name, label in known.items() if label is PartLabel.HANDLE}
    return [part for part in result.asset.parts if part.id in named - moving - handles - result.removed]


def _into_motion(part: Part, result: Functionalized) -> Iterator[str]:
    """Yields the motions that can be stated for a part, the likeliest first, without the one that was built."""
    planned = _planned(part, result)
    for choice in _choices(part, result):
        if choice != planned and _can(part, choice, result.asset):
            yield str(choice.side) if choice.moves is Moves.TURNS else str(choice.moves)


def _choices(part: Part, result: Functionalized) -> list[MotionChoice]:
    """Returns motions, the likeliest first: a drawer slides, a door turns about the side nearer to the body's."""
    node = next((n for n in result.completion.completed.nodes if n.id == part.id), None)
    label = {d.part: d.runner_up for d in result.completion.decisions if d.question == "label"}.get(part.id, "")
    outer = Side.LEFT if part.box.center[0] <= result.asset.box.center[0] else Side.RIGHT
    turns = [MotionChoice(Moves.TURNS, side) for side in dict.fromkeys((outer, _OTHER[outer], *_SIDES))]
    slides_first = PartLabel.DRAWER in (node.label if node else part.label, label)
    return [SLIDES, *turns[:2]] if slides_first else [*turns, SLIDES]


def _planned(part: Part, result: Functionalized) -> MotionChoice | None:
    """Returns the motion that was to be built for a part, as a choice; a drawer's is to slide."""
    request = next((request for request in result.plan.joints if request.moving == part.id), None)
    if request is None:
        return None
    if request.kind.slides:
        return SLIDES
    found = motion_as_choice(part.mesh, request.type, request.axis, result.asset.box)
    return MotionChoice(found.moves, found.side) if found else None


def _can(part: Part, choice: MotionChoice, asset: Asset) -> bool:
    try:
        axis_of_motion(part, choice, asset.box)
    except OptionError:
        return False
    return True
