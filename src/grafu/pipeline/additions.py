"""What a run adds, before its joints are built and after: the request to the steps, and their results on the object."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from grafu.additions.carcass.config import CarcassConfig
from grafu.additions.carcass.step import BOARDS
from grafu.additions.config import AdditionConfig
from grafu.additions.interior.compartments import compartments_found
from grafu.additions.statics import Statics
from grafu.additions.step import PanelHint, StepRequest, StepResult
from grafu.additions.steps import BEFORE_JOINTS, INSIDE, ON_FRONTS, run_steps
from grafu.articulation.articulated_object import ArticulatedObject, Link, Visual, VisualRole
from grafu.asset.part import Asset, Part
from grafu.geometry.arrays import Vec3
from grafu.geometry.blocks import forget_large_shapes
from grafu.graph.completion import GraphCompletion
from grafu.graph.functional_graph import PartNode
from grafu.joints.plan import RealizationPlan
from grafu.joints.rail_config import DrawerConfig
from grafu.joints.realize import Realized
from grafu.scene.scene import MovingBody, Scene
from grafu.templates.template import HandleTemplate
from grafu.vocabulary import PartLabel


def planned_scene(asset: Asset, plan: RealizationPlan) -> Scene:
    """Returns the parts as they are drawn, with the moving bodies of a plan whose joints are not built yet."""
    moving_bodies = {r.moving: MovingBody(r.moving, (r.moving, *r.attached)) for r in plan.joints}
    return Scene({part.id: part for part in asset.parts}, moving_bodies, asset.extent)


def add_before_joints(
    asset: Asset,
    completion: GraphCompletion,
    plan: RealizationPlan,
    config: AdditionConfig,
    drawers: DrawerConfig = DrawerConfig(),
) -> StepResult:
    """Returns the asset with the tops, boards and drawer boxes that it lacks and may have: joints must respect them."""
    nodes = completion.completed.nodes
    expected = _expected(completion, config.statics)
    request = StepRequest(
        plan,
        drawers,
        (asset.name, *(part.source.name for part in asset.parts)),
        frozenset(node.id for node in nodes if node.label is PartLabel.TOP_PANEL),
        next((node.box for node in expected if node.label is PartLabel.TOP_PANEL), None),
        boards=BOARDS & {*(node.label for node in expected), *_likely(completion, config.statics)},
        only_expected=config.statics is Statics.GRAPH,
    )
    made = run_steps(BEFORE_JOINTS, planned_scene(asset, plan), request, config)
    return replace(made, scene=made.scene.afresh())


def add_after_joints(
    scene: Scene,
    completion: GraphCompletion,
    plan: RealizationPlan,
    config: AdditionConfig,
    own: Mapping[str, HandleTemplate],
) -> tuple[StepResult, Scene]:
    """Returns a final scene with the handles, grips and panels that it lacks and may have, and that without panels.

    Raises:
        TemplateError: if the config names a handle that there is not.
    """
    expected = _expected(completion, config.statics)
    request = StepRequest(
        plan,
        handles=_handle_hints(completion, expected),
        panels=_panel_hints(expected),
        only_expected=config.statics is Statics.GRAPH,
        own_handles=own,
    )
    fronts = run_steps(ON_FRONTS, scene, request, config)
    made = fronts.then(run_steps(INSIDE, fronts.scene, request, config))
    forget_large_shapes()
    return replace(made, scene=made.scene.afresh()), fronts.scene.afresh(compartments_found)


def _expected(completion: GraphCompletion, statics: Statics) -> tuple[PartNode, ...]:
    """Returns the nodes that the completed graph adds, where it is asked."""
    asked = statics is not Statics.GEOMETRY
    return tuple(completion.completed.node(name) for name in completion.added) if asked else ()


def _likely(completion: GraphCompletion, statics: Statics) -> tuple[PartLabel, ...]:
    """Returns the boards that are built where rays find none: the completed graph adds none, but weighed one."""
    asked = statics is not Statics.GEOMETRY
    least = CarcassConfig().weighed
    return tuple(label for label, probability in completion.weighed if probability >= least) if asked else ()


def _handle_hints(completion: GraphCompletion, expected: Sequence[PartNode]) -> dict[str, Vec3]:
    """Returns where handles were predicted, by the part that they are for."""
    new = {node.id: node for node in expected}
    return {edge.parent: new[edge.child].box.center for edge in completion.completed.attachments if edge.child in new}


def _panel_hints(expected: Sequence[PartNode]) -> tuple[PanelHint, ...]:
    inner = (PartLabel.SHELF, PartLabel.DIVIDER)
    return tuple(PanelHint(node.id, node.label, node.box) for node in expected if node.label in inner)


def without_idle(made: StepResult, realized: Realized) -> tuple[StepResult, Realized]:
    """Returns both without what was added to a door or drawer that then got no joint: it would be static."""
    moving = {joint.child for joint in realized.object.joints}
    idle = {a.part.id for a in made.additions if a.part.carried_by is not None and a.part.carried_by not in moving}
    if not idle:
        return made, realized
    links = tuple(
        replace(link, visuals=tuple(v for v in link.visuals if v.name not in idle)) for link in realized.object.links
    )
    scene = realized.scene.without_parts(idle).afresh()
    return made.without(idle, made.scene), replace(realized, object=replace(realized.object, links=links), scene=scene)


def fitted_object(articulated: ArticulatedObject, made: StepResult) -> ArticulatedObject:
    """Returns the object with all that was added after its joints on their links."""
    carved = {one.part.id: one.part for one in made.changes.carved}
    riding: dict[str, list[Visual]] = {}
    for addition in made.additions:
        part = addition.part
        visual = Visual(part.id, part.surfaces, VisualRole.ADDED, part.label)
        riding.setdefault(part.carried_by or articulated.root, []).append(visual)
    gone = made.changes.removed
    links = tuple(_fitted_link(link, carved, riding.get(link.id, []), gone) for link in articulated.links)
    return replace(articulated, links=links)


def _fitted_link(link: Link, carved: Mapping[str, Part], more: list[Visual], gone: frozenset[str]) -> Link:
    if not more and not any(v.name in carved or v.name in gone for v in link.visuals):
        return link
    left = (v for v in link.visuals if v.name not in gone)
    kept = (replace(v, surfaces=carved[v.name].surfaces) if v.name in carved else v for v in left)
    return Link(link.id, (*kept, *more))
