"""All additions as tables of steps, and the one loop that runs them. What a step adds is its own business.

Tops, drawer boxes and boards come before joints, which must respect them; all else comes after them, and respects them.
"""

from collections.abc import Callable, Iterable
from dataclasses import replace
from typing import final

from grafu.additions.carcass.step import add_carcass_boards
from grafu.additions.compartment.complete import cut_compartments
from grafu.additions.config import AdditionConfig
from grafu.additions.door_frame.complete import add_door_frame
from grafu.additions.drawer_box.complete import add_drawer_boxes
from grafu.additions.handle.step import FrontConfig, add_chosen, add_grasps, clear_fronts
from grafu.additions.interior.turned import InteriorChoice, add_panels
from grafu.additions.step import StepRequest, StepResult
from grafu.additions.top.step import TopChoice, add_tops
from grafu.dataclass import dataclass
from grafu.scene.scene import Scene


@final
@dataclass(frozen=True)
class Step:
    """One kind of addition: its name, and what adds it, given its part of the config.

    What the user rejected is left out again, unless it `is_chosen` by hand.
    """

    name: str
    add: Callable[[Scene, StepRequest, AdditionConfig], StepResult]
    is_chosen: bool = False


def _fronts(config: AdditionConfig) -> FrontConfig:
    return FrontConfig(config.handles, config.grips, config.grasp, config.fronts)


def _interior(config: AdditionConfig) -> InteriorChoice:
    return InteriorChoice(config.interior, config.interior_sizes, config.compartments)


BEFORE_JOINTS = (
    Step("tops", lambda scene, asked, config: add_tops(scene, asked, TopChoice(config.top, config.replaces_top))),
    Step("door frames", lambda scene, asked, config: add_door_frame(scene, asked, config.door_frame)),
    Step("compartments", lambda scene, asked, config: cut_compartments(scene, asked, config.solid_bodies)),
    Step("drawer boxes", lambda scene, asked, config: add_drawer_boxes(scene, asked, config.drawer_boxes)),
    Step("carcass boards", lambda scene, asked, config: add_carcass_boards(scene, asked, config.carcass)),
)
ON_FRONTS = (
    Step("replaced handles", lambda scene, asked, config: clear_fronts(scene, asked, _fronts(config))),
    Step("handles and grips", lambda scene, asked, config: add_grasps(scene, asked, _fronts(config))),
    Step("chosen fronts", lambda scene, asked, config: add_chosen(scene, asked, _fronts(config)), is_chosen=True),
)
INSIDE = (Step("interiors", lambda scene, asked, config: add_panels(scene, asked, _interior(config))),)


def run_steps(steps: Iterable[Step], scene: Scene, request: StepRequest, config: AdditionConfig) -> StepResult:
    """Returns what all steps made, one after the other; what one adds to a moving part, the next knows of.

    Raises:
        TemplateError: if the config names a handle that there is not.
    """
    whole = StepResult(scene)
    request = replace(request, rejected=config.rejected)
    for step in steps:
        made = step.add(whole.scene, request, config)
        if not step.is_chosen:
            made = made.without(config.rejected, whole.scene)
        request = replace(request, plan=request.plan.with_attached(made.attached))
        whole = whole.then(made)
    return whole
