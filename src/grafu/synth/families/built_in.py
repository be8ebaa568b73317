"""What stands or hangs in kitchens and buildings and is no furniture: appliances, doors and windows of buildings."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from grafu.synth.appliances.appliance import Appliance, ApplianceKind, drawn_appliance
from grafu.synth.appliances.washing_machine import WashingMachine, drawn_washing_machine
from grafu.synth.fronts.layout import LeafStyle
from grafu.synth.openings.door import DoorSpec, drawn_door
from grafu.synth.openings.window import Kind, WindowSpec, drawn_window
from grafu.synth.sampling.chance import between, chance, count, pick
from grafu.synth.sampling.style import draw_finish, draw_style

APPLIANCES: Mapping[ApplianceKind, float] = {"oven": 0.38, "dishwasher": 0.22, "microwave": 0.4}
WINDOWS: Mapping[Kind, float] = {"casement": 0.35, "pair": 0.25, "sash": 0.15, "awning": 0.13, "hopper": 0.12}
LEAVES: Mapping[LeafStyle, float] = {
    "slab": 0.45, "two panels": 0.2, "raised panel": 0.08, "shaker": 0.07, "glass": 0.12, "muntins": 0.08
}  # fmt: skip
GLAZED: Mapping[ApplianceKind, float] = {"oven": 0.75, "microwave": 0.7, "dishwasher": 0.0}  # doors with a window
WASHING_MACHINES = 0.2  # of appliances
WITH_BUTTONS = 0.4  # of ovens with knobs


def appliance(rng: np.random.Generator) -> Appliance | WashingMachine:
    """Returns an oven, a dishwasher, a microwave oven or a washing machine, with racks, knobs and buttons as parts."""
    if chance(rng, WASHING_MACHINES):
        machine = drawn_washing_machine(rng, "washing_machine")
        return replace(machine, finish=draw_style(rng, {"appliance": 1.0}).finish)
    kind = pick(rng, APPLIANCES)
    drawn = drawn_appliance(rng, kind, kind)
    buttons = count(rng, 1, 4) if kind == "oven" and chance(rng, WITH_BUTTONS) else drawn.buttons
    finish = draw_style(rng, {"appliance": 1.0}).finish
    return replace(drawn, buttons=buttons, finish=finish, window=chance(rng, GLAZED[kind]))


def building_door(rng: np.random.Generator) -> DoorSpec:
    """Returns a door of a building, of one or two leaves in a frame, with levers."""
    drawn = drawn_door(rng, "building_door")
    gap, finish = between(rng, (0.002, 0.005)), draw_finish(rng)
    return replace(drawn, lap=-gap, grip="lever", style=pick(rng, LEAVES), finish=finish)


def building_window(rng: np.random.Generator) -> WindowSpec:
    """Returns a window: side-hung, of two leaves, top-hung, bottom-hung, or with a sash that slides up."""
    return replace(drawn_window(rng, "window", pick(rng, WINDOWS)), finish=draw_finish(rng))
