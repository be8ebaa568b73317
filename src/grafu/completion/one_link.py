"""Of a robot description the shapes of one link are rigid: what is guessed to move on the link of the body stays.

It looks at links and names, never at joints.
"""

from dataclasses import replace

from grafu.asset.body_link import body_link
from grafu.asset.labels import sense_of
from grafu.asset.part import Asset
from grafu.completion.static_guesses import guessed_to_move, taken_for, with_static
from grafu.graph.completion import GraphCompletion
from grafu.graph.edit import without_edges
from grafu.refusal import Reason, Refusal


def with_rigid_links(completion: GraphCompletion, asset: Asset) -> GraphCompletion:
    """Returns the completion in which nothing moves that is only guessed to, on the link of the body.

    That is so where other links have their own doors and drawers, as many as were guessed there at least: then the
    file parts what moves from what stays. Where all are on one link, or few are not, it tells nothing. What is called a
    mere piece of a door or drawer there (`door_plate`), or is no more than near to one by its name (`drawer_deck`),
    stays as well, however many there are; so do trays and shelves. Nothing of it rides on what is on another link.
    """
    body = body_link(asset)
    if not body:
        return completion
    links = {part.id: part.source.link for part in asset.parts if part.source.link}
    graph = completion.completed
    fronts = {edge.child for edge in graph.motions if graph.node(edge.child).label.is_movable}
    apart = {links[name] for name in fronts if name in links} - {body}
    doubtful = [guess for guess in guessed_to_move(completion) if links.get(guess.part) == body]
    refusals = []
    if doubtful and len(apart) >= len(doubtful):
        why = f"but it is of one link with the body ({body}), and doors and drawers are on others"
        refusals += [Refusal(guess.part, Reason.UNLIKELY, f"{taken_for(guess)}, {why}") for guess in doubtful]
    named = (asset.part(name) for name in sorted(fronts) if links.get(name) == body) if apart else ()
    pieces = [p.id for p in named if p.labelled_by == "name" and _is_no_whole(p.source.name)]
    why = f"its name is that of a piece, and it is of one link with the body ({body})"
    refusals += [Refusal(name, Reason.UNLIKELY, why) for name in pieces]
    shelves = [edge for edge in graph.slides if apart and edge.child not in fronts and links.get(edge.child) == body]
    still = {edge.child for edge in shelves}
    kept = tuple(d for d in completion.decisions if d.part not in still or d.question == "label")
    rides = tuple(ride for ride in completion.rides if links.get(ride[0], body) == body or links.get(ride[1]) != body)
    fixed = replace(completion, completed=without_edges(graph, shelves), decisions=kept, rides=rides)
    return with_static(fixed, refusals) if refusals else fixed


def _is_no_whole(name: str) -> bool:
    sense = sense_of(name)
    return sense.is_piece or sense.is_blurred
