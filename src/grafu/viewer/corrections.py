"""What sets a wrong motion right: for each joint the options of `grafu functionalize` to copy. It corrects nothing."""

from typing import Final

from grafu.articulation.articulated_object import ArticulatedObject
from grafu.pipeline.motion_choices import motions_of
from grafu.pipeline.report_schema import Report
from grafu.realization.motion_choice import MotionChoice, Moves, Side
from grafu.viewer.markup import Html, joined, tag

_OTHER: Final = {Side.LEFT: Side.RIGHT, Side.RIGHT: Side.LEFT, Side.TOP: Side.BOTTOM, Side.BOTTOM: Side.TOP}
LEAD = (
    "One is wrong? Copy its line, give it to the same command, with --overwrite. Instead of the last word: left, "
    "right, top or bottom (it turns about that side), slides, or not."
)


def corrections(report: Report, made: ArticulatedObject) -> dict[str, tuple[str, ...]]:
    """Returns for each moving part what may be meant instead: that it turns about the other side, or stands still.

    Empty where nothing moves, or the motions are another system's: no option changes those.
    """
    if report.motion.source.is_foreign or not report.joints:
        return {}
    motions = motions_of(made)
    return {
        joint.part: tuple(f"--move {joint.part}={way}" for way in _ways(motions.get(joint.part)))
        for joint in report.joints
    }


def _ways(motion: MotionChoice | None) -> list[str]:
    other = _OTHER.get(motion.side) if motion and motion.moves is Moves.TURNS and motion.side else None
    return [str(other), str(Moves.NOT)] if other else [str(Moves.NOT)]


def correction_buttons(options: tuple[str, ...]) -> Html:
    """Returns a button for each option that copies it; its text can be selected, too."""
    buttons = (tag("button", o, type="button", class_="copy", title="Copy", data_copy=o) for o in options)
    return joined(buttons)
