"""What a page that stays open shows of a model: its header, panel and tables as markup, its 3D view as data.

The same tables and the same view as in `report.html`; what corrects a fault is a button that acts, not one that copies.
"""

from typing import Any, final

from grafu.articulation.articulated_object import ArticulatedObject
from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.graph.completion import GraphCompletion
from grafu.pipeline.report_schema import Report
from grafu.pipeline.verdict import verdict_of
from grafu.processes.cache import NO_CACHE, Cache
from grafu.viewer.model_page import header_facts, joint_panel, report_sections, verdict_view
from grafu.viewer.scene_data import scene_data
from grafu.viewer.shell import joined, tag


@final
@dataclass(frozen=True)
class LivePage:
    """Markup by the place that it takes on the page, the tables of the view, its images as URIs, and its buffer."""

    markup: dict[str, str]
    scene: dict[str, Any]
    textures: list[str]
    buffer: bytes


def live_page(
    asset: Asset,
    articulated: ArticulatedObject,
    completion: GraphCompletion,
    report: Report,
    cache: Cache = NO_CACHE,
) -> LivePage:
    """Returns what is shown of a model; surfaces that the `cache` holds are not packed again."""
    scene = scene_data(articulated, report, cache)
    markup = live_markup(asset, articulated, completion, report)
    tables = {name: table for name, table in scene.tables.items() if name != "textures"}
    return LivePage(markup, tables, list(scene.tables["textures"]), scene.buffer)


def live_markup(
    asset: Asset, articulated: ArticulatedObject, completion: GraphCompletion, report: Report
) -> dict[str, str]:
    """Returns the markup of a model by the place that it takes on the page: header, panel, sections."""
    lead = "A click on an option applies it."
    verdict = verdict_view(report, verdict_of(report), lead)
    header = joined([tag("h1", report.input.name), verdict, header_facts(asset, report)])
    return {
        "header": str(header),
        "panel": str(joint_panel(articulated)),
        "sections": str(joined(report_sections(report, completion, lead=""))),
    }
