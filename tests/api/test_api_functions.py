"""`grafu.load` and `grafu.functionalize`: what they take, what they refuse, and that they do what the command does."""

import json
import math
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

import grafu
from grafu.errors import AssetError, OptionError, WeightsError
from grafu.pipeline.motion_source import MotionSource

SAMPLE = Path(__file__).parent.parent.parent / "samples" / "chest.glb"


@pytest.fixture(scope="module")
def asset() -> grafu.Asset:
    return grafu.load(SAMPLE)


def test_importing_the_package_imports_nothing_else() -> None:
    code = "import sys, grafu; print(sorted({'numpy', 'trimesh', 'pydantic', 'grafu.api'} & set(sys.modules)))"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout.strip() == "[]"


def test_the_package_lists_what_it_offers() -> None:
    assert dir(grafu) == sorted(grafu.__all__)
    assert {"load", "functionalize", "Result", "Asset", "__version__"} <= set(dir(grafu))
    with pytest.raises(AttributeError, match="no attribute 'functionalise': it offers"):
        _ = grafu.functionalise  # type: ignore[attr-defined]


def test_the_module_is_the_command() -> None:
    done = subprocess.run([sys.executable, "-m", "grafu", "--version"], capture_output=True, text=True)
    assert done.stdout.strip() == f"grafu {grafu.__version__}"


def test_a_path_may_be_text(asset: grafu.Asset) -> None:
    assert grafu.load(str(SAMPLE)) == asset


def test_values_print_in_one_short_line(asset: grafu.Asset) -> None:
    assert repr(asset) == "<Asset chest: glb, 6 parts>"
    assert repr(asset.parts[0]).startswith(f"<Part {asset.parts[0].id}: ")
    shown = [repr(each) for each in (asset.parts[0].mesh, asset.parts[0].surfaces[0], asset.frame, asset.box)]
    assert max(map(len, shown)) < 1000
    assert "x3 float64>" in shown[0]


WRONG_TYPES = {
    "grafu.load(3)": "`path` must be a path, as str or Path: got int 3",
    "grafu.load(None)": "`path` must be a path, as str or Path: got NoneType None",
    "grafu.load(b'chest.glb')": "`path` must be a path, as str or Path: got bytes b'chest.glb'",
    "grafu.load(PATH, up=2)": "`up` must be an axis such as `+Z`: got int 2",
    "grafu.load(PATH, height='tall')": "`height` must be a number or None: got str 'tall'",
    "grafu.load(PATH, scale=True)": "`scale` must be a number or None: got bool True",
    "grafu.functionalize(5)": "`source` must be a path or the asset that `grafu.load` returned: got int 5",
    "grafu.functionalize(PATH, motion=1)": "`motion` must be a motion source such as `auto`: got int 1",
    "grafu.functionalize(PATH, top=1)": "`top` must be True, False or a shape: got int 1",
    "grafu.functionalize(PATH, drawer_boxes='yes')": "`drawer_boxes` must be True or False: got str 'yes'",
    "grafu.functionalize(PATH, interior=None)": "`interior` must be a word such as `auto`: got NoneType None",
    "grafu.functionalize(PATH, motions=[])": "`motions` must be a dict such as {'door_1': 'left'}: got list []",
    "grafu.functionalize(PATH, motions={'lid': 1})": "`how` must be a word such as `left`: got int 1",
    "grafu.functionalize(PATH, hieght=1.0)": "`grafu.functionalize` has no argument hieght",
    "RESULT.save(7)": "`folder` must be a path, as str or Path: got int 7",
    "RESULT.save('x', formats=3)": "`formats` must be a list of names: got int 3",
    "RESULT.save('x', page='no')": "`page` must be True or False: got str 'no'",
    "RESULT.joint(3)": "`name` must be the id of a joint or part, as str: got int 3",
    "RESULT.with_motion(3, 'left')": "`part` must be the id of a part, as str: got int 3",
    "RESULT.with_hinge(3, side='left')": "`part` must be the id of a part, as str: got int 3",
    "RESULT.with_hinge(3)": "`part` must be the id of a part, as str: got int 3",
    "RESULT.with_hinge('lid', side=3)": "`side` must be a word such as `left`, or None: got int 3",
    "RESULT.with_hinge('lid', template=3)": "`template` must be the id of a template, as str: got int 3",
    "RESULT.with_hinge('lid', mount=None)": "`mount` must be the id of a part, as str: got NoneType None",
    "RESULT.with_hinge('lid', count='two')": "`count` must be a whole number: got str 'two'",
    "RESULT.with_hinge('lid', scale='big')": "`scale` must be a number or None: got str 'big'",
    "RESULT.with_hinge('lid', mechanism=3)": "`mechanism` must be a class such as `contact`, or None: got int 3",
    "RESULT.with_rail(3)": "`part` must be the id of a part, as str: got int 3",
    "RESULT.with_handle(3, 'none')": "`name` must be the id of a joint or part, as str: got int 3",
    "RESULT.with_label(3, 'door')": "`part` must be the id of a part, as str: got int 3",
    "RESULT.with_label('lid', ['door'])": "`label` must be a category such as `door`: got list ['door']",
    "RESULT.without(7)": "`part` must be the id of a part, as str: got int 7",
    "RESULT.with_motion('lid', None)": "`how` must be a word such as `left`: got NoneType None",
}


def test_wrong_types_are_refused_where_they_are_given(tmp_path: Path) -> None:
    # in a process of its own: the shape checks of the tests would refuse them before, in other words
    code = f"""
import json, sys, grafu
PATH = {str(SAMPLE)!r}
RESULT = grafu.functionalize(PATH, motion="rule")
found = {{}}
for call in json.load(sys.stdin):
    try:
        eval(call)
    except TypeError as error:
        found[call] = str(error)
print(json.dumps(found))
"""
    command = [sys.executable, "-c", code]
    done = subprocess.run(command, input=json.dumps(list(WRONG_TYPES)), capture_output=True, text=True, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout) == WRONG_TYPES
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("arguments", "error", "message"),
    [
        ({"motion": "magic"}, OptionError, "must be one of auto, annotation, network"),
        ({"motion": "urdf"}, OptionError, "urdf:FILE"),
        ({"top": "round"}, OptionError, "rounded, chamfered, oval, capsule: got 'round'"),
        ({"handles": "no-such"}, OptionError, "`handle` must be one of"),
        ({"interior": "many"}, OptionError, "`interior` must be"),
        ({"motions": {"no_part": "left"}}, OptionError, "chest has no no_part"),
        ({"motions": {"door_1": "sideways"}}, OptionError, "how `door_1` moves must be one of left, right"),
        ({"weights": "nowhere.onnx"}, WeightsError, "no trained weights at `nowhere.onnx`"),
        ({"weights": "nowhere.onnx", "motion": "rule"}, OptionError, "weights are for the motion source network"),
        ({"height": 0.7}, OptionError, "give them to `grafu.load`"),
        ({"labels": "some"}, OptionError, "give them to `grafu.load`"),
    ],
)
def test_wrong_arguments_are_one_line(
    asset: grafu.Asset, arguments: dict[str, object], error: type[Exception], message: str
) -> None:
    with pytest.raises(error, match=message) as raised:
        grafu.functionalize(asset, **arguments)  # type: ignore[arg-type]
    assert "\n" not in str(raised.value)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"front": "Q"}, "`front=` must be one of +X"),
        ({"up": "Q"}, "`up=` must be one of +X"),
        ({"scale": math.nan}, "`scale=` must be a positive number: got nan"),
        ({"height": -1.0}, "`height=` must be a positive number: got -1.0"),
        ({"up": "+Z", "front": "-Z"}, "`up=` and `front=` must lie on different axes"),
        ({"piece": 2}, "`piece=` must be a number from 1, with `pieces='split'`"),
        ({"pieces": "split", "piece": 9}, "`piece=` must be at most 1"),
    ],
)
def test_an_error_of_the_reader_names_the_argument(arguments: dict[str, Any], message: str) -> None:
    for call in (grafu.load, grafu.functionalize):
        with pytest.raises(AssetError) as raised:
            call(SAMPLE, **arguments)
        assert message in str(raised.value)
        assert "--" not in str(raised.value)


def test_what_is_not_there_is_refused() -> None:
    with pytest.raises(AssetError, match="does not exist"):
        grafu.functionalize("nothing_there.glb")


def test_words_of_reading_are_checked() -> None:
    with pytest.raises(OptionError, match="`labels` must be input or none: got 'some'"):
        grafu.load(SAMPLE, labels="some")
    with pytest.raises(OptionError, match="`parts` must be auto, input or loose"):
        grafu.functionalize(SAMPLE, parts="shells")


def test_weights_of_a_file_are_used(asset: grafu.Asset) -> None:
    from grafu.completion.session import SHIPPED_WEIGHTS

    result = grafu.functionalize(asset, weights=SHIPPED_WEIGHTS)
    assert result.report.motion.source is MotionSource.NETWORK
    assert result.settings.to_json()["weights"] == str(SHIPPED_WEIGHTS)


def test_a_call_writes_what_the_command_writes(tmp_path: Path) -> None:
    from grafu.cli.main import main

    assert main(["functionalize", str(SAMPLE), "--out", str(tmp_path), "--no-page"]) == 0
    saved = grafu.functionalize(SAMPLE).save(tmp_path / "saved", page=False)
    for name in ("model.glb", "model.urdf", "graph.json", "settings.json"):
        assert (saved / name).read_bytes() == (tmp_path / "chest" / name).read_bytes(), name
    reports = [json.loads((folder / "report.json").read_text()) for folder in (saved, tmp_path / "chest")]
    assert {**reports[0], "timings": 0} == {**reports[1], "timings": 0}
