"""Which parts were only guessed to move, and cannot: slats, seats, arms of a chair, the mattress of a bed."""

from collections.abc import Collection, Iterable, Iterator
from typing import Final

from grafu.completion.static_guesses import StaticGuessConfig, guessed_to_move, taken_for
from grafu.graph.completion import GraphCompletion
from grafu.joints.report import Installed
from grafu.refusal import Reason, Refusal
from grafu.vocabulary import PartLabel

_CANNOT: Final = (Reason.BLOCKED, Reason.NO_FACING_SURFACES)
"""Why no joint was built where nothing speaks for one; a lack of room for hardware shows nothing."""


def colliding_guesses(
    completion: GraphCompletion,
    installed: Iterable[Installed],
    refused: Iterable[Refusal] = (),
    settled: Collection[str] = (),
    config: StaticGuessConfig = StaticGuessConfig(),
) -> Iterator[Refusal]:
    """Yields a refusal for each part without a label whose joint, as it was built, cuts into what stays.

    So it does for each that no joint was built for, as it is blocked, or nothing stands near that could carry it. What
    has a handle on it that the input calls one moves as it is predicted, and so do `settled` parts, whose motions the
    user states. A handle that is itself a guess shows nothing: screws in a seat are taken for some.
    """
    handles = {node.id for node in completion.input.nodes if node.label is PartLabel.HANDLE}
    held = {edge.parent for edge in completion.completed.attachments if edge.child in handles}
    guesses = {decision.part: decision for decision in guessed_to_move(completion)}
    for done in installed:
        guess = guesses.get(done.moving)
        if guess is None or done.moving in held or done.moving in settled:
            continue
        if done.collision_share > config.cuts:
            why = f"{taken_for(guess)}, but it cuts into other parts in {done.collision_share:.0%} of its poses"
            yield Refusal(done.moving, Reason.UNLIKELY, why)
    for refusal in refused:
        guess = guesses.get(refusal.part)
        if guess is not None and refusal.reason in _CANNOT and refusal.part not in {*held, *settled}:
            yield Refusal(refusal.part, Reason.UNLIKELY, f"{taken_for(guess)}, but {refusal.why}")
