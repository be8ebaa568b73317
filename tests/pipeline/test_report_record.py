"""Records of a report: what is written is read again, and what is wrong is refused."""

import json
import subprocess
import sys
from dataclasses import FrozenInstanceError
from math import inf, nan
from pathlib import Path

import pytest
from pydantic import ValidationError

from grafu.pipeline.report_record import Count, FiniteFloat, Ratio, ReportRecord, described, stated
from grafu.vocabulary import PartLabel

SAMPLE = Path(__file__).parent.parent.parent / "samples" / "chest.glb"
GIVEN = {"name": "door", "size": 2, "score": 1, "category": PartLabel.DOOR}
PLAIN = {"name": "door", "size": 2.0, "score": 1.0, "category": "door", "count": 0, "inner": [], "by_name": {}}


class InnerRecord(ReportRecord):
    """One of several."""

    length: FiniteFloat = stated(description="metres")


class OuterRecord(ReportRecord):
    """One with others."""

    name: str = stated(description="its name")
    size: float | None = stated(description="metres; null: none")
    score: Ratio = stated(description="0..1")
    category: PartLabel = stated(description="its category")
    count: Count = stated(default=0, description="how many")
    inner: tuple[InnerRecord, ...] = stated(default=(), description="the others")
    by_name: dict[str, tuple[str, ...]] = stated(default_factory=dict, description="lists of words")


def test_what_is_written_is_read_again() -> None:
    record = OuterRecord(**GIVEN, inner=(InnerRecord(length=0.1),), by_name={"a": ("b", "c")})

    assert record.to_json() == {**PLAIN, "inner": [{"length": 0.1}], "by_name": {"a": ["b", "c"]}}
    assert OuterRecord.read(record.to_json()) == record
    assert OuterRecord.read_json(json.dumps(record.to_json())) == record


def test_whole_numbers_are_written_as_the_floats_that_they_are() -> None:
    assert json.dumps(OuterRecord(**GIVEN).to_json()) == json.dumps(PLAIN)


def test_a_record_is_changed_by_making_another() -> None:
    record = OuterRecord(**GIVEN)

    assert record.with_changes(size=None).to_json() == {**PLAIN, "size": None}
    with pytest.raises(FrozenInstanceError):
        record.size = 3.0  # type: ignore[misc]
    with pytest.raises(TypeError, match="colour"):
        record.with_changes(colour="red")
    with pytest.raises(TypeError):
        OuterRecord(name="door")  # type: ignore[call-arg]


@pytest.mark.parametrize(
    "wrong",
    [
        {"score": 1.5},
        {"score": -0.5},
        {"score": nan},
        {"count": -1},
        {"count": 0.5},
        {"category": "window seat"},
        {"inner": [{"length": inf}]},
        {"inner": [{}]},
        {"other": 1},
    ],
    ids=str,
)
def test_what_is_wrong_is_refused(wrong: dict[str, object]) -> None:
    assert OuterRecord.read(PLAIN).to_json() == PLAIN
    with pytest.raises(ValidationError, match=next(iter(wrong))):
        OuterRecord.read({**PLAIN, **wrong})


def test_fields_are_described_without_their_conditions() -> None:
    assert described(OuterRecord)["score"] == (float, "0..1")
    assert described(OuterRecord)["inner"] == (tuple[InnerRecord, ...], "the others")


def test_a_run_writes_its_report_without_what_reads_it(tmp_path: Path) -> None:
    options = ["--formats", "glb", "--no-page"]
    code = (
        "import sys\nfrom grafu.cli.main import main\n"
        f"code = main(['functionalize', {str(SAMPLE)!r}, '--out', {str(tmp_path)!r}, *{options}])\n"
        "print(code, 'pydantic' in sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)

    assert done.stdout.splitlines()[-1] == "0 False"
    assert (tmp_path / "chest" / "report.json").is_file()
