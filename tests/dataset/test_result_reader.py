"""Sets are read back, streamed, with the standard library alone; what is damaged is one line."""

import json
import re
import subprocess
import sys
import tarfile
from contextlib import suppress
from pathlib import Path
from random import Random

import pytest

from folders import contents
from grafu.dataset import load_dataset
from grafu.dataset.splits import SplitRatio
from grafu.dataset.write import ResultSetPlan, write_result_set
from grafu.errors import FunctionalizationError, OptionError, UnreadableAsset


@pytest.fixture(params=["tar", "folder"])
def stored(request: pytest.FixtureRequest, results: Path, tmp_path: Path) -> Path:
    out = tmp_path / "set"
    assert all(outcome.row for outcome in write_result_set([results], out, ResultSetPlan(format=request.param)))
    return out


def test_every_file_comes_back(stored: Path, results: Path) -> None:
    samples = {sample.name: sample for sample in load_dataset(stored)}

    assert samples.keys() == {"cabinet", "chest", "larger", "mirrored"}
    for name, sample in samples.items():
        assert dict(sample.files) == contents(results / name)
        assert sorted(sample.figures["files"]) == sorted(sample.files)
        assert sample.report == json.loads((results / name / "report.json").read_text())
        assert sample.report["schema"] == "grafu.report/1"
    assert "meshes" in {Path(name).parts[0] for name in samples["cabinet"].files}


def test_a_split_holds_its_models_and_all_splits_all(stored: Path) -> None:
    splits = {split: [s.name for s in load_dataset(stored, split)] for split in ("train", "validation", "test")}

    assert sorted(name for names in splits.values() for name in names) == ["cabinet", "chest", "larger", "mirrored"]
    for split, names in splits.items():
        assert {sample.figures["split"] for sample in load_dataset(stored, split)} == ({split} if names else set())


def test_a_sample_is_saved_as_a_result(stored: Path, results: Path, tmp_path: Path) -> None:
    from grafu.pipeline.result_folder import read_result

    (sample,) = [sample for sample in load_dataset(stored) if sample.name == "cabinet"]
    sample.save(tmp_path / "again")

    assert contents(tmp_path / "again") == contents(results / "cabinet")
    assert len(read_result(tmp_path / "again").report.joints) == 2


def test_the_standard_library_is_enough(stored: Path) -> None:
    code = (
        "import sys\nfrom grafu.dataset import load_dataset\n"
        f"print(sum(len(s.files['model.glb']) > 0 and bool(s.report) for s in load_dataset({str(stored)!r})))\n"
        "print(sorted({name.partition('.')[0] for name in sys.modules} - set(sys.stdlib_module_names)))"
    )
    said = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.splitlines()

    assert said[0] == "4"
    assert not {"numpy", "pydantic", "scipy", "pyarrow"} & set(eval(said[1]))


def test_what_is_no_set_or_no_split_is_refused_at_once(stored: Path, tmp_path: Path) -> None:
    with pytest.raises(UnreadableAsset, match=r"index\.jsonl"):
        load_dataset(tmp_path)
    with pytest.raises(OptionError, match="did you mean `train`"):
        load_dataset(stored, "trian")


@pytest.mark.parametrize("data", [b"", b"no tar", b"\0" * 512])
def test_a_damaged_shard_is_one_line(data: bytes, results: Path, tmp_path: Path) -> None:
    out = tmp_path / "set"
    list(write_result_set([results], out, ResultSetPlan()))
    for shard in out.glob("*.tar"):
        whole = shard.read_bytes()
        shard.write_bytes(data or whole[: len(whole) // 2])

    if data == b"\0" * 512:
        assert list(load_dataset(out)) == []  # the end of a tar: it holds nothing
        return
    with pytest.raises(UnreadableAsset, match="write the set again") as wrong:
        list(load_dataset(out))
    assert "\n" not in str(wrong.value)


def test_a_member_without_a_row_and_damaged_rows_are_refused(results: Path, tmp_path: Path) -> None:
    list(write_result_set([results / "chest"], tmp_path / "tar", ResultSetPlan()))
    (shard,) = (tmp_path / "tar").glob("*.tar")
    with tarfile.open(shard, "w") as other:
        other.add(results / "chest" / "model.glb", "chest.model.glb")
    list(write_result_set([results / "chest"], tmp_path / "folder", ResultSetPlan(format="folder")))
    (rows,) = (tmp_path / "folder").glob("*/metadata.jsonl")
    rows.write_text("[1]\n")

    for out in (tmp_path / "tar", tmp_path / "folder"):
        with pytest.raises(UnreadableAsset, match="damaged"):
            list(load_dataset(out))


def test_a_row_that_leads_elsewhere_reads_nothing_there(results: Path, tmp_path: Path) -> None:
    list(write_result_set([results / "chest"], tmp_path / "set", ResultSetPlan(format="folder")))
    (rows,) = (tmp_path / "set").glob("*/metadata.jsonl")
    (tmp_path / "secret").write_text("secret")
    rows.write_text(json.dumps({**json.loads(rows.read_text()), "files": ["../../../secret"]}) + "\n")

    with pytest.raises(FunctionalizationError):
        [sample.files["../../../secret"] for sample in load_dataset(tmp_path / "set")]


def test_the_package_webdataset_reads_the_same(results: Path, tmp_path: Path) -> None:
    webdataset = pytest.importorskip("webdataset")
    list(write_result_set([results], tmp_path / "set", ResultSetPlan()))

    shards = [str(path) for path in (tmp_path / "set").glob("*.tar")]
    found = {one["__key__"]: one for one in webdataset.WebDataset(shards, shardshuffle=False)}
    assert found.keys() == {"cabinet", "chest", "larger", "mirrored"}
    assert found["chest"]["model.glb"] == (results / "chest" / "model.glb").read_bytes()


@pytest.mark.parametrize(("page", "out"), [("research.md", "results/set"), ("datasets.md", "furniture")])
def test_the_lines_of_the_pages_read_a_set(
    page: str,
    out: str,
    results: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    text = (Path(__file__).parent.parent.parent / "docs" / page).read_text()
    code = next(code for code in re.findall(r"```python\n(.*?)```", text, re.DOTALL) if "grafu.dataset" in code)
    monkeypatch.chdir(tmp_path)
    list(write_result_set([results / "cabinet"], Path(out), ResultSetPlan(ratio=SplitRatio((100.0, 0.0, 0.0)))))

    exec(compile(code, page, "exec"), {})
    assert capsys.readouterr().out.startswith("cabinet ")
    assert len([line for line in code.splitlines() if line]) <= 5


def test_any_damage_to_a_shard_is_read_or_refused(results: Path, tmp_path: Path) -> None:
    list(write_result_set([results / "cabinet"], tmp_path / "set", ResultSetPlan()))
    (shard,) = (tmp_path / "set").glob("*.tar")
    whole, random = shard.read_bytes(), Random(0)
    heads = [k for k in range(0, len(whole), 512) if whole[k + 257 : k + 262] == b"ustar"]

    for _ in range(300):
        data = bytearray(whole)
        for _ in range(random.randint(1, 3)):
            data[random.choice(heads) + random.randrange(512)] = random.randrange(256)
        shard.write_bytes(data[: random.choice((len(data), random.randrange(len(data))))])
        with suppress(FunctionalizationError):
            assert all(len(sample.files) <= len(heads) for sample in load_dataset(tmp_path / "set"))
