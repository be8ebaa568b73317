"""A folder in the exact layout of FurFun and of HSSD goes through training, evaluation and functionalization."""

import csv
import json
from pathlib import Path

import pytest

from grafu.cli.main import main
from grafu.data.furfun.layout import find_layout
from grafu.evaluation.dataset import find_models, load_model
from hssd_models import hssd_model
from predictions import cabinet

pytestmark = [pytest.mark.slow, pytest.mark.usefixtures("remembered")]

TINY = ["--config", "tiny", "--steps", "2", "--threads", "1", "--jobs", "1"]


@pytest.fixture(scope="module")
def furfun(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """FurFun's layout: graphs_functional, graphs_unfunctional, part_geometries, splits/{full,subset}_split.json."""
    folder = tmp_path_factory.mktemp("furfun") / "FurFun-233"
    made = ["synth", "--format", "furfun", "--count", "6", "--seed", "3", "--points", "64", "--jobs", "1"]
    assert main([*made, "--out", str(folder)]) == 0
    models = sorted(path.name for path in (folder / "graphs_functional").iterdir())
    for name, kept in (("full_split", models), ("subset_split", models[1:])):
        split = {"train_mids": kept[:-2], "val_mids": kept[-2:-1], "test_mids": kept[-1:]}
        (folder / "splits" / f"{name}.json").write_text(json.dumps(split))
    return folder


def rows(table: Path) -> list[dict[str, str]]:
    with table.open(newline="") as file:
        return list(csv.DictReader(file))


def trained(data: Path, out: Path, split: str = "subset_split") -> Path:
    """Trains on a release for two steps; returns the exported file."""
    options = ["--data", str(data), "--split", split]
    assert main(["train", *TINY, *options, "--out", str(out / "run")]) == 0
    weights = out / "weights.onnx"
    assert main(["train", *options, "--out", str(out / "run"), "--export", str(weights)]) == 0
    return weights


def evaluated(data: Path, weights: Path, out: Path, *more: str) -> list[dict[str, str]]:
    words = ["--weights", str(weights), "--methods", "annotation,network", "--tables", "motion", "--jobs", "1", *more]
    assert main(["evaluate", "--data", str(data), *words, "--out", str(out)]) == 0
    assert f"--weights {weights}" in (out / "tables" / "index.md").read_text()
    return rows(out / "tables" / "motion.csv")


def test_furfun_goes_through(furfun: Path, tmp_path: Path) -> None:
    assert find_layout(furfun).kind == "furfun"
    weights = trained(furfun, tmp_path)
    table = evaluated(furfun, weights, tmp_path / "evaluated", "--split", "full_split")
    assert {row["method"].partition(":")[0] for row in table} >= {"annotation", "network"}
    test_model = json.loads((furfun / "splits" / "full_split.json").read_text())["test_mids"][0]
    rows_of = [json.loads(line) for line in (tmp_path / "evaluated" / "rows.jsonl").read_text().splitlines()]
    assert {row["task"]["model"] for row in rows_of} == {test_model}
    meshes = furfun / "part_geometries" / test_model
    words = ["--weights", str(weights), "--formats", "urdf,grafu-pred", "--no-page"]
    assert main(["functionalize", str(meshes), *words, "--out", str(tmp_path / "results")]) == 0
    result = tmp_path / "results" / test_model
    assert (result / "model.urdf").is_file()
    assert list((result / "prediction").glob("*_pred.json"))


def test_hssd_goes_through(furfun: Path, tmp_path: Path) -> None:
    weights = trained(furfun, tmp_path, "full_split")
    annotated = hssd_model(cabinet()).save(tmp_path / "hssd" / "a1b2").parent.parent
    table = evaluated(annotated, weights, tmp_path / "with_truth")
    assert {row["method"].partition(":")[0] for row in table} >= {"annotation", "network"}

    release = tmp_path / "hssd_test"  # the authors' own layout, whose inputs state no motion
    (release / "graph_unfunc").mkdir(parents=True)
    model = sorted(path.name for path in (furfun / "graphs_unfunctional").iterdir())[0]
    (furfun / "graphs_unfunctional" / model).rename(release / "graph_unfunc" / model)
    (furfun / "part_geometries").rename(release / "part_geometries")
    assert find_layout(release).kind == "hssd_test"
    (ref,) = find_models(release)
    assert load_model(ref).joints == ()
    words = ["--methods", "network", "--weights", str(weights), "--tables", "motion", "--jobs", "1"]
    assert main(["evaluate", "--data", str(release), *words, "--out", str(tmp_path / "without_truth")]) == 0
    glb = annotated / "a1b2" / "a1b2.glb"
    assert (
        main(["functionalize", str(glb), "--weights", str(weights), "--no-page", "--out", str(tmp_path / "out")]) == 0
    )
    assert (tmp_path / "out" / "a1b2" / "model.urdf").is_file()


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["train", "--data", "{}", "--split", "none"], "holds no split `none`: it has full_split, subset_split"),
        (["train", "--split", "full_split"], "only a FurFun release has splits"),
    ],
)
def test_a_split_that_is_not_there_is_one_line(
    words: list[str], said: str, furfun: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = [word.replace("{}", str(furfun)) for word in words]
    assert main([*words, *TINY, "--out", str(tmp_path / "run")]) == 2
    error = capsys.readouterr().err
    assert said in error
    assert error.count("\n") == 1
