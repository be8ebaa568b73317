"""The step of backs and bottoms: what is missing is said, and what is wanted or predicted is added."""

from typing import Final

from grafu.additions.carcass.complete import CarcassCompletion, complete_carcass
from grafu.additions.carcass.config import CarcassConfig
from grafu.additions.carcass.missing_panels import missing_panels
from grafu.additions.step import Deficiency, DeficiencyKind, StepRequest, StepResult
from grafu.scene.scene import Scene
from grafu.vocabulary import PartLabel

BOARDS: Final = frozenset({PartLabel.BACK_PANEL, PartLabel.BOTTOM_PANEL})


def add_carcass_boards(scene: Scene, request: StepRequest, config: CarcassConfig | None) -> StepResult:
    """Returns the scene with the backs and bottoms that it lacks.

    Without a config they are those that the completed graph expects or weighed; of the others it is only said what is
    missing.
    """
    wanted = request.boards if config is None else BOARDS
    made = (
        complete_carcass(scene, request.plan, config or CarcassConfig(), request.drawers, wanted)
        if wanted
        else CarcassCompletion(missing_panels(scene, request.plan, drawers=request.drawers))
    )
    return StepResult(
        scene.with_parts(addition.part for addition in made.additions),
        made.additions,
        refusals=made.refused,
        deficiencies=tuple(Deficiency(DeficiencyKind(one.what.value), "", one.why) for one in made.missing),
    )
