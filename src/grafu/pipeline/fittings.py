"""What is added when all joints stand: handles, grips and interiors. No joint changes, and nothing gets in its way."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import final

from grafu.additions.addition import Addition
from grafu.additions.grip.carve import carve_grip
from grafu.additions.grip.config import GripConfig
from grafu.additions.grip.outcome import Carved
from grafu.additions.handle.grasp import Grasp, find_grasps
from grafu.additions.handle.place import Handles, add_handles, bodies_without
from grafu.additions.handle.relief import Reliefs
from grafu.additions.interior.furnish import Furnished
from grafu.additions.interior.request import InteriorKind, PanelHint
from grafu.additions.interior.turned import furnish_scene
from grafu.articulation.articulated_object import ArticulatedObject, Link, Visual, VisualRole
from grafu.asset.part import Part
from grafu.geometry.arrays import Vec3
from grafu.geometry.intersection import forget_large_shapes
from grafu.graph.completion import GraphCompletion
from grafu.pipeline.addition_config import AdditionConfig
from grafu.pipeline.front_choices import fit_fronts, without_replaced
from grafu.refusal import Refusal
from grafu.scene.scene import Scene
from grafu.templates.template import HandleTemplate
from grafu.vocabulary import PartLabel


@final
@dataclass(frozen=True)
class Fittings:
    """What was added, which parts were carved, and how each moving body can be grasped now.

    `grasps` holds for each moving body what was found before anything was added to it. `removed` names the handles of
    the input that were replaced. `before_interiors` is the scene before shelves and dividers (None: as it is).
    """

    scene: Scene
    additions: tuple[Addition, ...] = ()
    carved: tuple[Carved, ...] = ()
    grasps: Mapping[str, Grasp] = field(default_factory=dict)
    skipped: tuple[Refusal, ...] = ()
    removed: frozenset[str] = frozenset()
    before_interiors: Scene | None = None

    def afresh(self) -> "Fittings":
        """Returns the same with scenes that hold nothing but what they are made of."""
        before = None if self.before_interiors is None else self.before_interiors.afresh()
        return replace(self, scene=self.scene.afresh(), before_interiors=before)


def add_fittings(
    scene: Scene, completion: GraphCompletion, config: AdditionConfig, own: Mapping[str, HandleTemplate]
) -> Fittings:
    """Returns a final scene with the handles, grips and panels that it lacks and may have.

    Raises:
        TemplateError: if the config names a handle that there is not.
    """
    scene, removed = without_replaced(scene, config.fronts)
    reliefs = Reliefs(scene)
    grasps = find_grasps(scene, config.grasp, reliefs)
    free = {moving: grasp for moving, grasp in grasps.items() if moving not in config.fronts}
    handles, wanting = _handles(scene, free, completion, config, own, reliefs)
    scene, kept = _accepted(handles, config)
    carved, failed = _grips(scene, wanting, config.grips)
    scene = scene.replaced([one.part for one in carved])
    skipped = [*failed]
    fronts = fit_fronts(scene, config, _handle_hints(completion), own)
    skipped += fronts.skipped
    inside = _interior(fronts.scene, completion, config)
    skipped += inside.refused
    panels = tuple(addition for addition in inside.additions if addition.part.id not in config.rejected)
    scene = replace(fronts.scene, parts={**fronts.scene.parts, **{panel.part.id: panel.part for panel in panels}})
    additions = (*kept, *fronts.additions, *panels)
    forget_large_shapes()
    return Fittings(scene, additions, (*carved, *fronts.carved), grasps, tuple(skipped), removed, fronts.scene).afresh()


def _accepted(handles: Handles, config: AdditionConfig) -> tuple[Scene, tuple[Addition, ...]]:
    """Returns the scene with the handles that were not rejected, and these."""
    kept = tuple(addition for addition in handles.additions if addition.part.id not in config.rejected)
    gone = {addition.part.id for addition in handles.additions} - {addition.part.id for addition in kept}
    return handles.scene.without_attached(gone), kept


def fitted_object(articulated: ArticulatedObject, fittings: Fittings) -> ArticulatedObject:
    """Returns the object with all fittings on their links."""
    carved = {one.part.id: one.part for one in fittings.carved}
    riding: dict[str, list[Visual]] = {}
    for addition in fittings.additions:
        part = addition.part
        visual = Visual(part.id, part.surfaces, VisualRole.ADDED, part.label)
        riding.setdefault(part.rides_on or articulated.root, []).append(visual)
    gone = fittings.removed
    links = tuple(_fitted_link(link, carved, riding.get(link.id, []), gone) for link in articulated.links)
    return replace(articulated, links=links)


def _fitted_link(link: Link, carved: Mapping[str, Part], more: list[Visual], gone: frozenset[str]) -> Link:
    if not more and not any(v.name in carved or v.name in gone for v in link.visuals):
        return link
    left = (v for v in link.visuals if v.name not in gone)
    kept = (replace(v, surfaces=carved[v.name].surfaces) if v.name in carved else v for v in left)
    return Link(link.id, (*kept, *more))


def _handles(
    scene: Scene,
    grasps: Mapping[str, Grasp],
    completion: GraphCompletion,
    config: AdditionConfig,
    own: Mapping[str, HandleTemplate],
    reliefs: Reliefs,
) -> tuple[Handles, dict[str, Refusal | None]]:
    """Returns the handles, and the moving bodies that still need a grip, with the refusal of a handle."""
    if config.handles is None:
        wanting = bodies_without(scene, grasps) if config.grips is not None else ()
        return Handles((), (), scene), dict.fromkeys(wanting)
    found = add_handles(scene, grasps, config.handles, _handle_hints(completion), own, reliefs)
    return found, {refused.part: refused for refused in found.refused}


def _grips(
    scene: Scene, wanting: Mapping[str, Refusal | None], config: GripConfig | None
) -> tuple[tuple[Carved, ...], tuple[Refusal, ...]]:
    """Returns what was carved, and the refusals of bodies that cannot be grasped yet."""
    carved: list[Carved] = []
    failed: list[Refusal] = []
    for moving, no_handle in wanting.items():
        made = None if config is None else carve_grip(scene, moving, config)
        if isinstance(made, Carved):
            carved.append(made)
        else:
            failed += [_no_grasp(*(one for one in (no_handle, made) if one is not None))]
    return tuple(carved), tuple(failed)


def _no_grasp(first: Refusal, *others: Refusal) -> Refusal:
    """Returns several refusals of one front as one, with the reason of the first."""
    said = "; ".join((first.why, *(other.why for other in others)))
    return Refusal(first.part, first.reason, f"nothing to grasp it by: {said}", first.what)


def _interior(scene: Scene, completion: GraphCompletion, config: AdditionConfig) -> Furnished:
    request = config.interior
    hints = _panel_hints(completion) if request.kind is InteriorKind.PREDICTED else []
    is_nothing = request.kind is InteriorKind.NONE or (request.kind is InteriorKind.PREDICTED and not hints)
    if is_nothing and not config.compartments:
        return Furnished()
    return furnish_scene(scene, request, config.interior_sizes, hints, config.compartments)


def _handle_hints(completion: GraphCompletion) -> dict[str, Vec3]:
    """Returns where handles were predicted, by the part that they are for."""
    graph, new = completion.completed, set(completion.added)
    return {edge.parent: graph.node(edge.child).box.center for edge in graph.attachments if edge.child in new}


def _panel_hints(completion: GraphCompletion) -> list[PanelHint]:
    nodes = (completion.completed.node(name) for name in completion.added)
    inner = (PartLabel.SHELF, PartLabel.DIVIDER)
    return [PanelHint(node.id, node.label, node.box) for node in nodes if node.label in inner]
