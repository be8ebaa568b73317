"""Compartments are found where furniture has room, and panels in them neither float, pierce nor block."""

from math import radians

import numpy as np
import pytest
from interior_judge import faults_of_panels

from grafu.additions.interior.compartments import Compartment, find_compartments
from grafu.additions.interior.config import InteriorConfig
from grafu.additions.interior.furnish import Furnished, furnish
from grafu.additions.interior.request import AUTO, NOTHING, PREDICTED, parse_interior
from grafu.additions.step import PanelHint
from grafu.asset.part import Part
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.scene.scene import JointMotion, MovingBody, Scene
from grafu.vocabulary import JointType, PartLabel
from small_scenes import Point, box

LEFT, RIGHT = box("left", (-0.4, -0.2, 0.0), (-0.38, 0.2, 1.0)), box("right", (0.38, -0.2, 0.0), (0.4, 0.2, 1.0))
FLOOR, CEILING = box("floor", (-0.38, -0.2, 0.0), (0.38, 0.2, 0.02)), box("top", (-0.38, -0.2, 0.98), (0.38, 0.2, 1.0))
BACK = box("back", (-0.38, 0.19, 0.02), (0.38, 0.2, 0.98))
CASE = (LEFT, RIGHT, FLOOR, CEILING, BACK)
INSIDE = Box(vec3(-0.38, -0.2, 0.02), vec3(0.38, 0.19, 0.98))
OVERLAY = box("door", (-0.4, -0.22, 0.0), (0.4, -0.201, 1.0))
INSET_DOOR = box("door", (-0.378, -0.2, 0.022), (0.378, -0.18, 0.978))
TWO_SHELVES = parse_interior("shelves=2")


def scene_of(*parts: Part, joint_motions: dict[str, JointMotion] | None = None) -> Scene:
    boxes = [part.box for part in parts]
    size = np.max([b.high for b in boxes], axis=0) - np.min([b.low for b in boxes], axis=0)
    joint_motions = joint_motions or {}
    return Scene(
        {p.id: p for p in parts},
        {m: MovingBody(m, (m,)) for m in joint_motions},
        float(size.max()),
        joint_motions=joint_motions,
    )


def swinging(x: float, y: float, upper: float = radians(110), direction: float = -1.0) -> JointMotion:
    return JointMotion(Axis(vec3(x, y, 0.0), vec3(0.0, 0.0, direction)), JointType.REVOLUTE, upper)


def pulled(upper: float = 0.3) -> JointMotion:
    return JointMotion(Axis(vec3(0.0, 0.0, 0.0), vec3(0.0, -1.0, 0.0)), JointType.PRISMATIC, upper)


def merged(*parts: Part) -> Part:
    mesh = merge_meshes([part.mesh for part in parts])
    whole = box("body", (0.0, 0.0, 0.0), (1.0, 1.0, 1.0))
    return Part("body", whole.label, (type(whole.surfaces[0])(mesh),), whole.source)


def furnished(scene: Scene, request=TWO_SHELVES, hints=()) -> Furnished:
    result = furnish(find_compartments(scene), request, scene, hints=hints)
    assert faults_of_panels(result.additions, scene) == []
    return result


def heights(result: Furnished) -> list[float]:
    return sorted(round(float(a.part.box.center[2]), 3) for a in result.additions)


def only(compartments: tuple[Compartment, ...]) -> Compartment:
    assert len(compartments) == 1
    return compartments[0]


@pytest.mark.parametrize("parts", [CASE, (merged(*CASE),)], ids=["boards", "one merged body"])
def test_an_open_case_is_one_compartment_to_the_millimetre(parts) -> None:
    found = only(find_compartments(scene_of(*parts)))

    assert np.allclose(found.box.low, INSIDE.low, atol=0.001)
    assert np.allclose(found.box.high, INSIDE.high, atol=0.001)
    assert (found.opening, found.behind) == (2, ())


def test_walls_are_named_by_face() -> None:
    walls = only(find_compartments(scene_of(*CASE))).walls

    assert [w[0] if w else "" for w in walls] == ["left", "right", "", "back", "floor", "top"]


@pytest.mark.parametrize("scale", [0.1, 1.0, 10.0])
def test_shelves_are_equally_spaced_and_touch_both_walls_at_any_scale(scale: float) -> None:
    parts = [
        Part(p.id, p.label, tuple(s.transformed(np.diag([scale, scale, scale, 1.0])) for s in p.surfaces), p.source)
        for p in CASE
    ]
    result = furnished(scene_of(*parts))

    assert [a.part.label for a in result.additions] == [PartLabel.SHELF] * 2
    low, high = sorted((a.part.box for a in result.additions), key=lambda b: b.low[2])
    spaces = [low.low[2] - 0.02 * scale, high.low[2] - low.high[2], 0.98 * scale - high.high[2]]
    assert np.ptp(spaces) < 1e-3 * scale
    assert np.allclose([low.low[0], low.high[0], low.high[1]], np.array([-0.38, 0.38, 0.19]) * scale, atol=1e-5 * scale)
    assert low.low[1] >= (-0.2 + 0.005) * scale


def test_dividers_stand_between_floor_and_ceiling_and_carry_the_shelves() -> None:
    result = furnished(scene_of(*CASE), parse_interior("shelves=1,dividers=1"))

    assert sorted(a.part.id for a in result.additions) == ["divider", "shelf_1", "shelf_2"]
    divider = next(a.part.box for a in result.additions if a.part.label is PartLabel.DIVIDER)
    assert np.allclose([divider.low[2], divider.high[2]], [0.02, 0.98], atol=1e-5)
    assert abs(float(divider.center[0])) < 0.002


def test_nothing_is_added_when_nothing_is_asked_for() -> None:
    assert furnish(find_compartments(scene_of(*CASE)), NOTHING, scene_of(*CASE)) == Furnished()


@pytest.mark.parametrize(("there", "more"), [(0, 2), (1, 1), (2, 0)])
def test_shelves_that_are_there_count(there: int, more: int) -> None:
    at = [0.34, 0.66][:there]
    own = [box(f"board{k}", (-0.38, -0.19, z - 0.01), (0.38, 0.19, z + 0.01)) for k, z in enumerate(at)]

    assert len(furnished(scene_of(*CASE, *own)).additions) == more


def test_the_larger_space_gets_the_missing_shelf() -> None:
    low_shelf = box("board", (-0.38, -0.19, 0.3), (0.38, 0.19, 0.32))

    assert heights(furnished(scene_of(*CASE, low_shelf))) == [pytest.approx(0.65, abs=0.01)]


def test_a_door_of_an_overlay_cabinet_lies_before_its_compartment() -> None:
    found = only(find_compartments(scene_of(*CASE, OVERLAY, joint_motions={"door": swinging(-0.4, -0.22)})))

    assert found.behind == ("door",)
    assert found.box.low[1] <= -0.19


def test_shelves_stand_back_from_what_a_door_swings_inwards() -> None:
    # pinned 8 cm behind its face at the left: its inner edge sweeps back into the cabinet before it comes out
    scene = scene_of(*CASE, INSET_DOOR, joint_motions={"door": swinging(-0.3, -0.12)})

    result = furnish(find_compartments(scene), TWO_SHELVES, scene)

    assert faults_of_panels(result.additions, scene) == []
    for addition in result.additions:
        assert addition.part.box.low[1] > -0.15


def test_what_a_door_carries_inside_is_kept_clear() -> None:
    rack = box("rack", (-0.3, -0.18, 0.3), (0.3, -0.08, 0.8), carried_by="door")
    joint_motions = {"door": swinging(-0.378, -0.2)}
    scene = scene_of(*CASE, INSET_DOOR, rack)
    scene = Scene(
        scene.parts, {"door": MovingBody("door", ("door", "rack"))}, scene.extent, joint_motions=joint_motions
    )

    result = furnish(find_compartments(scene), TWO_SHELVES, scene)

    assert faults_of_panels(result.additions, scene) == []
    assert all(a.part.box.low[1] > -0.08 for a in result.additions if 0.3 < a.part.box.center[2] < 0.8)


def drawer(low: float, high: float, name: str = "drawer") -> Part:
    return box(name, (-0.36, -0.22, low), (0.36, 0.1, high))


def test_a_drawer_takes_all_the_room_behind_it() -> None:
    scene = scene_of(*CASE, drawer(0.03, 0.97), joint_motions={"drawer": pulled()})

    assert find_compartments(scene) == ()
    assert "drawers" in furnish((), TWO_SHELVES, scene).refused[0].why


def test_the_room_below_a_drawer_is_furnished() -> None:
    scene = scene_of(
        *CASE, drawer(0.7, 0.96), OVERLAY_LOW, joint_motions={"drawer": pulled(), "door": swinging(-0.4, -0.22)}
    )

    found = only(find_compartments(scene))

    assert found.behind == ("door",)
    assert 0.68 <= found.box.high[2] <= 0.7001
    assert len(furnished(scene).additions) == 2
    refused = furnish((found,), parse_interior("dividers=1"), scene).refused
    assert [r.part for r in refused] == ["divider of compartment 1"]


OVERLAY_LOW = box("door", (-0.4, -0.22, 0.0), (0.4, -0.201, 0.68))

LEGS = [
    box(f"leg{k}", (x, y, 0.0), (x + 0.06, y + 0.06, 0.98))
    for k, (x, y) in enumerate([(-0.4, -0.2), (0.34, -0.2), (-0.4, 0.14), (0.34, 0.14)])
]
TABLE_TOP = box("top", (-0.4, -0.2, 0.98), (0.4, 0.2, 1.0))


@pytest.mark.parametrize(
    "parts",
    [
        (TABLE_TOP, *LEGS),
        (TABLE_TOP, *LEGS, box("low", (-0.38, -0.18, 0.2), (0.38, 0.18, 0.22))),
        (LEFT, RIGHT, CEILING, BACK),
        (LEFT, RIGHT, FLOOR, BACK),
        (box("block", (-0.4, -0.2, 0.0), (0.4, 0.2, 1.0)),),
        (*CASE, box("front", (-0.4, -0.22, 0.0), (0.4, -0.2, 1.0))),
    ],
    ids=["table", "table with a low shelf", "knee space", "no top and no door", "solid block", "no way in"],
)
def test_what_is_no_compartment_is_none_and_says_so(parts) -> None:
    scene = scene_of(*parts)

    assert find_compartments(scene) == ()
    assert [r.why[:14] for r in furnish((), AUTO, scene).refused] == ["no compartment"]
    hint = PanelHint("shelf", PartLabel.SHELF, Box(vec3(-0.3, -0.1, 0.4), vec3(0.3, 0.1, 0.42)))
    assert furnish((), PREDICTED, scene, hints=(hint,)).refused == ()  # nothing is missing where it has no room


def test_a_cabinet_without_a_top_has_room_behind_its_door() -> None:
    scene = scene_of(LEFT, RIGHT, FLOOR, BACK, OVERLAY, joint_motions={"door": swinging(-0.4, -0.22)})

    assert only(find_compartments(scene)).behind == ("door",)
    assert len(furnished(scene).additions) == 2


def frame(name: str, x: float) -> Part:
    """A side of posts and rails around an opening of a third of its area."""
    bars: list[tuple[Point, Point]] = [
        ((x, -0.2, 0.0), (x + 0.02, -0.08, 1.0)),
        ((x, 0.08, 0.0), (x + 0.02, 0.2, 1.0)),
        ((x, -0.08, 0.0), (x + 0.02, 0.08, 0.12)),
        ((x, -0.08, 0.88), (x + 0.02, 0.08, 1.0)),
    ]
    whole = merged(*(box("bar", low, high) for low, high in bars))
    return Part(name, PartLabel.UNKNOWN, whole.surfaces, whole.source)


def test_a_side_may_be_a_frame() -> None:
    scene = scene_of(frame("left", -0.4), frame("right", 0.38), FLOOR, CEILING, BACK)

    assert len(furnished(scene).additions) == 2


def test_walls_that_run_askew_get_panels_that_follow_them() -> None:
    mesh = LEFT.mesh
    vertices = mesh.vertices.copy()
    vertices[:, 0] += 0.25 * (vertices[:, 1] + 0.2)  # the back end stands 10 cm farther in
    askew = Part("left", LEFT.label, (type(LEFT.surfaces[0])(TriangleMesh(vertices, mesh.faces)),), LEFT.source)

    result = furnished(scene_of(askew, RIGHT, FLOOR, CEILING, BACK))

    assert len(result.additions) == 2
    panel = result.additions[0].part.mesh
    ends = panel.vertices[panel.vertices[:, 0] < 0]
    assert np.ptp(ends[:, 0]) > 0.05


def test_a_chest_gets_dividers_under_its_lid_and_no_shelves() -> None:
    front = box("front", (-0.38, -0.2, 0.02), (0.38, -0.19, 0.5))
    sides = [box(n, (x, -0.2, 0.0), (x + 0.02, 0.2, 0.5)) for n, x in (("left", -0.4), ("right", 0.38))]
    back = box("back", (-0.38, 0.19, 0.02), (0.38, 0.2, 0.5))
    lid = box("door", (-0.4, -0.2, 0.501), (0.4, 0.2, 0.52))
    joint_motion = JointMotion(Axis(vec3(0.0, 0.2, 0.52), vec3(-1.0, 0.0, 0.0)), JointType.REVOLUTE, radians(80))
    scene = scene_of(*sides, FLOOR, front, back, lid, joint_motions={"door": joint_motion})

    found = only(find_compartments(scene))

    assert (found.is_chest, found.behind) == (True, ("door",))
    assert len(furnished(scene, parse_interior("dividers=2")).additions) == 2
    refused = furnished(scene, TWO_SHELVES)
    assert (refused.additions, refused.refused[0].part) == ((), "shelf of compartment 1")


def test_auto_shelves_stand_a_hand_apart_and_leave_small_rooms_alone() -> None:
    assert len(furnished(scene_of(*CASE), AUTO).additions) == 2  # 0.96 m: 0.31 each
    low = [box("board", (-0.38, -0.19, z), (0.38, 0.19, z + 0.02)) for z in (0.33,)]
    assert heights(furnished(scene_of(*CASE, *low), AUTO)) == [pytest.approx(0.665, abs=0.01)]


def test_a_wardrobe_keeps_room_for_hanging() -> None:
    parts = [
        Part(p.id, p.label, tuple(s.transformed(np.diag([1.2, 1.5, 2.0, 1.0])) for s in p.surfaces), p.source)
        for p in (*CASE, OVERLAY)
    ]
    scene = scene_of(*parts, joint_motions={"door": swinging(-0.48, -0.33)})

    shelf = furnished(scene, AUTO).additions

    assert len(shelf) == 1
    assert shelf[0].part.box.low[2] - 0.04 >= InteriorConfig().hanging_height


def test_a_predicted_shelf_goes_to_the_nearest_sensible_place() -> None:
    def hint(z: float, name: str = "h") -> PanelHint:
        return PanelHint(name, PartLabel.SHELF, Box(vec3(-0.3, -0.1, z), vec3(0.3, 0.1, z + 0.02)))

    assert heights(furnished(scene_of(*CASE), PREDICTED, [hint(0.4)])) == [pytest.approx(0.41, abs=0.01)]
    assert heights(furnished(scene_of(*CASE), PREDICTED, [hint(0.03)])) == [pytest.approx(0.119, abs=0.01)]
    doubled = furnished(scene_of(*CASE), PREDICTED, [hint(0.4), hint(0.41, "again")])
    assert np.diff(heights(doubled))[0] >= InteriorConfig().least_pitch
    outside = furnished(scene_of(*CASE), PREDICTED, [hint(3.0)])
    assert (outside.additions, "lies in no compartment" in outside.refused[0].why) == ((), True)


def test_more_than_fits_is_refused_with_what_fits() -> None:
    result = furnished(scene_of(*CASE), parse_interior("shelves=20"))

    assert 5 <= len(result.additions) < 20
    assert "room for" in result.refused[0].why


def test_new_parts_have_ids_of_their_own_and_say_why() -> None:
    own = box("shelf", (-0.38, -0.19, 0.3), (0.38, 0.19, 0.32))
    added = furnished(scene_of(*CASE, own)).additions[0]

    assert added.part.id == "shelf_1"
    assert "shelves=2" in added.why
    assert added.part.labelled_by == "added"


def test_an_empty_scene_has_no_compartments() -> None:
    assert find_compartments(Scene({}, {}, 0.0)) == ()


def test_two_panels_never_stand_in_one_place() -> None:
    scene = scene_of(*CASE)
    found = find_compartments(scene)

    result = furnish([*found, *found], parse_interior("dividers=1"), scene)

    first, second = (addition.part.box for addition in result.additions)
    assert first.axis_gaps(second).max() > 0
    assert faults_of_panels(result.additions, scene) == []


@pytest.mark.parametrize("above", [True, False])
def test_a_drawer_closes_the_open_room_beside_it_where_no_board_parts_them(above):
    low, high = (0.7, 0.97) if above else (0.03, 0.3)
    drawer = box("drawer", (-0.37, -0.19, low), (0.37, 0.15, high))
    furniture = scene_of(*CASE, drawer, joint_motions={"drawer": pulled()})
    (room,) = find_compartments(furniture)
    assert room.box.size[2] == pytest.approx(0.68, abs=0.03)
    panels = furnished(furniture).additions
    assert len(panels) == 2
    assert all(p.part.box.gap(drawer.box) > 0.05 for p in panels)
