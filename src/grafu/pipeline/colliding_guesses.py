"""Which parts were only guessed to move, and cut into what stays as soon as they do: slats, seats, arms of a chair."""

from collections.abc import Collection, Iterable, Iterator

from grafu.completion.static_guesses import StaticGuessConfig, guessed_to_move, taken_for
from grafu.graph.completion import GraphCompletion
from grafu.joints.report import Installed
from grafu.refusal import Reason, Refusal
from grafu.vocabulary import PartLabel


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
