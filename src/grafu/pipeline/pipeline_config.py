"""What the user chose for a run, and the configurations of the stages that no setting reaches."""

from collections.abc import Mapping
from dataclasses import field, replace
from typing import final

from grafu.dataclass import dataclass
from grafu.graph.parse import ParsingConfig
from grafu.joints.config import RealizationConfig
from grafu.pipeline.settings import Settings
from grafu.templates.template import HandleTemplate
from grafu.visible import ShortRepr


@final
@dataclass(frozen=True)
class PipelineConfig(ShortRepr):
    """What the user chose, and the configurations of the stages that no setting reaches."""

    settings: Settings = Settings()
    """The user's choices; the motion source and how the input is read are passed on their own."""
    own_handles: Mapping[str, HandleTemplate] = field(default_factory=dict)
    """The user's handle templates by id."""
    parsing: ParsingConfig = ParsingConfig()
    realization: RealizationConfig = RealizationConfig()

    @property
    def joints(self) -> RealizationConfig:
        """The configuration of joints, as far as the settings allow."""
        hinge = replace(self.realization.hinge, preferred=self.settings.hinge or self.realization.hinge.preferred)
        return replace(self.realization, trim=self.realization.trim and self.settings.trim, hinge=hinge)
