"""Hinges that the model has tell which border a door turns about, whatever a source of motions takes it for."""

from dataclasses import replace

import manifold3d
import numpy as np
import pytest
import trimesh

from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.mesh import TriangleMesh
from grafu.joints import barrels
from grafu.joints.drawn_hinges import with_drawn_hinges
from grafu.joints.make_plan import plan_from_annotation
from grafu.joints.plan import AUTOMATIC, JointChoice
from grafu.joints.realize import realize
from grafu.vocabulary import JointType
from judging import GALLERY, installed
from small_scenes import box, cylinder, hinged, scene, sliding

# A door of 0.4 x 0.6 m before a case, y = -0.02 to 0, and the line along its left border that a source may state.
CASE = (
    box("side_left", (-0.02, 0.0, -0.02), (0.0, 0.4, 0.62)),
    box("side_right", (0.4, 0.0, -0.02), (0.42, 0.4, 0.62)),
    box("bottom", (0.0, 0.0, -0.02), (0.4, 0.4, 0.0)),
    box("top", (0.0, 0.0, 0.6), (0.4, 0.4, 0.62)),
)
LEAF = box("door", (0.0, -0.02, 0.0), (0.4, 0.0, 0.6))
LEFT = hinged(axis=Axis(vec3(0.0, 0.0, 0.0), vec3(0.0, 0.0, -1.0)))


def knuckles(x, y=-0.008):
    """Two barrels on one upright line at (x, y)."""
    heights = ((0.08, 0.14), (0.46, 0.52))
    return [cylinder(f"knuckle_{x}_{low}", ((x, y, low), (x, y, high))) for low, high in heights]


def leaved(x, y, low, bore):
    """A barrel of 6 mm with a leaf of 15 mm behind it, and a pin hole if it has a bore: one shell."""
    barrel = manifold3d.Manifold.cylinder(0.06, 0.006, circular_segments=32)
    leaf = manifold3d.Manifold.cube((0.004, 0.015, 0.06)).translate((-0.002, 0.0, 0.0))
    whole = (barrel + leaf) - manifold3d.Manifold.cylinder(0.06, 0.003, circular_segments=32) if bore else barrel + leaf
    made = whole.translate((x, y, low)).to_mesh()
    mesh = TriangleMesh(np.asarray(made.vert_properties[:, :3], float), np.asarray(made.tri_verts, int))
    return replace(box(f"leaved_{low}", (0.0, 0.0, 0.0), (1.0, 1.0, 1.0)), surfaces=(Surface(mesh),))


def rod(name="rod", y=-0.01, ends=(0.0, 0.4), carried_by="door"):
    return cylinder(name, ((ends[0], y, 0.006), (ends[1], y, 0.006)), carried_by=carried_by)


def told(*parts, joint=LEFT, choice=AUTOMATIC):
    """The request of the door before and after the drawn hinges are looked for."""
    asset = scene(*parts, joints=(joint,))
    plan = plan_from_annotation(asset)
    plan = replace(plan, joints=tuple(replace(r, choice=choice, mounts=("side_left",)) for r in plan.joints))
    return plan.joints[0], with_drawn_hinges(plan, asset).joints[0]


def opens_towards(request, point=(0.2, -0.01, 0.3)):
    return request.kind.sets_off(request.axis, np.array(point))


def test_a_door_turns_about_the_border_that_has_its_hinges():
    before, after = told(LEAF, *CASE, *knuckles(0.404))

    assert np.allclose(after.axis.point[:2], (0.404, -0.008))
    assert opens_towards(before)[1] < 0
    assert opens_towards(after)[1] < 0
    assert after.mounts == ()


def row(*hung, planned="left"):
    """The pins of three doors side by side, all planned to hang on one side, whose barrels stand at `hung`."""
    leaves = [box(f"door_{k}", (0.41 * k, -0.02, 0.0), (0.41 * k + 0.4, 0.0, 0.6)) for k in range(3)]
    off, up = (0.0, -1.0) if planned == "left" else (0.4, 1.0)
    lines = [Axis(vec3(0.41 * k + off, 0.0, 0.0), vec3(0.0, 0.0, up)) for k in range(3)]
    joints = tuple(hinged(leaf.id, axis=line) for leaf, line in zip(leaves, lines, strict=True))
    barrels = [knuckle for x in hung for knuckle in knuckles(x)]
    case = (box("side", (-0.02, 0.0, -0.02), (0.0, 0.4, 0.62)), box("end", (1.22, 0.0, -0.02), (1.24, 0.4, 0.62)))
    asset = scene(*leaves, *case, *barrels, joints=joints)
    return [request.axis.point[0] for request in with_drawn_hinges(plan_from_annotation(asset), asset).joints]


@pytest.mark.parametrize(("hung", "planned"), [((-0.004, 0.405, 0.815), "right"), ((0.405, 0.815, 1.224), "left")])
def test_doors_in_a_row_that_hang_on_one_side_have_each_their_own_barrels(hung, planned):
    assert np.allclose(row(*hung, planned=planned), hung)


def test_barrels_between_two_doors_of_which_none_has_others_are_of_both():
    assert np.allclose(row(0.405)[:2], (0.405, 0.41))  # the right one is planned there


def test_doors_stay_as_planned_where_all_have_barrels_along_two_borders():
    assert np.allclose(row(-0.004, 0.405, 0.815, 1.224), (0.0, 0.41, 0.82))


def dowels(z):
    """What joins the bottom to both sides, on one level line behind the door's lower border."""
    return [cylinder(f"dowel_{x}", ((x - 0.015, 0.03, z), (x + 0.015, 0.03, z)), radius=0.004) for x in (0.0, 0.4)]


def test_dowels_that_join_boards_are_no_hinges():
    before, after = told(LEAF, *CASE, *dowels(-0.01))

    assert after is before


def test_barrels_on_the_same_line_outside_the_boards_are():
    _, after = told(LEAF, *CASE, *dowels(-0.024))

    assert np.allclose(np.abs(after.axis.direction), (1, 0, 0))


@pytest.mark.parametrize("bore", [True, False])
def test_the_barrel_of_a_hinge_may_be_one_shell_with_its_leaf(bore):
    _, after = told(LEAF, *CASE, leaved(0.404, -0.022, 0.08, bore), leaved(0.404, -0.022, 0.46, bore))

    assert np.allclose(after.axis.point[:2], (0.404, -0.022), atol=1e-5)


def test_it_is_built_there_on_the_hinges_that_are_drawn():
    asset = scene(LEAF, *CASE, *knuckles(0.404, -0.022), joints=(LEFT,))
    made = installed(realize(with_drawn_hinges(plan_from_annotation(asset), asset), asset, GALLERY))["door"]
    assert np.allclose(made.axis.point[:2], (0.404, -0.022))
    assert (made.template, made.count) == ("drawn", 0)


def test_nothing_is_cut_for_drawn_hinges_about_which_a_door_is_blocked_most_of_the_way():
    """A post beside the door stands out before it: about knuckles within its thickness the door would run into it."""
    post = box("post", (0.4005, -0.03, -0.02), (0.62, 0.4, 0.62))
    parts = [LEAF, *(part for part in CASE if part.id != "side_right"), post, *knuckles(0.409)]
    asset = scene(*parts, joints=(LEFT,))
    made = installed(realize(with_drawn_hinges(plan_from_annotation(asset), asset), asset, GALLERY))["door"]

    assert made.template != "drawn"
    assert made.clearances == ()
    assert made.opening >= np.radians(90)


@pytest.mark.parametrize(
    "parts",
    [(), knuckles(-0.004), [*knuckles(-0.004), *knuckles(0.404)], knuckles(0.404)[:1], knuckles(0.6), [rod(y=-0.06)]],
    ids=["none", "where it turns", "on both sides", "a single one", "a neighbour's", "a bar to pull it by"],
)
def test_a_motion_stays_where_nothing_tells_of_another(parts):
    before, after = told(LEAF, *CASE, *parts)
    assert after is before or after == before


def posts(x):
    """Two square posts of a bar handle before the door, one upright line: seen along it, all corners and middles."""
    made = []
    for low in (0.1, 0.5):
        post = box(f"post_{low}", (x - 0.006, -0.032, low), (x + 0.006, -0.02, low + 0.012), carried_by="door")
        quads = trimesh.Trimesh(post.mesh.vertices, post.mesh.faces).subdivide()
        soup = np.asarray(quads.triangles, float).reshape(-1, 3)
        mesh = TriangleMesh(soup, np.arange(len(soup)).reshape(-1, 3))
        made.append(replace(post, surfaces=(Surface(mesh),)))
    return made


def test_the_posts_of_a_bar_handle_are_no_barrels():
    before, after = told(LEAF, *CASE, *posts(0.38))
    assert after is before


def test_hardware_that_is_chosen_stays_where_it_was_chosen():
    before, after = told(LEAF, *CASE, *knuckles(0.404), choice=JointChoice(count=3))
    assert after == before


BEARINGS = (
    box("bearing_left", (-0.02, -0.02, 0.0), (-0.001, 0.0, 0.02)),
    box("bearing_right", (0.401, -0.02, 0.0), (0.42, 0.0, 0.02)),
)


@pytest.mark.parametrize("joint", [LEFT, sliding("door", (0.0, -1.0, 0.0))], ids=["a side", "a slide"])
@pytest.mark.parametrize("own", ["door", None], ids=["of the leaf", "of the case"])
def test_what_stands_on_a_rod_in_bearings_is_a_flap(joint, own):
    _, after = told(LEAF, *CASE, *BEARINGS, rod(carried_by=own), joint=joint)

    assert after.type is JointType.REVOLUTE
    assert np.allclose(np.abs(after.axis.direction), (1, 0, 0))
    assert np.allclose(after.axis.point[1:], (-0.01, 0.006))
    assert opens_towards(after)[1] < 0
    assert after.reference is None or joint is LEFT


def test_a_bar_that_is_called_a_handle_is_no_rod():
    before, after = told(LEAF, *CASE, *BEARINGS, rod("handle_rod"), joint=LEFT)
    assert after == before


def test_hinges_of_a_neighbour_turn_no_drawer():
    before, after = told(LEAF, *CASE, *knuckles(0.404), joint=sliding("door", (0.0, -1.0, 0.0)))
    assert after == before


@pytest.mark.parametrize("angle", [0.5, np.pi / 2, np.pi])
def test_hinges_are_found_on_furniture_that_stands_turned(angle):
    T = np.eye(4)
    T[:2, :2] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
    asset = scene(LEAF, *CASE, *knuckles(0.404), joints=(LEFT,))
    parts = tuple(replace(p, surfaces=tuple(s.transformed(T) for s in p.surfaces)) for p in asset.parts)
    joints = tuple(replace(j, axis=j.axis.transformed(T)) for j in asset.joints)
    turned = replace(asset, parts=parts, joints=joints)
    (after,) = with_drawn_hinges(plan_from_annotation(turned), turned).joints
    assert np.allclose(after.axis.point[:2], T[:2, :2] @ (0.404, -0.008), atol=1e-6)


def blocks(top: float):
    """Two blocks beside the leaf, up to a height, on which a rod lies that stands out of it."""
    return [box(f"block_{x}", (x, -0.02, -0.02), (x + 0.018, -0.002, top)) for x in (-0.0195, 0.4015)]


def flap_on(*parts):
    """A flap with static parts around it, built: its outcome, what its link holds, and how many poses collide."""
    asset = scene(LEAF, *CASE, *parts, joints=(hinged(axis=Axis(vec3(0.0, -0.01, 0.006), vec3(1.0, 0.0, 0.0))),))
    result = realize(with_drawn_hinges(plan_from_annotation(asset), asset), asset, GALLERY)
    link = next(link for link in result.object.links if link.id == "door")
    return installed(result)["door"], {visual.name: visual for visual in link.visuals}


@pytest.mark.parametrize(("top", "radius"), [(-0.001, 0.006), (0.002, 0.0036)])
def test_a_static_pin_drawn_through_a_flap_turns_with_it(top, radius):
    """Where it is drawn into the blocks that carry it, too, it is made thinner about its axis."""
    made, moving = flap_on(rod("pin", ends=(-0.015, 0.415), carried_by=None), *blocks(top))
    assert made.template == "drawn"
    assert made.collision_share == 0.0
    assert made.opening > 1.5
    assert np.allclose(moving["pin"].mesh.box.size, (0.43, 2 * radius, 2 * radius), atol=1e-4)


def test_a_static_bar_through_a_flap_elsewhere_stays():
    bar = cylinder("bar", ((-0.015, -0.01, 0.2), (0.415, -0.01, 0.2)))
    made, moving = flap_on(rod("pin", ends=(-0.015, 0.415), carried_by=None), *blocks(-0.001), bar)
    assert "bar" not in moving
    assert "bar" not in {clearance.part for clearance in made.clearances if clearance.kind == "joined"}


@pytest.mark.parametrize("riding", [0, 1, 2])
def test_where_one_barrel_of_a_hinge_line_is_static_all_are(riding):
    pins = [replace(pin, carried_by="door" if k < riding else None) for k, pin in enumerate(knuckles(-0.004))]
    before, after = told(LEAF, *CASE, *pins)
    assert len(before.attached) == riding
    assert len(after.attached) == (2 if riding == 2 else 0)


def test_along_what_slides_barrels_are_looked_for_at_its_lower_border_alone(monkeypatch):
    looked, near = [], barrels.barrels_near
    monkeypatch.setattr(barrels, "barrels_near", lambda frame, *rest: looked.append(frame) or near(frame, *rest))

    for joint in (sliding("door", (0.0, -1.0, 0.0)), LEFT):
        looked.clear()
        told(LEAF, *CASE, *BEARINGS, rod(), joint=joint)
        assert len(looked) == (1 if joint is not LEFT else 4)
