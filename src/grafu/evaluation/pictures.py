"""Pictures beside the tables: models far from training with their nearest training model, and the worst with faults.

Models are made again for them, one by one. The same rows give the same bytes.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Final

from grafu.articulation.articulated_object import ArticulatedObject, Visual, VisualRole
from grafu.asset.part import Asset
from grafu.errors import FunctionalizationError
from grafu.evaluation.curves import curves
from grafu.evaluation.dataset import ModelRef, load_model
from grafu.evaluation.methods import Method, made_by
from grafu.evaluation.moving_parts import raw_object
from grafu.evaluation.result_tables import part_faults
from grafu.evaluation.results import Results
from grafu.evaluation.table import ResultTable
from grafu.evaluation.tasks import EvaluationPlan
from grafu.geometry.appearance import Material, Surface
from grafu.joints.make_plan import plan_from_annotation
from grafu.joints.plan import RealizationPlan
from grafu.render.camera import three_quarter_view
from grafu.render.exposure import PictureStyle
from grafu.render.picture import (
    CATEGORY_COLORS,
    Picture,
    box_of,
    contact_sheet,
    encode_png,
    opened_values,
    posed_visuals,
    render,
)
from grafu.synth.generate import make_specimen

SIZE: Final = (420, 360)
"""Width and height of each picture, pixels."""
MOST: Final = 8
"""Models that are shown with what is wrong."""
_LETTERS = 36  # of a caption
_FAULTY: Final = Material("faulty", (0.80, 0.02, 0.02, 1.0), roughness=0.7)


def picture_files(plan: EvaluationPlan, results: Results, tables: Sequence[ResultTable]) -> dict[str, bytes]:
    """Returns `masking.svg`, `ood.png` and `worst.png`, as far as their tables were asked for and hold anything."""
    by_name = {table.name: table for table in tables}
    files = {}
    if "masking" in by_name and (drawn := curves(by_name["masking"])):
        files["masking.svg"] = drawn.encode()
    if "ood" in by_name and by_name["ood"].rows:
        files["ood.png"] = encode_png(_far_sheet(plan, by_name["ood"]))
    if "models" in by_name and (worst := _worst(plan, results, by_name["models"])):
        files["worst.png"] = encode_png(_fault_sheet(plan, results, worst))
    return files


def _far_sheet(plan: EvaluationPlan, table: ResultTable) -> Picture:
    """Returns a row for each model: as given, as built with its joints open, and the nearest training model."""
    names = [column.name for column in table.columns]
    models, pictures, captions = {ref.id: ref for ref in plan.models}, [], []
    for row in table.rows:
        model, nearest = str(row[names.index("model")]), str(row[names.index("nearest")])
        asset = load_model(models[model])
        seed, number = map(int, nearest.split("_")[1:])
        pictures += [_drawn(_as_given(asset)), _built(plan.ranked_method, models[model], asset)]
        pictures.append(_drawn(_as_given(make_specimen(seed, number, points=8).asset)))
        captions += [f"{model}, as given", f"{model}, as built", f"{nearest}, nearest in training"]
    return contact_sheet(pictures, [_short(caption) for caption in captions], columns=3)


def _worst(plan: EvaluationPlan, results: Results, table: ResultTable) -> list[str]:
    """Returns the models of which the method has most wrong, the worst first; none that it does right."""
    method = plan.ranked_method.spelled
    faulty = {outcome.model for outcome in results.outcomes(method) if part_faults(outcome)}
    names = [column.name for column in table.columns]
    ranked = [str(r[names.index("model")]) for r in table.rows if r[names.index("method")] == method]
    return [model for model in ranked if model in faulty][:MOST]


def _fault_sheet(plan: EvaluationPlan, results: Results, worst: Sequence[str]) -> Picture:
    """Returns a row for each model: as annotated and as built, both open, with parts that are wrong in red."""
    models, pictures, captions = {ref.id: ref for ref in plan.models}, [], []
    for model in worst:
        outcomes = [o for o in results.outcomes(plan.ranked_method.spelled) if o.model == model]
        faults = {o.truth.part: "; ".join(found) for o in outcomes if (found := part_faults(o))}
        asset = load_model(models[model])
        pictures.append(_drawn(raw_object(asset, plan_from_annotation(asset)), faults))
        pictures.append(_built(plan.ranked_method, models[model], asset, faults))
        captions += [f"{model}, as annotated", "; ".join(f"{part} {fault}" for part, fault in faults.items())]
    return contact_sheet(pictures, [_short(caption) for caption in captions], columns=2)


def _as_given(asset: Asset) -> ArticulatedObject:
    return raw_object(asset, RealizationPlan(()))


def _built(method: Method, ref: ModelRef, asset: Asset, faults: Mapping[str, str] = {}) -> Picture:
    """Returns what a method makes of a model; where it makes nothing, the model as it is given."""
    try:
        shown = made_by(method, asset, ref.id).object
    except FunctionalizationError:
        shown = _as_given(asset)
    return _drawn(shown, faults)


def _drawn(articulated: ArticulatedObject, faults: Mapping[str, str] = {}) -> Picture:
    """Returns an object with all joints open, coloured by category, parts with a fault in red."""
    visuals = posed_visuals(articulated, opened_values(articulated))
    shown = [_marked(visual, faults) for visual in visuals]
    return render(shown, three_quarter_view(box_of(shown), SIZE[0] / SIZE[1]), SIZE, PictureStyle(background="white"))


def _marked(visual: Visual, faults: Mapping[str, str]) -> Visual:
    """Returns a visual in the colour of its category, or in red."""
    if visual.role is VisualRole.HARDWARE:
        return visual
    usual = Material(visual.label.value, (*CATEGORY_COLORS[visual.label], 1.0), roughness=0.7)
    material = _FAULTY if visual.name in faults else usual
    return replace(visual, surfaces=tuple(Surface(s.mesh, material, normals=s.normals) for s in visual.surfaces))


def _short(text: str) -> str:
    return text if len(text) <= _LETTERS else text[: _LETTERS - 3] + "..."
