"""The direction in which a door or drawer opens: a rule of geometry weighs the network's choice.

A door rather opens towards the face that looks away from the body, a drawer to where nothing stands. The rule's view
weighs what is chosen, never the reported probabilities: these are the network's own.
"""

import numpy as np

from grafu.completion.doors import vote_front
from grafu.completion.drawers import vote_direction
from grafu.completion.rule_scene import RuleScene
from grafu.completion.votes import Ranking
from grafu.geometry.arrays import Scalars
from grafu.graph.edges import BORDERS, SIGNED_AXES, SIGNS, SignedAxis
from grafu.graph.functional_graph import PartNode
from grafu.graph.motion import opening_face

_LEAST = 1e-3  # what the rule did not vote for stays possible


def leaned_motion(door: PartNode, motion: np.ndarray, power: float, scene: RuleScene) -> np.ndarray:
    """Returns what the network says of a door's border and sign (4, 2), weighed by the face that leads then."""
    front, thin = _opinion(vote_front(door, scene), power), door.box.thin_axis
    return motion * np.array([[front[opening_face(thin, border, sign)] for sign in SIGNS] for border in BORDERS])


def leaned_way(drawer: PartNode, shares: Scalars, power: float, scene: RuleScene) -> Scalars:
    """Returns what the network says of the signed axes along which a drawer opens (6), weighed by the way out."""
    return shares * _opinion(vote_direction(drawer, scene), power)


def _opinion(ranking: Ranking[SignedAxis], power: float) -> Scalars:
    """Returns what the rule's vote weighs for each signed axis."""
    shares = np.full(len(SIGNED_AXES), _LEAST)
    for code, score in ((ranking.choice, ranking.score), (ranking.runner_up, ranking.runner_up_score)):
        if code is not None:
            shares[code] = max(score, _LEAST)
    return shares**power
