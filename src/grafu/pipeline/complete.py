"""Completed graphs from what an asset has beyond its graph: its own joints, or points on its parts for the network.

Which edges stated joints stand for is decided in `grafu.graph.annotated`. It builds nothing.
"""

from dataclasses import replace
from functools import partial
from pathlib import Path

from grafu.asset.appliance_names import is_dropping_door
from grafu.asset.part import Asset, Part
from grafu.completion.control_panels import with_panels_of_controls
from grafu.completion.controls import without_controls
from grafu.completion.copied_bars import with_copied_bars
from grafu.completion.drawers_above_doors import with_drawers_above_doors
from grafu.completion.dropping_doors import with_dropping_doors
from grafu.completion.fixed_shelves import with_fixed_shelves
from grafu.completion.handle_sides import with_handle_sides
from grafu.completion.held_borders import with_held_borders
from grafu.completion.leaning_fronts import with_leaning_fronts
from grafu.completion.lone_fronts import with_lone_fronts
from grafu.completion.moving_links import links_that_move
from grafu.completion.network import complete_by_network
from grafu.completion.one_link import with_rigid_links
from grafu.completion.oven_doors import with_oven_doors
from grafu.completion.round_doors import with_round_doors
from grafu.completion.rule import complete_by_rule
from grafu.completion.session import SHIPPED_WEIGHTS, open_network
from grafu.completion.static_guesses import with_static_guesses
from grafu.completion.tall_doors import with_tall_doors
from grafu.completion.thick_doors import with_thick_doors
from grafu.completion.ways_out import with_ways_out
from grafu.completion.window_doors import with_window_doors
from grafu.geometry.sampling import sample_surfaces
from grafu.graph.annotated import annotated_edges
from grafu.graph.completion import GraphCompletion, decision_of
from grafu.graph.edges import Attached
from grafu.graph.edit import relabelled, with_edges, without_names
from grafu.graph.functional_graph import FunctionalGraph
from grafu.pipeline.several_pieces import completed_by_pieces
from grafu.vocabulary import PartLabel


def complete_by_annotation(asset: Asset, graph: FunctionalGraph, source: str = "annotation") -> GraphCompletion:
    """Returns the graph with an edge for each annotated joint and each handle that rides on a part.

    A joint that nothing could carry, and a door or drawer without a joint, are refused here with the reason; a plan
    made from the annotation itself may still build it. `source` names who stated the joints, where that was not
    the input.
    """
    stated = annotated_edges(asset, graph)
    motions = {edge.child: edge for edge in reversed(stated.edges) if not isinstance(edge, Attached)}
    decisions = tuple(decision_of(edge) for edge in reversed(motions.values()))
    completed = with_edges(graph, stated.edges)
    return GraphCompletion(graph, completed, source, decisions=decisions, refused=stated.refused)


def complete_by_weights(asset: Asset, graph: FunctionalGraph, weights: Path | None = None) -> GraphCompletion:
    """Returns the graph as the network completes it: that in the file `weights`, or the one that came with the package.

    Drawers slide to the side that they are seen from, where rays tell it (`with_ways_out`); round doors hang on their
    left or right side (`with_round_doors`), and so do high ones (`with_tall_doors`); those of ovens hang on their
    lower border (`with_dropping_doors`), and doors on the side away from their handle (`with_handle_sides`), or, with
    copied level bars, on the lower or upper border (`with_copied_bars`); none hangs on a border in the air where that
    opposite is near what could hold it (`with_held_borders`). What is only guessed to be a door, and is too thick, is a
    drawer (`with_thick_doors`), and so is what is low and wide above a door, or of the size of the drawer right above
    or below it (`with_drawers_above_doors`); what is only guessed to be a drawer, and can be none, is a door
    (`with_lone_fronts`), as below a panel with knobs (`with_oven_doors`) or where it leans (`with_leaning_fronts`); a
    front with a window and a bar along its upper edge drops (`with_window_doors`); what is only guessed to be a door or
    drawer stays static where it cannot be one (`with_static_guesses`), as a panel with buttons beside a door
    (`with_panels_of_controls`), or what is on the link of the body while other links have doors and drawers
    (`with_rigid_links`). A shelf that is a board is fixed (`with_fixed_shelves`), and knobs of appliances are controls
    (`without_controls`). A link of its own that plainly moves (`links_that_move`) is a door, and all is asked again.
    Of several pieces of furniture each is completed for itself, with its own front at -Y (`completed_by_pieces`).

    Raises:
        WeightsError: if the file is missing, or is no such network.
    """
    if asset.standings:
        return completed_by_pieces(asset, graph, partial(complete_by_weights, weights=weights))
    found = _complete_by_weights(asset, graph, weights)
    links = links_that_move(found, asset)
    if not links:
        return found
    named = dict.fromkeys(links, PartLabel.DOOR)
    labelled, asked = asset.with_labels(named), relabelled(graph, named)
    marked = replace(labelled, parts=tuple(_by_shape(part, links) for part in labelled.parts))
    return replace(_complete_by_weights(marked, asked, weights), input=asked)


def _by_shape(part: Part, links: tuple[str, ...]) -> Part:
    return replace(part, labelled_by="shape") if part.id in links else part


def _complete_by_weights(asset: Asset, graph: FunctionalGraph, weights: Path | None) -> GraphCompletion:
    network = open_network(weights or SHIPPED_WEIGHTS)
    clouds = sample_surfaces([asset.part(node.id).mesh for node in graph.nodes], network.features.points)
    pointed = tuple(replace(node, points=cloud) for node, cloud in zip(graph.nodes, clouds, strict=True))
    hidden = {part.id for part in asset.parts if part.labelled_by == "hidden"}
    seen = without_names(replace(graph, nodes=pointed), hidden)
    named = {p.id for p in asset.parts if p.labelled_by in ("name", "shape") and not is_dropping_door(p.source.name)}
    drawn = with_thick_doors(complete_by_network(seen, network, network.features, named=named), asset)
    predicted = with_lone_fronts(with_drawers_above_doors(drawn, asset), asset)
    ovens = with_oven_doors(with_fixed_shelves(with_leaning_fronts(predicted, asset), asset))
    moved = with_window_doors(_shaped(ovens, asset), asset)
    settled = with_static_guesses(with_rigid_links(with_panels_of_controls(moved, asset), asset), asset)
    found = without_controls(settled, asset)
    names = {node.id: node.source_name for node in graph.nodes}
    bare = tuple(
        replace(node, points=None, source_name=names.get(node.id, node.source_name)) for node in found.completed.nodes
    )
    return replace(found, input=graph, completed=replace(found.completed, nodes=bare))


def complete_by_shape(asset: Asset, graph: FunctionalGraph) -> GraphCompletion:
    """Returns the graph as the rule completes it; see `complete_by_weights` for drawers and round doors."""
    if asset.standings:
        return completed_by_pieces(asset, graph, complete_by_shape)
    return _shaped(complete_by_rule(graph), asset)


def _shaped(completion: GraphCompletion, asset: Asset) -> GraphCompletion:
    """Returns the completion in which shape decides where drawers and lids open to, and on which side doors hang."""
    turned = with_tall_doors(with_round_doors(with_ways_out(completion, asset), asset), asset)
    sided = with_handle_sides(with_dropping_doors(turned, asset), asset)
    return with_held_borders(with_copied_bars(sided, asset))
