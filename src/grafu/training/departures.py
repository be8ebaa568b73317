"""Where `base` departs from the paper, field by field, and the run that takes one departure back. It trains nothing."""

from collections.abc import Mapping
from dataclasses import fields, is_dataclass, replace
from types import MappingProxyType
from typing import Any, Final, final

from grafu.dataclass import dataclass
from grafu.training.config import BASE, PAPER, TrainingConfig

_SIZES: Final = ("steps", "precision")
"""Fields that are no departures: how long a run is, and how its numbers are rounded."""


@final
@dataclass(frozen=True)
class Departure:
    """What `base` does otherwise: `taken_back` states in words what the paper has, `fields` are those that differ."""

    name: str
    taken_back: str
    fields: tuple[str, ...]


def _of(name: str, taken_back: str, *names: str) -> Departure:
    return Departure(name, taken_back, names or (f"network.{name}",))


def _all_of(part: str) -> tuple[str, ...]:
    """Returns the fields of a part in which the paper's config and `base` differ."""
    ours, theirs = flat_values(getattr(BASE, part)), flat_values(getattr(PAPER, part))
    return tuple(f"{part}.{name}" for name in ours if ours[name] != theirs[name])


def flat_values(config: Any, prefix: str = "") -> dict[str, Any]:
    """Returns the fields of a config and of those within it by their dotted names."""
    found: dict[str, Any] = {}
    for field in fields(config):
        value = getattr(config, field.name)
        name = f"{prefix}{field.name}"
        found |= flat_values(value, f"{name}.") if is_dataclass(value) else {name: value}
    return found


_FACTS: Final = ("loss.body", "loss.ajar", "loss.piece")
DEPARTURES: Final[tuple[Departure, ...]] = (
    _of("points_frame", "parts' points stand where they are in the object"),
    _of(
        "second_grouping",
        "points in as many groups as half of them, of 32 within a radius, and grouped once more",
        "network.second_grouping",
        "features.anchors",
        "features.neighbours",
        "features.radius",
    ),
    _of("pair_features", "pairs see centres and gaps, not how faces lie"),
    _of("margins", "nodes do not see how far they are from the object's faces"),
    _of("pair_boxes", "pair heads see predicted boxes, not the given ones"),
    _of("pair_edges", "pair heads see slots and boxes, not the encoded edge"),
    _of("free_boxes", "free slots say boxes in the object's frame, not beside nodes"),
    _of("visibility", "nodes do not see what of them is visible"),
    _of("kinds", "the paper's four kinds of edges", "network.kinds", "features.kinds"),
    _of("names", "names are not read", "network.names", "network.name_dropout"),
    _of("materials", "materials are not seen", "network.materials", "network.material_dropout"),
    _of("facts", "no facts of the whole piece", "network.facts", *_FACTS),
    _of("slots", "a budget of 55 slots with padding slots"),
    _of("symmetric_edges", "both directions of an edge learn by themselves"),
    _of("geometry_dropout", "points are never hidden"),
    Departure("losses", "the paper's losses", tuple(n for n in _all_of("loss") if n not in _FACTS)),
    Departure("mix", "the natural pair and 17 corrupted copies, weights of the paper's table", _all_of("mix")),
    Departure("sampling", "each graph of a batch is of another model", _all_of("sampling")),
    Departure("optimiser", "Adam at 3e-4 under a long cosine, no warm-up, no average", _all_of("optimiser")),
    _of("mirror_axes", "mirrored across X or Y", "mirror_axes"),
)
"""All of them; the table of docs/training.md is drawn from here."""


def taken_back(config: TrainingConfig, departure: Departure) -> TrainingConfig:
    """Returns a config with the paper's choice in place of one departure, in proportion to the config's own sizes."""
    values = _in_proportion(config)
    made: TrainingConfig = _replaced(config, {name: values[name] for name in departure.fields})
    return made


def without_departures(config: TrainingConfig) -> TrainingConfig:
    """Returns a config of the same size and length that makes all of the paper's choices."""
    values = _in_proportion(config)
    every = {name: values[name] for departure in DEPARTURES for name in departure.fields}
    made: TrainingConfig = _replaced(config, every)
    return made


def uncovered() -> tuple[str, ...]:
    """Returns the fields in which `base` is not the paper's config and that no departure names."""
    ours, theirs = flat_values(BASE), flat_values(PAPER)
    named = {name for departure in DEPARTURES for name in departure.fields} | set(_SIZES)
    return tuple(name for name in ours if ours[name] != theirs[name] and name not in named)


def _in_proportion(config: TrainingConfig) -> Mapping[str, Any]:
    """Returns the paper's values by field, where they are numbers of a run in proportion to this config's."""
    period = PAPER.optimiser.period
    assert period is not None
    anchors = config.features.points * PAPER.features.anchors // PAPER.features.points
    graphs = config.sampling.models * config.sampling.copies
    scaled = {
        "features.anchors": anchors,
        "features.neighbours": min(PAPER.features.neighbours, config.features.points),
        "sampling.models": graphs,
        "sampling.spread": graphs,
        "optimiser.period": config.steps * period // PAPER.steps,
    }
    return MappingProxyType(flat_values(PAPER) | scaled)


def _replaced(config: Any, values: Mapping[str, Any]) -> Any:
    own = {name: value for name, value in values.items() if "." not in name}
    inner: dict[str, dict[str, Any]] = {}
    for name, value in values.items():
        part, dot, rest = name.partition(".")
        if dot:
            inner.setdefault(part, {})[rest] = value
    return replace(config, **own, **{part: _replaced(getattr(config, part), rest) for part, rest in inner.items()})
