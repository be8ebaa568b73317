"""How large a step is: the learning rate rises, then falls to zero along a cosine. Plain numbers, no torch."""

import math


def rate_at(step: int, steps: int, warmup: int, period: int | None = None) -> float:
    """Returns the share (0..1) of the highest learning rate for step 0, 1, ... of `steps`.

    It rises evenly over the first `warmup` steps, so that Adam's first averages do no harm, and then falls along half a
    cosine to zero at the end; or, with `period`, at that step, which the paper's training never reaches.
    """
    if step < warmup:
        return (step + 1) / (warmup + 1)
    last = steps if period is None else period
    done = (step - warmup) / max(1, last - warmup)
    return 0.5 * (1.0 + math.cos(math.pi * min(1.0, done)))
