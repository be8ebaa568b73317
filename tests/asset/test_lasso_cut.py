"""What lies inside a lasso: faces cut along it, nothing lost, attributes kept; a welded door that is cut out turns."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from grafu import functionalize
from grafu.asset.lasso_cut import Lasso, inside_lasso
from grafu.asset.part import Asset, Part, PartSource
from grafu.asset.regrouping import Regroup, Regrouping, regrouped
from grafu.errors import OptionError
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.joints.motion_choice import choice_in_words
from grafu.pipeline.settings import Settings, settings_from_json
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.case.case import Case
from grafu.synth.fronts.layout import Door
from grafu.vocabulary import PartLabel

EYE = (0.2, -3.0, 0.6)


def around(box: Box, eye=EYE, margin: float = 0.0, through: bool = False) -> Lasso:
    """The lasso around the front of a box."""
    (x0, y, z0), (x1, _, z1) = box.low.tolist(), box.high.tolist()
    x0, x1, z0, z1 = x0 - margin, x1 + margin, z0 - margin, z1 + margin
    return Lasso(eye, ((x0, y, z0), (x1, y, z0), (x1, y, z1), (x0, y, z1)), through)


def area(surfaces) -> float:
    return sum(float(surface.mesh.area) for surface in surfaces)


def slab(width: float = 1.0, depth: float = 0.1) -> Surface:
    mesh = TriangleMesh.box_mesh(Box(vec3(-width / 2, 0.0, 0.0), vec3(width / 2, depth, 1.0)))
    uv = mesh.vertices[:, [0, 2]]
    return Surface(mesh, uv=uv, colors=np.tile(np.array([10, 20, 30, 255], np.uint8), (len(uv), 1)))


CORNERS = st.floats(-0.45, 0.45)


@settings(max_examples=40)
@given(st.lists(st.tuples(CORNERS, CORNERS), min_size=3, max_size=7), st.booleans())
def test_nothing_is_lost_and_what_is_inside_lies_within_the_loop(places, through) -> None:
    corners = tuple((x, -0.5, 0.5 + z) for x, z in places)
    try:
        lasso = Lasso((0.0, -3.0, 0.5), corners, through)
    except ValueError:
        return  # it crosses itself
    plate = slab()
    inside, left = inside_lasso((plate,), lasso, 1.0)
    assert area(inside) + area(left) == pytest.approx(area([plate]), rel=1e-9)
    for surface in inside:
        assert surface.uv is not None
        assert np.allclose(surface.uv, surface.mesh.vertices[:, [0, 2]], atol=1e-9)  # cut, too, where a face is cut
        low, high = np.min(places, axis=0), np.max(places, axis=0)
        spread = 3.1 / 2.5  # the back of the slab is farther off than the lasso
        assert (surface.mesh.vertices[:, [0, 2]] - [0.0, 0.5] >= spread * low.clip(max=0) - 1e-6).all()
        assert (surface.mesh.vertices[:, [0, 2]] - [0.0, 0.5] <= spread * high.clip(min=0) + 1e-6).all()


def test_what_lies_far_behind_stays_unless_it_is_wanted() -> None:
    front, back = slab(depth=0.02), slab(depth=0.02)
    far = replace(back, mesh=TriangleMesh(back.mesh.vertices + vec3(0.0, 0.5, 0.0), back.mesh.faces))
    lasso = Lasso((0.0, -5.0, 0.5), ((-0.2, 0.0, 0.3), (0.2, 0.0, 0.3), (0.2, 0.0, 0.7), (-0.2, 0.0, 0.7)))
    near = [s.mesh.box.high[1] for s in inside_lasso((front, far), lasso, 1.0)[0]]
    assert max(near) == pytest.approx(0.02)
    both = [s.mesh.box.high[1] for s in inside_lasso((front, far), replace(lasso, through=True), 1.0)[0]]
    assert max(both) == pytest.approx(0.52)


@pytest.mark.parametrize(
    ("eye", "corners", "said"),
    [
        (EYE, ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0)), "3 to 500 corners"),
        (EYE, ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (2.0, 0.0, 0.0)), "enclose something"),
        (EYE, ((0.0, 0.0, 0.0), (1.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)), "cross itself"),
        ((0.0, 0.0, 0.0), ((0.0, 1.0, 0.0), (1.0, 1.0, 0.0), (0.0, -2.0, 1.0)), "before the eye"),
        (EYE, ((float("nan"), 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)), "finite"),
    ],
)
def test_a_loop_that_encloses_nothing_is_refused(eye, corners, said) -> None:
    with pytest.raises(ValueError, match=said):
        Lasso(eye, corners)


def welded() -> tuple[Asset, Box]:
    """A cabinet whose door, case and handle are one object, beside a foot; and the box of its door."""
    plain = make_cabinet(Cabinet("welded", Case(width=0.5), Door("left"), gap=0.004))
    everything = tuple(surface for part in plain.parts for surface in part.surfaces)
    foot = TriangleMesh.box_mesh(Box(vec3(-0.02, 0.1, -0.05), vec3(0.02, 0.14, 0.0)))
    parts = (
        Part("body", PartLabel.UNKNOWN, everything, PartSource("body")),
        Part("foot", PartLabel.LEG, (Surface(foot),), PartSource("foot")),
    )
    return replace(plain, parts=parts, joints=(), small_joints=()), plain.part("door").box


def test_a_door_that_is_cut_out_of_a_welded_cabinet_turns() -> None:
    asset, door = welded()
    change = Regrouping(Regroup.CUT, ("body",), around(door, margin=0.001))
    made = regrouped(asset, [change])
    assert [part.id for part in made.parts] == ["body", "body_2", "foot"]
    assert made.notes[-1] == "body_2 cut out of body by hand"
    cut = made.part("body_2").box
    assert np.allclose(cut.size[[0, 2]], door.size[[0, 2]], atol=0.03)
    settings_ = replace(Settings(), regrouped=(change,)).with_motion("body_2", choice_in_words("left"))
    assert settings_from_json(settings_.to_json()) == settings_
    result = functionalize(made, motions={"body_2": "left"})
    (joint,) = (one for one in result.report.joints if one.part == "body_2")
    assert joint.type == "revolute"
    assert joint.upper > 1.0


def test_all_or_nothing_inside_is_refused_in_words() -> None:
    asset, _ = welded()
    everything = Box(vec3(-2.0, -1.0, -2.0), vec3(2.0, -0.9, 3.0))
    with pytest.raises(OptionError, match="all of it lies inside"):
        regrouped(asset, [Regrouping(Regroup.CUT, ("body",), around(everything, through=True))])
    beside = Box(vec3(1.5, -0.5, 0.0), vec3(1.6, -0.4, 0.1))
    with pytest.raises(OptionError, match="nothing of it lies inside"):
        regrouped(asset, [Regrouping(Regroup.CUT, ("body",), around(beside))])


def test_a_cut_has_one_part_and_a_loop_and_nothing_else_has_one() -> None:
    lasso = around(welded()[1])
    for do, parts, given_loop in (
        (Regroup.CUT, ("body", "foot"), lasso),
        (Regroup.CUT, ("body",), None),
        (Regroup.SPLIT, ("body",), lasso),
        (Regroup.JOIN, ("body", "foot"), lasso),
    ):
        with pytest.raises(ValueError, match=r"one part is cut at a time|cut by a lasso"):
            Regrouping(do, parts, given_loop)
