"""A picture of a model as it is given, for those who predict motions from one: no joint and no category shows in it."""

from typing import Final

from grafu.asset.part import Asset
from grafu.evaluation.moving_parts import raw_object
from grafu.joints.plan import RealizationPlan
from grafu.render.camera import three_quarter_view
from grafu.render.picture import encode_png, posed_visuals, render

SIZE: Final = (640, 480)
"""Width and height in pixels."""


def picture_of(asset: Asset) -> bytes:
    """Returns an asset, seen from the front, turned aside and raised, as PNG."""
    shown = raw_object(asset, RealizationPlan(()))
    return encode_png(render(posed_visuals(shown), three_quarter_view(asset.box), SIZE))
