"""What was added for a door or drawer that then got no joint is taken back: a box without a joint is of no use."""

from dataclasses import replace

from grafu.joints.realize import Realized
from grafu.pipeline.body_additions import Body


def without_idle(body: Body, realized: Realized) -> tuple[Body, Realized]:
    """Returns both without the additions that would move with a part that no joint moves."""
    moving = {joint.child for joint in realized.object.joints}
    idle = {a.part.id for a in body.additions if a.part.rides_on is not None and a.part.rides_on not in moving}
    if not idle:
        return body, realized
    asset = replace(body.asset, parts=tuple(p for p in body.asset.parts if p.id not in idle))
    body = replace(body, asset=asset, additions=tuple(a for a in body.additions if a.part.id not in idle))
    links = tuple(
        replace(link, visuals=tuple(v for v in link.visuals if v.name not in idle)) for link in realized.object.links
    )
    scene = replace(realized.scene, parts={k: p for k, p in realized.scene.parts.items() if k not in idle})
    return body, replace(realized, object=replace(realized.object, links=links), scene=scene.afresh())
