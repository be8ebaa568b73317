"""An endless stream of furniture: one specimen for each seed and index, always the same one. It writes no files."""

from dataclasses import replace

import numpy as np

from grafu.asset.part import Asset
from grafu.errors import GraphError
from grafu.geometry.touching import touching_pairs
from grafu.graph.edges import ends_of
from grafu.graph.edit import without_contacts
from grafu.graph.functional_graph import FunctionalGraph
from grafu.graph.parse import ParsingConfig, parse_graph
from grafu.synth.families.table import draw_made, kind_of_piece
from grafu.synth.noise.modelling_noise import ModellingNoise, apply_noise, as_given
from grafu.synth.noise.modelling_styles import draw_noise
from grafu.synth.noise.tessellation import CUT, STEPS, tessellated
from grafu.synth.repair import repaired
from grafu.synth.specimen import Specimen
from grafu.synth.truth.check import faults_in, faults_of
from grafu.synth.truth.true_graph import carriers, pairs_apart, with_true_edges
from grafu.vocabulary import PartLabel

ATTEMPTS = 40  # models drawn for one specimen before giving up: at a rejection rate of 30 % this never happens
MOST_PARTS = 64  # of a whole model; the development models have 8 to 29, the authors' 67 at most
LEAST_PARTS = 3  # of what is given
RESTORABLE = frozenset(PartLabel) - {PartLabel.DOOR, PartLabel.DRAWER, PartLabel.UNKNOWN}


def make_specimen(seed: int, index: int, points: int = 512) -> Specimen:
    """Returns the specimen number `index` of the furniture of `seed`, with this many surface points on each node.

    Raises:
        ValueError: if `seed` or `index` is negative, or no model that works is found.
    """
    if min(seed, index) < 0:
        raise ValueError(f"`seed` and `index` must not be negative: got {seed} and {index}")
    rng = np.random.default_rng([seed, index])
    name = f"synth_{seed}_{index:07d}"
    for _ in range(ATTEMPTS):
        blueprint, made = draw_made(rng)
        try:
            tidy, absent = repaired(blueprint, made, rng)
        except ValueError:
            continue  # no room for handles between doors that slide past one another
        if len(tidy.parts) > MOST_PARTS or faults_of(tidy):
            continue
        noise = draw_noise(rng, tidy, blueprint.family, absent)
        try:
            specimen = with_noise(name, blueprint.family, tidy, noise, points)
        except GraphError:
            continue  # a door stretched or opened until no border lies along its pin
        fits = len(specimen.asset.parts) >= LEAST_PARTS and len(specimen.whole.parts) <= MOST_PARTS
        if fits and not faults_in(specimen):  # a stretched front may strike what it just passed
            return as_exported(replace(specimen, kind=kind_of_piece(blueprint)), noise)
    raise ValueError(f"no sound model was found for {name} in {ATTEMPTS} draws")


def with_noise(name: str, family: str, tidy: Asset, noise: ModellingNoise, points: int = 512) -> Specimen:
    """Returns a tidy model with this modelling noise and ground truth, boards still plain (see `as_exported`).

    Raises:
        GraphError: if a door cannot be said in the graph's codes any more.
    """
    whole, misfits = apply_noise(tidy, noise)
    contacts = parse_graph(whole, ParsingConfig(points=points, seed=noise.seed % 2**32))
    truth = with_true_edges(contacts, whole)
    removable = removable_parts(whole, truth)
    given, flaws = as_given(whole, noise, removable)
    whole, truth = _with_names_given(whole, truth, given)
    apart = pairs_apart(contacts, truth)
    return Specimen(name, family, given, whole, truth, removable, (*misfits, *flaws), apart)


def as_exported(specimen: Specimen, noise: ModellingNoise) -> Specimen:
    """Returns the specimen with its faces drawn as the modelling noise states.

    Nothing moves by more than an edge is broken, so that motions stay true; contacts are looked at again where edges
    were broken: what barely touched may not touch any more.
    """
    fine = tessellated(specimen.whole, noise.density, noise.edge)
    whole = tessellated(fine, both_sides=noise.both_sides)
    if whole is specimen.whole:
        return specimen
    drawn = {part.id: part.surfaces for part in whole.parts}
    parts = tuple(replace(part, surfaces=drawn[part.id]) for part in specimen.asset.parts)
    given = replace(specimen.asset, parts=parts)
    if noise.density not in STEPS:
        return replace(specimen, asset=given, whole=whole)
    parted = _parted(specimen, fine, CUT * noise.edge)
    truth = without_contacts(specimen.truth, parted)
    apart = parted & {frozenset(ends_of(edge)) for edge in truth.edges}  # what is left of them are rails and hinges
    return replace(specimen, asset=given, whole=whole, truth=truth, apart=specimen.apart | apart)


def _parted(plain: Specimen, fine: Asset, reach: float) -> frozenset[frozenset[str]]:
    """Returns the pairs that touch in a plain specimen and not any more where each surface lies up to `reach` deeper.

    Only those that are near enough to parting are looked at as they are drawn now.
    """
    places = {part.id: k for k, part in enumerate(fine.parts)}
    ends = (ends_of(edge) for edge in plain.truth.edges if frozenset(ends_of(edge)) not in plain.apart)
    pairs = [(places[a], places[b]) for a, b in ends]
    tolerance = ParsingConfig().mesh_tolerance * fine.extent
    sure = set(touching_pairs([p.mesh for p in plain.whole.parts], pairs, max(tolerance - 2 * reach, 0.0)))
    doubtful = [pair for pair in pairs if pair not in sure]
    left = set(touching_pairs([p.mesh for p in fine.parts], doubtful, tolerance))
    return frozenset(frozenset((fine.parts[a].id, fine.parts[b].id)) for a, b in doubtful if (a, b) not in left)


def _with_names_given(whole: Asset, truth: FunctionalGraph, given: Asset) -> tuple[Asset, FunctionalGraph]:
    """Returns both with the names that the given parts have."""
    sources = {part.id: part.source for part in given.parts}
    parts = tuple(replace(p, source=sources.get(p.id, p.source)) for p in whole.parts)
    nodes = tuple(replace(n, source_name=p.source.name) for n, p in zip(truth.nodes, parts, strict=True))
    return replace(whole, parts=parts), replace(truth, nodes=nodes)


def removable_parts(whole: Asset, truth: FunctionalGraph) -> frozenset[str]:
    """Returns the parts without which everything still hangs on something: none that moves, rides unseen or carries."""
    moving = {joint.part for joint in (*whole.joints, *whole.small_joints)}
    keep = moving | carriers(truth)
    able = (p for p in whole.parts if p.label in RESTORABLE and p.id not in keep)
    return frozenset(p.id for p in able if p.carried_by is None or p.label is PartLabel.HANDLE)
