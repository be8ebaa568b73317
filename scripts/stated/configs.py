"""Tables of configurations, drawn from the values themselves: no page repeats a number of a run by hand."""

from collections.abc import Mapping, Sequence
from dataclasses import fields, is_dataclass
from typing import Any

from grafu.network.config import GraFuConfig
from grafu.training.config import BASE, CONFIGS, PAPER
from grafu.training.departures import DEPARTURES
from grafu.training.loss_config import OFFICIAL
from grafu.training.loss_config import PAPER as PAPER_LOSS
from stated.store import drawn_table

Flat = dict[str, str]


def training_configs() -> str:
    """Returns in what the named runs differ."""
    return differing({name: flat(config) for name, config in CONFIGS.items()})


def loss_choices() -> str:
    """Returns in what the losses of `base`, the paper and the authors' code differ."""
    return differing({"`base`": flat(BASE.loss), "paper": flat(PAPER_LOSS), "authors' code": flat(OFFICIAL)})


def paper_departures() -> str:
    """Returns where `base` departs from `--config paper`: name, fields, both values, what the paper's choice is."""
    ours, theirs = flat(BASE), flat(PAPER)
    rows: list[list[str]] = []
    for one in DEPARTURES:
        named = [inner for name in one.fields for inner in _fields_of(name, ours, theirs)]
        for place, field in enumerate(named):
            values = [config.get(field, "the paper's") for config in (ours, theirs)]
            first = place == 0
            rows.append([f"`{one.name}`" if first else "", f"`{field}`", *values, one.taken_back if first else ""])
    heads = ["departure", "field", "`base`", "`paper`", "taken back, it is"]
    return drawn_table([heads, *rows])


def _fields_of(name: str, ours: Flat, theirs: Flat) -> list[str]:
    """Returns a field or, of weights by name, each that differs."""
    inner = [key for key in ours if key == name or key.startswith(f"{name}.")]
    return [key for key in inner if ours[key] != theirs.get(key)]


def network_config() -> str:
    """Returns the sizes and choices of the network that ships."""
    return drawn_table([["field of `GraFuConfig`", "value"], *([f"`{k}`", v] for k, v in flat(GraFuConfig()).items())])


def differing(configs: Mapping[str, Flat]) -> str:
    """Returns a table of the fields that are not alike in all configs."""
    names = list(dict.fromkeys(name for config in configs.values() for name in config))
    rows = [[f"`{name}`", *(config.get(name, "the paper's") for config in configs.values())] for name in names]
    kept: Sequence[list[str]] = [row for row in rows if len(set(row[1:])) > 1]
    heads = [
        head if "`" in head or " " in head or (head == "paper" and len(configs) == 3) else f"`{head}`"
        for head in configs
    ]
    return drawn_table([["field", *heads], *kept])


def flat(config: Any, prefix: str = "") -> Flat:
    """Returns the fields of a dataclass and of those within it, in words, by their dotted names."""
    found: Flat = {}
    for field in fields(config):
        value = getattr(config, field.name)
        if is_dataclass(value):
            found |= flat(value, f"{prefix}{field.name}.")
        elif isinstance(value, tuple) and value and isinstance(value[0], tuple):
            found |= {f"{prefix}{field.name}.{name}": said(item) for name, item in value}
        else:
            found[prefix + field.name] = said(value)
    return found


def said(value: object) -> str:
    """Returns a value as a table has it."""
    if value is None:
        return "none"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.4g}"
    if isinstance(value, tuple):
        return ", ".join(map(said, value))
    return str(value)
