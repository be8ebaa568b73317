"""Which parts were only guessed to move, and cannot: slats, seats, arms of a chair, the mattress of a bed."""

from collections.abc import Collection, Iterable, Iterator
from typing import Final

from grafu.completion.static_guesses import StaticGuessConfig, guessed_to_move, taken_for
from grafu.graph.completion import Decision, GraphCompletion
from grafu.joints.report import Installed
from grafu.refusal import Reason, Refusal
from grafu.vocabulary import PartLabel

_CANNOT: Final = (Reason.BLOCKED, Reason.NO_FACING_SURFACES)
"""Why no joint was built where nothing speaks for one; a lack of room for hardware shows nothing."""


def colliding_guesses(
    completion: GraphCompletion,
    installed: Iterable[Installed],
    settled: Collection[str] = (),
    config: StaticGuessConfig = StaticGuessConfig(),
) -> Iterator[Refusal]:
    """Yields a refusal for each part without a label whose joint, as it was built, cuts into what stays.

    What has a handle on it that the input calls one moves as it is predicted, and so do `settled` parts, whose motions
    the user states. A handle that is itself a guess shows nothing: screws in a seat are taken for some.
    """
    guesses = _guesses(completion, settled)
    for done in installed:
        if done.moving in guesses and done.collision_share > config.cuts:
            why = f"it cuts into other parts in {done.collision_share:.0%} of its poses"
            yield Refusal(done.moving, Reason.UNLIKELY, f"{taken_for(guesses[done.moving])}, but {why}")


def blocked_guesses(
    completion: GraphCompletion, refused: Iterable[Refusal], settled: Collection[str] = ()
) -> Iterator[Refusal]:
    """Yields a refusal as a guess for each part without a label that no joint was built for, where none can be.

    It is blocked, or nothing stands near that could carry it. Handles and `settled` parts are as for
    `colliding_guesses`.
    """
    guesses = _guesses(completion, settled)
    for refusal in refused:
        if refusal.part in guesses and refusal.reason in _CANNOT:
            yield Refusal(refusal.part, Reason.UNLIKELY, f"{taken_for(guesses[refusal.part])}, but {refusal.why}")


def _guesses(completion: GraphCompletion, settled: Collection[str]) -> dict[str, Decision]:
    """Returns the decisions on what was only guessed to move, by part."""
    handles = {node.id for node in completion.input.nodes if node.label is PartLabel.HANDLE}
    held = {edge.parent for edge in completion.completed.attachments if edge.child in handles}
    found = {decision.part: decision for decision in guessed_to_move(completion)}
    return {part: decision for part, decision in found.items() if part not in held and part not in settled}
