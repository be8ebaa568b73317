"""Pictures beside the tables: far models with their nearest training model, and what is wrong, in red."""

import io

import numpy as np
import pytest
from measured_cabinets import DOOR, cabinet
from PIL import Image

from grafu.evaluation import pictures
from grafu.evaluation.dataset import ModelRef
from grafu.evaluation.methods import Method, made_by
from grafu.evaluation.moving_parts import counted_parts
from grafu.evaluation.perform import method_facts
from grafu.evaluation.pictures import SIZE, picture_files
from grafu.evaluation.records import ModelFacts, TruthRecord
from grafu.evaluation.result_tables import models_table
from grafu.evaluation.results import Results
from grafu.evaluation.table import Column, ResultTable
from grafu.evaluation.tasks import EvaluationPlan

REF = ModelRef("synth_1_0000001", "made", seed=1, number=1)
PLAN = EvaluationPlan("data", (REF,), (Method("rule"),), ("models", "ood"))
FAR = (Column("rank", "Rank", "count"), Column("model", "Model"), Column("nearest", "Nearest training model"))


def opened(data: bytes) -> np.ndarray:
    return np.array(Image.open(io.BytesIO(data)).convert("RGB")).astype(int)


def reds(picture: np.ndarray) -> int:
    """Returns how many pixels are of the red that marks a fault: neither handles nor drawers are as bright."""
    return int(((picture[..., 0] > 150) & (picture[..., 1] < 60) & (picture[..., 2] < 60)).sum())


def results_of(asset, stated) -> Results:
    """Returns what was found of the cabinet: its door is built as another annotation states it."""
    result = made_by(Method("annotation"), stated, stated.name, joints_alone=True)
    truth = counted_parts(asset)
    facts = ModelFacts(category="Cabinet", parts=tuple(map(TruthRecord.of, truth)), fingerprint=(1.0,), features=(1.0,))
    return Results({REF.id: facts}, {"rule": {REF.id: method_facts(asset, result)}})


@pytest.fixture
def shown(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pictures, "load_model", lambda _: cabinet())


@pytest.mark.usefixtures("shown")
def test_a_model_with_a_fault_is_shown_as_annotated_and_as_built_with_the_part_in_red() -> None:
    results = results_of(cabinet(), cabinet(hinge="right", handle_at=-0.42))
    assert f"{DOOR}: " in str(models_table(results).rows[0][-1])
    files = picture_files(PLAN, results, (models_table(results),))
    assert set(files) == {"worst.png"}
    picture = opened(files["worst.png"])
    assert picture.shape[1] == 2 * SIZE[0]
    assert reds(picture[:, : SIZE[0]]) > 500
    assert reds(picture[:, SIZE[0] :]) > 500
    assert picture_files(PLAN, results, (models_table(results),)) == files  # the same bytes again


@pytest.mark.usefixtures("shown")
def test_a_model_without_a_fault_is_not() -> None:
    results = results_of(cabinet(), cabinet())
    assert picture_files(PLAN, results, (models_table(results),)) == {}


@pytest.mark.usefixtures("shown")
def test_a_far_model_stands_beside_its_nearest_training_model() -> None:
    rows = ((1, REF.id, "synth_0_0000002"), (2, REF.id, "synth_0_0000003"))
    files = picture_files(PLAN, Results({}), (ResultTable("ood", "t", FAR, rows),))
    picture = opened(files["ood.png"])
    assert picture.shape[1] == 3 * SIZE[0]
    half = picture.shape[0] // 2
    first, second = picture[:half], picture[half:]
    nearest = [row[:300, 2 * SIZE[0] :] for row in (first, second)]
    assert not np.array_equal(*nearest)  # another training model each
    assert np.array_equal(first[:300, : SIZE[0]], second[:300, : SIZE[0]])
