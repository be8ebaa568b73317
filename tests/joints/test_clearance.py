"""Clearance: as little as needed, within its limits, recorded; and none at all where it is turned off."""

from collections import Counter
from dataclasses import replace

import numpy as np
import pytest
import trimesh

from grafu.articulation.articulated_object import VisualRole
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.raycast import RayCaster
from grafu.geometry.solids import ConvexSolid
from grafu.joints import build
from grafu.joints.clearance import carve as carving
from grafu.joints.clearance import make
from grafu.joints.clearance.carve import Carving, Path, carve
from grafu.joints.clearance.trim import drawer_front
from grafu.joints.config import RealizationConfig
from grafu.joints.make_plan import plan_from_annotation
from grafu.joints.nesting import bodies_of
from grafu.refusal import Reason
from grafu.scene.scene import Scene
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.fronts.layout import Door
from grafu.synth.noise import edits
from grafu.vocabulary import PartLabel
from judging import installed, made_kind, realized, realized_kind, solid, swept_collisions
from small_scenes import DOOR, SIDE, box, drawer, hinged, scene, sliding

KINDS = ("doors into the case", "inset door into the side", "drawer into both walls")
NO_TRIM = RealizationConfig(trim=False)
UNCARVED = RealizationConfig(max_carve=1e-6, max_carve_last=1e-6, max_carve_hidden=1e-6)


def visuals(result) -> dict:
    return {v.name: v for link in result.object.links for v in link.visuals if v.role is not VisualRole.HARDWARE}


def volume(surfaces) -> float:
    return sum(solid(s.mesh).volume() for s in surfaces)


def clearances(result) -> list:
    return [c for outcome in result.report.installed for c in outcome.clearances]


@pytest.mark.parametrize("kind", KINDS)
def test_what_was_changed_is_recorded_and_nothing_else_changes(kind):
    asset, result = made_kind(kind), realized_kind(kind)
    after = visuals(result)
    changed = {p.id for p in asset.parts if after[p.id].surfaces != p.surfaces}
    assert changed == {c.part for c in clearances(result)}
    assert changed


@pytest.mark.parametrize("kind", KINDS)
def test_clearance_keeps_its_limits_and_says_why(kind):
    for c in clearances(realized_kind(kind)):
        assert c.kind in ("trimmed", "eased", "carved")
        assert 0 <= c.share <= (0.02 if c.kind == "trimmed" else 0.05)
        assert c.amount > 0
        assert c.why


@pytest.mark.parametrize("kind", KINDS)
def test_no_part_shrinks_by_more_than_a_fiftieth_of_its_side_or_its_volume_by_a_twentieth(kind):
    asset, result = made_kind(kind), realized_kind(kind)
    for c in clearances(result):
        before, after = asset.part(c.part), visuals(result)[c.part]
        assert volume(after.surfaces) >= 0.95 * volume(before.surfaces)
        assert np.all(before.box.size - after.mesh.box.size <= 0.02 * before.box.size.max() + 1e-9)


@pytest.mark.parametrize("kind", KINDS)
def test_parts_keep_their_materials_and_texture_coordinates(kind):
    asset, result = made_kind(kind), realized_kind(kind)
    for c in clearances(result):
        before, after = asset.part(c.part).surfaces, visuals(result)[c.part].surfaces
        assert [s.material for s in after] == [s.material for s in before]
        assert [s.uv is None for s in after] == [s.uv is None for s in before]
        assert all(s.mesh.is_watertight for s in after)


@pytest.mark.parametrize("kind", KINDS)
def test_without_trimming_parts_stay_and_the_trouble_is_told(kind):
    asset, result = made_kind(kind), realized(made_kind(kind), NO_TRIM)
    assert clearances(result) == []
    assert all(visuals(result)[p.id].surfaces == p.surfaces for p in asset.parts)
    (stuck,) = {o.moving for o in realized_kind(kind).report.installed if o.clearances}
    told = {s.part: s.reason for s in result.report.skipped}
    assert told.get(stuck) is Reason.BLOCKED or installed(result)[stuck].collision_share > 0


@pytest.mark.parametrize("sunk", [0.001, 0.004])
def test_an_inset_door_sunk_into_the_side_by_millimetres_works(sunk):
    asset = make_cabinet(Cabinet(layout=Door(), mount="inset"))
    result = realized(edits.with_swollen(asset, "door", np.array([0.003 + sunk, 0.0, 0.0])))
    assert not installed(result)["door"].restricted
    assert swept_collisions(result.object, result.object.joints[0], 25) == {}


@pytest.mark.parametrize("gap", [-0.003, 0.0, 0.001])
def test_a_drawer_without_play_between_its_walls_works(gap):
    result = realized(drawer(gap))
    outcome = installed(result)["drawer"]
    assert outcome.opening == pytest.approx(0.3, abs=0.02)
    assert outcome.collision_share == 0.0
    assert bool(outcome.clearances) is (gap <= 0)


def test_a_wall_that_is_cut_far_too_deep_is_not_trimmed_away():
    result = realized(drawer(gap=-0.06, wall=0.1))
    after = visuals(result)
    for part in drawer(gap=-0.06, wall=0.1).parts:
        assert volume(after[part.id].surfaces) >= 0.95 * volume(part.surfaces)
    assert "drawer" not in installed(result) or installed(result)["drawer"].collision_share > 0


def test_a_block_that_encloses_a_door_is_not_hollowed_out():
    block = box("block", (-0.02, -0.05, 0.0), (0.42, 0.05, 0.6))
    result = realized(scene(DOOR, block, joints=(hinged(),)))
    assert volume(visuals(result)["block"].surfaces) >= 0.95 * volume(block.surfaces)


def test_a_lip_before_the_door_is_carved_where_little_of_it_goes():
    """A static board behind the door, of which a nose stands in the door's way."""
    nose = box("nose", (0.395, -0.021, 0.29), (0.41, 0.3, 0.31))
    result = realized(scene(DOOR, SIDE, nose, joints=(hinged(),)))
    outcome = installed(result)["door"]
    assert not outcome.restricted
    assert outcome.collision_share == 0.0
    assert outcome.clearances


def test_what_lies_enclosed_in_a_drawer_moves_with_it():
    asset, t = drawer(), 0.012
    boards = [
        box("front", (-0.2, -0.2, 0.02), (0.2, -0.2 + t, 0.17)),
        box("rear", (-0.2, 0.2 - t, 0.02), (0.2, 0.2, 0.17)),
        box("left", (-0.2, -0.2 + t, 0.02), (t - 0.2, 0.2 - t, 0.17)),
        box("right", (0.2 - t, -0.2 + t, 0.02), (0.2, 0.2 - t, 0.17)),
        box("floor", (t - 0.2, -0.2 + t, 0.02), (0.2 - t, 0.2 - t, 0.03)),
    ]
    tray = replace(asset.part("drawer"), surfaces=tuple(b.surfaces[0] for b in boards))
    runner = box("runner", (-0.17, -0.195, 0.025), (-0.15, 0.1, 0.04))  # stuck in the floor and the front
    parts = tuple(tray if p.id == "drawer" else p for p in asset.parts)
    result = realized(replace(asset, parts=(*parts, runner)))
    assert [(c.part, c.kind) for c in installed(result)["drawer"].clearances] == [("runner", "joined")]
    assert "runner" in {v.name for v in result.object.link("drawer").visuals}


def labelled(part, label=PartLabel.MISC):
    return replace(part, label=label)


@pytest.mark.parametrize(
    ("change", "ride"),
    [
        (lambda part: part, True),
        (lambda part: replace(part, label=PartLabel.SHELF), False),
        (lambda part: replace(part, surfaces=box("", (0.001, -0.008, 0.08), (0.05, 0.05, 0.3)).surfaces), False),
        (lambda part: replace(part, surfaces=box("", (0.2, -0.008, 0.08), (0.249, 0.05, 0.13)).surfaces), False),
    ],
    ids=["a fitting", "a shelf", "a long strip", "far from the pin"],
)
def test_a_fitting_at_its_hinge_that_a_door_is_sunk_into_moves_with_it(change, ride):
    hinge = change(labelled(box("hinge", (0.001, -0.008, 0.08), (0.05, 0.05, 0.13))))
    result = realized(scene(DOOR, SIDE, hinge, joints=(hinged(),)))

    assert ("hinge" in {v.name for v in result.object.link("door").visuals}) is ride
    assert (("hinge", "joined") in {(c.part, c.kind) for c in installed(result)["door"].clearances}) is ride


@pytest.mark.parametrize(("sides_from", "is_trimmed"), [(-0.188, True), (-0.2, False)], ids=["hidden", "seen"])
def test_the_sides_of_a_drawer_are_lowered_where_its_front_hides_them(sides_from, is_trimmed):
    """A rail of the case stands 8 mm deep in the way of the sides; the drawer's front covers it."""
    asset, t = drawer(), 0.012
    sides = [box("side", (x, sides_from, 0.02), (x + t, 0.2, 0.17)) for x in (-0.2, 0.2 - t)]
    front = box("front", (-0.2, -0.2, 0.02), (0.2, -0.188, 0.17))
    floor = box("floor", (-0.188, -0.188, 0.02), (0.188, 0.2, 0.03))
    tray = replace(asset.part("drawer"), surfaces=tuple(b.surfaces[0] for b in (front, floor, *sides)))
    rail = box("rail", (-0.21, -0.186, 0.162), (0.21, -0.16, 0.2))
    parts = tuple(tray if p.id == "drawer" else p for p in asset.parts)
    result = realized(replace(asset, parts=(*parts, rail)), UNCARVED)

    done = installed(result)["drawer"].clearances if "drawer" in installed(result) else ()
    assert [c.part for c in done if c.kind == "trimmed"] == (["drawer"] if is_trimmed else [])
    if is_trimmed:
        assert installed(result)["drawer"].collision_share == 0.0
        before, after = tray.mesh.box, visuals(result)["drawer"].mesh.box
        np.testing.assert_allclose(after.size, before.size, atol=1e-9)


def test_the_body_of_a_drawer_is_lowered_behind_a_front_of_the_same_piece():
    """A bar of the case stands 5 mm deep in the way of the body; the front, which hides it, stays as it was."""
    front = trimesh.creation.box(bounds=[(-0.2, -0.2, 0.01), (0.2, -0.188, 0.18)])
    body = trimesh.creation.box(bounds=[(-0.195, -0.19, 0.02), (0.195, 0.2, 0.165)])
    label = trimesh.creation.box(
        bounds=[(-0.02, -0.201, 0.1), (0.02, -0.2, 0.12)]
    )  # a second piece of the same surface
    whole = trimesh.util.concatenate([trimesh.boolean.union([front, body]), label])
    asset = drawer()
    tray = replace(asset.part("drawer"), surfaces=(Surface(TriangleMesh.from_trimesh(whole)),))
    bar = box("bar", (-0.21, -0.186, 0.16), (0.21, -0.16, 0.2))
    parts = tuple(tray if p.id == "drawer" else p for p in asset.parts)
    result = realized(replace(asset, parts=(*parts, bar)), UNCARVED)

    outcome = installed(result)["drawer"]
    assert outcome.collision_share == 0.0
    assert [(c.part, c.kind) for c in outcome.clearances] == [("drawer", "trimmed")]
    after = visuals(result)["drawer"].mesh
    np.testing.assert_allclose(after.box.size, tray.mesh.box.size, atol=1e-9)
    hidden = after.vertices[after.vertices[:, 1] > -0.15]
    assert 0.148 < hidden[:, 2].max() < 0.16


@pytest.mark.parametrize(("length", "is_box"), [(0.0015, False), (0.3, True)])
def test_a_bevel_at_the_far_end_of_a_sliding_leaf_is_no_box_behind_a_front(length, is_box):
    """What lies behind a front is trimmed for itself; the lower edge of a leaf is trimmed as a whole."""
    behind = box("behind", (-length, -0.015, 0.05), (0.5, 0.0, 0.35)).box.corners()
    points = np.vstack([behind, box("leaf", (0.0, -0.02, 0.0), (0.5, 0.0, 0.4)).box.corners()])
    path = Path("leaf", Axis(vec3(0.0, 0.0, 0.0), vec3(1.0, 0.0, 0.0)).shift, 0.4, np.eye(3), False)
    found = drawer_front(points, path, RealizationConfig().thinnest_front)
    assert found is not None
    assert (found.back is not None) is is_box


def test_a_thin_bottom_of_a_drawer_is_raised_rather_than_pressed_flat():
    asset, t = drawer(), 0.012
    sides = [box("side", (x, -0.188, 0.03), (x + t, 0.2, 0.17)) for x in (-0.2, 0.2 - t)]
    front = box("front", (-0.2, -0.2, 0.02), (0.2, -0.188, 0.17))
    floor = box("floor", (-0.188, -0.188, 0.03), (0.188, 0.2, 0.036))
    tray = replace(asset.part("drawer"), surfaces=tuple(b.surfaces[0] for b in (front, floor, *sides)))
    shelf = box("shelf", (-0.21, -0.186, 0.0), (0.21, 0.2, 0.034))
    parts = tuple(tray if p.id == "drawer" else p for p in asset.parts)
    result = realized(replace(asset, parts=(*parts, shelf)), UNCARVED)

    assert installed(result)["drawer"].collision_share == 0.0
    raised = visuals(result)["drawer"].surfaces[1].mesh.box
    np.testing.assert_allclose(raised.size, floor.mesh.box.size, atol=1e-9)
    assert raised.low[2] > 0.034


def test_a_door_that_fills_a_frame_of_one_piece_gets_a_gap_around_it():
    """The frame's box is as large as the opening and more, so no single side of it states where the door touches."""
    outside = trimesh.creation.box(bounds=[(-0.05, -0.03, 0.0), (0.75, 0.03, 1.85)])
    inside = trimesh.creation.box(bounds=[(0.0, -1.0, -1.0), (0.7, 1.0, 1.8)])
    whole = Surface(TriangleMesh.from_trimesh(trimesh.boolean.difference([outside, inside])))
    frame = replace(box("frame", (0.0, 0.0, 0.0), (1.0, 1.0, 1.0)), surfaces=(whole,))
    leaf = box("door", (-0.002, -0.03, 0.0), (0.702, 0.01, 1.802))
    result = realized(scene(leaf, frame, joints=(hinged(axis=Axis(vec3(0.0, -0.03, 0.0), vec3(0.0, 0.0, -1.0))),)))

    outcome = installed(result)["door"]
    assert not outcome.restricted
    assert outcome.collision_share == 0.0
    assert {(c.part, c.kind) for c in outcome.clearances} == {("door", "trimmed")}
    lost = leaf.mesh.box.size - visuals(result)["door"].mesh.box.size
    assert 0.0 < lost.max() < 0.015
    assert lost[1] == pytest.approx(0.0, abs=1e-9)
    assert visuals(result)["frame"].surfaces == frame.surfaces


def test_the_back_of_a_door_that_is_sunk_into_its_frame_is_pressed_back():
    """The door lies on two stiles, 3 mm deep in them; its front stays where it was."""
    stiles = [box(f"stile_{x}", (x, -0.003, 0.0), (x + 0.05, 0.03, 0.6)) for x in (-0.02, 0.37)]
    result = realized(scene(DOOR, *stiles, joints=(hinged(),)))

    outcome = installed(result)["door"]
    assert outcome.collision_share == 0.0
    assert not outcome.restricted
    assert "carved" not in {c.kind for c in outcome.clearances}
    after = visuals(result)["door"].mesh.box
    np.testing.assert_allclose(after.low, DOOR.mesh.box.low, atol=1e-9)
    faces = [visual.mesh.box.low[1] for name, visual in visuals(result).items() if name.startswith("stile")]
    assert len(faces) == 2
    assert -0.008 < after.high[1] < min(faces) < -0.002


@pytest.mark.parametrize(("end", "last", "is_carved"), [(1.1, 0.1, True), (1.1, 1e-6, False), (0.8, 0.1, False)])
def test_more_is_carved_where_nothing_else_frees_a_path(end, last, is_carved):
    """A post before a door's upper edge loses 7 % to its path, or 16 %."""
    door = box("door", (0.0, -0.02, 0.0), (0.4, 0.0, 0.6))
    post = box("post", (0.1, -0.04, 0.57), (0.4, -0.021, end))
    result = realized(scene(door, SIDE, post, joints=(hinged(),)), RealizationConfig(max_carve_last=last))

    assert ("post" in {c.part for c in clearances(result) if c.kind == "carved"}) is is_carved
    if is_carved:
        assert installed(result)["door"].collision_share == 0.0


def test_a_part_of_very_many_faces_is_not_carved():
    door = box("door", (0.0, -0.02, 0.0), (0.4, 0.0, 0.6))
    lip = box("lip", (0.1, -0.04, 0.55), (0.5, -0.021, 0.6))
    asset = scene(door, SIDE, lip, joints=(hinged(),))
    few = RealizationConfig(carved_faces=len(lip.mesh.faces) - 1, max_carve=0.9)

    def carved(config):
        return [c.part for c in clearances(realized(asset, config)) if c.kind == "carved"]

    assert carved(replace(few, carved_faces=len(lip.mesh.faces))) == ["lip"]
    assert carved(few) == []


@pytest.mark.parametrize(
    ("name", "y", "is_carved"),
    [("bearing_0", -0.1, True), ("stud_0", -0.1, True), ("bearing_0", -0.25, True), ("stud_0", -0.25, False)],
    ids=["bearing", "hidden", "bearing in front", "seen"],
)
def test_what_is_not_seen_or_a_drawn_bearing_makes_way_where_other_parts_would_lose_too_much(name, y, is_carved):
    """A third of a stud that stands in a drawer's wall and in its way: beside the drawer, or before its front."""
    asset = drawer()
    stuck = box(name, (0.186, y, 0.09), (0.2265, y + 0.01, 0.1))
    result = realized(replace(asset, parts=(*asset.parts, stuck)))
    done = installed(result)["drawer"].clearances if "drawer" in installed(result) else ()
    assert ((name, "carved") in {(c.part, c.kind) for c in done}) is is_carved
    if is_carved:
        assert installed(result)["drawer"].collision_share == 0.0
        assert volume(visuals(result)[name].surfaces) >= 0.4 * volume(stuck.surfaces)


def trough_above(*others) -> tuple[Scene, Path]:
    """A trough of fine triangles that sinks by a tenth of a metre, and what stands in its way."""
    sides = [((-0.1, -0.1, 0.0), (0.1, 0.1, 0.01)), ((-0.1, -0.1, 0.0), (-0.09, 0.1, 0.2))]
    sides.append(((0.09, -0.1, 0.0), (0.1, 0.1, 0.2)))
    trough = trimesh.boolean.union([trimesh.creation.box(bounds=bounds) for bounds in sides], engine="manifold")
    fine = trough.subdivide_to_size(0.006)
    part = replace(
        box("trough", (0.0, 0.0, 0.0), (1.0, 1.0, 1.0)), surfaces=(Surface(TriangleMesh.from_trimesh(fine)),)
    )
    made = scene(part, *others, joints=(sliding("trough", (0.0, 0.0, -1.0), 0.1),))
    parts = {p.id: p for p in made.parts}
    axis = Axis(vec3(0.0, 0.0, 0.0), vec3(0.0, 0.0, -1.0))
    path = Path("trough", axis.shift, 0.1, np.eye(3), False)
    return Scene(parts, bodies_of(plan_from_annotation(made).joints), made.extent), path


BLOCK = box("block", (-0.05, -0.05, 0.009), (0.05, 0.05, 0.109))


def test_triangles_cut_less_than_the_hull_of_what_is_hollow():
    built, path = trough_above(BLOCK)
    assert carve(built, path, ["block"], RealizationConfig(), 10)[1] == []
    (carving,) = carve(built, path, ["block"], RealizationConfig(), 10_000)[1]
    assert isinstance(carving, Carving)
    done = carving.recorded()
    assert (done.part, done.kind) == ("block", "carved")
    assert done.volume_share < 0.05


def test_what_loses_too_much_to_a_few_solids_is_left_out_before_all_are_made(monkeypatch):
    """A plate below a side of the trough, of which half would go. The block is cut as if it stood alone."""
    plate = box("plate", (0.086, -0.08, -0.06), (0.104, 0.08, -0.01))
    built, path = trough_above(BLOCK, plate)
    made: list[ConvexSolid] = []
    solids = carving._Swept.solids

    def noted(swept, *each):
        made.extend(found := solids(swept, *each))
        return found

    monkeypatch.setattr(carving._Swept, "solids", noted)

    def carved(*names):
        made.clear()
        scene, done = carve(built, path, names, RealizationConfig(), 10_000)
        return [one.part.id for one in done], {name: scene.parts[name] for name in ("block", "plate")}, len(made)

    first = carved("block", "plate"), carved("plate")
    monkeypatch.setattr(carving, "_FEW_SOLIDS", ())
    second = carved("block", "plate"), carved("plate")
    assert [one[0] for one in first] == [one[0] for one in second] == [["block"], []]
    assert [one[1] for one in first] == [one[1] for one in second]
    assert first[1][2] < second[1][2]


def test_what_is_seen_of_a_scene_is_prepared_once(monkeypatch):
    """To prepare all faces of a large piece for rays takes longer than all else that is asked of a cut."""
    made = []
    monkeypatch.setattr(carving, "RayCaster", lambda mesh: made.append(mesh) or RayCaster(mesh))
    plates = [box(f"plate_{k}", (0.096, y, -0.06), (0.104, y + 0.05, -0.01)) for k, y in enumerate((-0.08, 0.02))]
    built, path = trough_above(*plates)
    for _ in range(2):
        carve(built, path, ["plate_0", "plate_1"], RealizationConfig(max_carve=1e-6), 10_000)
    assert len(made) == 1


def test_a_door_that_stays_blocked_is_cleared_once(monkeypatch):
    paths: list[Path] = []
    monkeypatch.setattr(build, "make_clearance", lambda *given: paths.append(given[1]) or make.make_clearance(*given))
    block = box("block", (-0.02, -0.05, 0.0), (0.42, 0.05, 0.6))
    realized(scene(DOOR, block, joints=(hinged(),)))
    assert len(paths) == 1


def test_what_was_in_vain_is_not_tried_again_until_something_changed(monkeypatch):
    """A block that encloses a door: nothing helps, and each of the ways to make room is tried once."""
    tried = Counter[object]()

    def counted(step):
        def run(scene, path, ids, config):
            tried[step, scene, path] += 1
            return step(scene, path, ids, config)

        return run

    steps = {step: counted(step) for step in make._STEPS}
    monkeypatch.setattr(make, "_STEPS", tuple(steps[step] for step in make._STEPS))
    block = box("block", (-0.02, -0.05, 0.0), (0.42, 0.05, 0.6))
    realized(scene(DOOR, block, joints=(hinged(),)))
    assert tried
    assert max(tried.values()) == 1
