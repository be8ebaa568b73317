"""What one front is grasped by, with its own profile, depth and size: in settings, and as the command spells it."""

import argparse
import json
from pathlib import Path

import pytest

from grafu.additions.grip.carve import Carved
from grafu.additions.grip.config import GripKind, GripSizes
from grafu.additions.handle.config import HandleChoice
from grafu.cli.main import main
from grafu.cli.part_options import part_grasp
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.pipeline.addition_choice import front_choice
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.settings import Settings
from grafu.refusal import Asked, Reason
from grafu.templates.gallery import builtin_gallery
from small_scenes import BASE_CASE, box, hinged, scene

CHEST = Path(__file__).parents[2] / "samples" / "chest.glb"
AXIS = Axis(vec3(0.0, -0.025, 0.4), vec3(0.0, 0.0, -1.0))


def carved(choice: HandleChoice) -> Carved:
    """Returns the grip in a door of 0.6 x 0.82 m that is 24 mm thick."""
    door = box("door", (0.0, -0.025, 0.0), (0.6, -0.001, 0.82))
    asset = scene(*BASE_CASE, door, joints=(hinged(axis=AXIS),))
    config = PipelineConfig(Settings().with_front("door", choice))
    made = functionalize(asset, MotionSource.ANNOTATION, builtin_gallery(), config)
    (grip,) = made.fittings.changes.carved
    return grip


def test_a_groove_has_the_size_the_depth_and_the_profile_that_are_chosen() -> None:
    grip = carved(HandleChoice("groove", length=0.1, width=0.024, depth=0.008, profile="sharp"))
    assert (grip.kind, grip.profile) == (GripKind.GROOVE, "sharp")
    assert grip.size == pytest.approx([0.1, 0.024, 0.008], abs=1e-6)


def test_what_is_not_chosen_is_as_usual() -> None:
    usual = GripSizes().groove
    grip = carved(HandleChoice("groove", depth=0.006))
    assert grip.profile == "rounded"
    assert grip.size == pytest.approx([usual.length, usual.width, 0.006], abs=1e-6)
    assert carved(HandleChoice("groove")).size == pytest.approx([usual.length, usual.width, usual.depth], abs=1e-6)


def test_what_does_not_move_is_not_grasped_and_the_report_states_it() -> None:
    door = box("door", (0.0, -0.025, 0.0), (0.6, -0.001, 0.82))
    asset = scene(*BASE_CASE, door, joints=(hinged(axis=AXIS),))
    wall = next(part.id for part in asset.parts if part.id != "door")
    config = PipelineConfig(Settings().with_front(wall, HandleChoice("knob-round")))
    made = functionalize(asset, MotionSource.ANNOTATION, builtin_gallery(), config)
    (refusal,) = [r for r in made.fittings.refusals if r.part == wall]

    assert (refusal.reason, refusal.what) == (Reason.UNSUITABLE, Asked.GRASP)
    assert "it does not move" in refusal.why


def test_a_handle_is_as_long_as_chosen() -> None:
    door = box("door", (0.0, -0.025, 0.0), (0.6, -0.001, 0.82))
    asset = scene(*BASE_CASE, door, joints=(hinged(axis=AXIS),))
    choice = front_choice("bar-round,length=9cm", ["bar-round"])
    made = functionalize(
        asset, MotionSource.ANNOTATION, builtin_gallery(), PipelineConfig(Settings().with_front("door", choice))
    )
    (handle,) = [a for a in made.fittings.additions if a.style == "bar-round"]

    assert max(handle.part.box.size) == pytest.approx(0.09, abs=1e-3)


def test_a_hole_is_oval_where_two_lengths_are_given() -> None:
    assert carved(HandleChoice("hole", length=0.06, width=0.03)).size[:2] == pytest.approx([0.06, 0.03], abs=1e-6)


@pytest.mark.parametrize("fields", [{"depth": -0.1}, {"width": -0.1}, {"length": -1.0}, {"count": -1}])
def test_what_makes_no_sense_is_refused(fields: dict[str, object]) -> None:
    with pytest.raises(ValueError, match=f"HandleChoice.{next(iter(fields))}"):
        HandleChoice("groove", **fields)


def test_the_command_spells_it_and_its_settings_keep_it(tmp_path: Path) -> None:
    args = ["functionalize", str(CHEST), "--motion", "rule", "--no-page", "--formats", "urdf", "--out", str(tmp_path)]
    assert main(args) == 0
    report = json.loads((tmp_path / "chest" / "report.json").read_text())
    part = report["joints"][0]["part"]
    assert main([*args, "--overwrite", "--grasp", f"{part}=groove,depth=5mm,length=0.1,profile=sharp"]) == 0
    settings = json.loads((tmp_path / "chest" / "settings.json").read_text())
    front = settings["additions"]["fronts"][part]
    assert (front["style"], front["depth"], front["length"], front["profile"]) == ("groove", 0.005, 0.1, "sharp")


@pytest.mark.parametrize("text", ["groove", "door=", "=groove"])
def test_what_is_spelled_otherwise_is_refused(text: str) -> None:
    with pytest.raises(argparse.ArgumentTypeError):
        part_grasp(text)


@pytest.mark.parametrize(
    ("more", "states"),
    [
        (["--grasp", "door=groove,depth=-1"], "`depth` of `--grasp` must be a length of at least 0"),
        (["--grasp", "door=groove,deep=1cm"], "`--grasp` takes length=, width=, depth=, profile= after `groove`"),
        (["--grasp", "door=grove"], "`--grasp` must be one of "),
        (["--grasp", "door=grove"], "did you mean `groove`?"),
        (["--grasp", "door=knob-round,width=3cm"], "`--grasp` takes length= after `knob-round`"),
        (["--grasp", "door=none,length=3cm"], "`--grasp` takes no size after `none`"),
        (["--handle", "bar-round,depth=1cm"], "`--handle` takes length= after `bar-round`"),
        (["--grasp", "lidd=knob-round"], "what is grasped must be a part: chest has no lidd"),
        ([str(CHEST.with_name("kitchen_base.glb")), "--grasp", "door=groove"], "`--grasp` names parts of one model"),
    ],
)
def test_bad_choices_end_in_one_line(
    more: list[str], states: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["functionalize", str(CHEST), *more, "--out", str(tmp_path / "out")]) == 2
    said = capsys.readouterr().err
    assert states in said
    assert said.count("\n") == 1
