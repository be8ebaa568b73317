"""Files under a budget: what it does not hold is simpler or left out, and said; the model is there all the same."""

import json

import pytest

from clocks import Clock
from grafu.api.saving import Saved, files_of
from grafu.geometry.budget import UNLIMITED, Budget
from grafu.pipeline.functionalize import Functionalized, functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.words import FaultKind
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.case.case import Case
from grafu.synth.fronts.layout import Door, Drawer, Stack
from grafu.templates.gallery import builtin_gallery

CABINET = Cabinet("made", Case(0.5, 0.9), Stack((Drawer(), Door()), (1.0, 3.0)))
FORMATS = ("glb", "urdf", "mjcf")
WITH_TIMES = {"report.json", "report.html"}
SIMPLER = ("got the mass", "collide as one box", "were not cut back", "near at rest", "no keyframe `open`")


def functionalized() -> Functionalized:
    return functionalize(make_cabinet(CABINET), MotionSource.ANNOTATION, builtin_gallery())


@pytest.fixture
def made() -> Functionalized:
    return functionalized()  # anew for each test: an object keeps masses and shapes that were worked out in time


@pytest.fixture(scope="module")
def plain() -> Saved:
    return saved(functionalized())


def saved(made: Functionalized, budget: Budget = UNLIMITED) -> Saved:
    return files_of(made, "made", FORMATS, None, budget=budget)


def page_of(found: Saved) -> str:
    return found.files["report.html"].decode()


def test_a_budget_that_holds_all_changes_no_byte(made: Functionalized, plain: Saved) -> None:
    found = saved(made, Budget.lasting(1e9))
    assert found.files.names == plain.files.names
    assert all(found.files[name] == plain.files[name] for name in plain.files.names if name not in WITH_TIMES)
    assert found.report.notes == plain.report.notes == ()
    assert "<canvas" in page_of(found)


def test_when_time_is_up_the_first_format_and_a_page_of_words_are_written(made: Functionalized, plain: Saved) -> None:
    clock = Clock()
    budget = Budget.lasting(1.0, clock=clock)
    clock.now = 2.0
    found = saved(made, budget)
    assert set(found.files.formats) == {"glb"}
    assert found.files["model.glb"] == plain.files["model.glb"]
    assert {"graph.json", "report.json", "report.html"} <= set(found.files.names)
    assert found.report.notes[0] == "left out for lack of time: urdf, mjcf; allow more time"
    assert found.report.notes[1].startswith("report.html has no 3D view and no pictures: it takes more time")
    assert json.loads(found.files["report.json"])["notes"] == list(found.report.notes)
    assert "<canvas" not in page_of(found)
    assert "left out for lack of time" in page_of(found)
    assert found.picture == b""
    assert found.report.verdict is not None
    assert [line.kind for line in found.report.verdict.lines].count(FaultKind.NOTED) == 2


@pytest.mark.parametrize("asks", [20.0, 60.0, 120.0, 240.0, 480.0])
def test_whenever_time_is_up_what_is_written_is_whole_and_what_is_not_is_said(
    made: Functionalized, asks: float
) -> None:
    found = saved(made, Budget.lasting(asks, clock=Clock(step=1.0)))
    said = " ".join(found.report.notes)
    written = set(found.files.formats)
    assert "glb" in written
    left_out = [name for name in FORMATS if name not in written]
    assert (f"left out for lack of time: {', '.join(left_out)};" in said) == bool(left_out)
    if "urdf" in written:
        robot = found.files["model.urdf"].decode()
        assert robot.count("<inertial>") == robot.count("<link ") == len(made.object.links)
        assert "<collision " in robot
    if "mjcf" in written:
        assert ('<key name="open"' in found.files["model.xml"].decode()) == ("no keyframe `open`" not in said)
    assert ("<canvas" in page_of(found)) == ("no 3D view" not in said)
    assert page_of(found).endswith("</html>\n")
    if not written.issuperset(FORMATS):
        assert found.report.notes


def test_shapes_and_masses_are_simple_before_a_format_is_left_out(made: Functionalized) -> None:
    found = saved(made, Budget.lasting(20.0, clock=Clock(step=1.0)))
    assert any(words in " ".join(found.report.notes) for words in SIMPLER)
    assert "urdf" in found.files.formats


def test_what_tips_it_over_is_reported_whatever_the_results_are_called(plain: Saved, made: Functionalized) -> None:
    found = files_of(made, "another", ("urdf",), None, page=False)
    assert b'<robot name="another"' in found.files["model.urdf"]
    assert plain.report.base is not None
    assert found.report.base == plain.report.base
    assert plain.report.base.stability is not None
