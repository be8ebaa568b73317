import numpy as np
import pytest
from PIL import Image

from grafu.articulation.articulated_object import (
    ArticulatedObject,
    Joint,
    JointLimits,
    Link,
    Visual,
    VisualRole,
)
from grafu.errors import ArticulationError
from grafu.geometry.appearance import Material, Surface, Texture
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.render.camera import Camera, three_quarter_view
from grafu.render.exposure import PictureStyle
from grafu.render.gallery import gallery_files, gallery_sheet
from grafu.render.picture import (
    before_after,
    box_of,
    contact_sheet,
    encode_jpeg,
    encode_png,
    opened_values,
    posed_visuals,
    render,
)
from grafu.render.ray_scene import _decode
from grafu.templates.gallery import builtin_gallery
from grafu.templates.template import Gallery
from grafu.vocabulary import JointType, PartLabel

RED = Material("red", (0.8, 0.02, 0.02, 1.0))
SIZE = (96, 72)


def block(name, low, high, material=RED, label=PartLabel.UNKNOWN):
    surface = Surface(TriangleMesh.box_mesh(Box(np.array(low, float), np.array(high, float))), material)
    return Visual(name, (surface,), label=label)


CUBE = block("cube", [-0.5, -0.5, 0], [0.5, 0.5, 1])
CLEAR = PictureStyle(background="transparent", shadow=False)


def head_on(visuals):
    return three_quarter_view(box_of(visuals), SIZE[0] / SIZE[1], azimuth=0.0, elevation=0.0)


@pytest.mark.parametrize("azimuth", [-2.5, -0.5, 0.0, 1.5])
@pytest.mark.parametrize("aspect", [0.5, 1.0, 2.0])
def test_a_three_quarter_view_shows_the_whole_box_and_fills_the_picture(azimuth, aspect):
    box = Box(np.array([-0.3, -0.2, 0.0]), np.array([0.5, 0.2, 2.0]))
    camera = three_quarter_view(box, aspect, azimuth, margin=1.0)
    right, down, forward = ((box.corners() - camera.eye) @ camera.rotation).T
    half = np.tan(camera.fov / 2)
    extent = np.maximum(np.abs(down / forward) / half, np.abs(right / forward) / (half * aspect))
    assert extent.max() == pytest.approx(1.0)


def test_the_front_is_minus_y():
    assert three_quarter_view(box_of([CUBE])).eye[1] < -0.5


def test_rays_pass_through_pixel_middles():
    camera = Camera(np.array([0.0, -3, 0]), np.zeros(3), fov=np.pi / 2)
    rays = camera.rays(2, 2)
    np.testing.assert_allclose(rays[0] / rays[0, 1], [-0.5, 1, 0.5], atol=1e-6)  # top left: -X and +Z
    np.testing.assert_allclose(np.linalg.norm(rays, axis=1), 1, atol=1e-6)


def test_a_camera_that_looks_straight_down_is_refused():
    with pytest.raises(ValueError, match="straight up or down"):
        Camera(np.array([0.0, 0, 3]), np.zeros(3))


def test_a_cube_covers_its_silhouette_in_its_own_colour():
    picture = render([CUBE], head_on([CUBE]), SIZE, CLEAR)
    assert picture.shape == (72, 96, 4)
    assert picture[36, 48, 3] == 255
    assert picture[0, 0, 3] == 0
    r, g, b = picture[36, 48, :3].astype(int)
    assert r > 120 > 3 * max(g, b) / 2
    assert 0.8 * 68**2 < (picture[..., 3] > 127).sum() < 72**2  # seen head on the cube fills the height


def test_a_picture_on_paper_is_white_at_its_corners_and_darker_below():
    plain = render([CUBE], three_quarter_view(box_of([CUBE])), SIZE)
    np.testing.assert_array_equal(plain[0, 0], [255, 255, 255, 255])
    bare = render([CUBE], three_quarter_view(box_of([CUBE])), SIZE, PictureStyle(shadow=False))
    assert plain.astype(int).sum() < bare.astype(int).sum()


def test_the_nearer_part_hides_the_farther_whatever_the_order():
    blue = Material("blue", (0.02, 0.02, 0.8, 1.0))
    near, far = block("near", [-0.4, -0.6, 0.1], [0.4, -0.55, 0.9], blue), CUBE
    one, other = (render(order, head_on([CUBE]), SIZE, CLEAR) for order in ([near, far], [far, near]))
    np.testing.assert_array_equal(one, other)
    assert one[36, 48, 2] > one[36, 48, 0]


def test_inverted_faces_look_like_right_ones():
    mesh = CUBE.mesh
    inverted = Visual("cube", (Surface(TriangleMesh(mesh.vertices, mesh.faces[:, ::-1]), RED),))
    views = [render([v], head_on([CUBE]), SIZE, CLEAR).astype(int) for v in (CUBE, inverted)]
    assert np.abs(views[0] - views[1]).max() <= 8


def test_a_texture_is_laid_the_right_way_up():
    image = Image.new("RGB", (2, 2))
    image.putdata([(255, 0, 0), (0, 255, 0), (0, 0, 255), (255, 255, 255)])  # top: red green, bottom: blue white
    data = encode_png(np.array(image.convert("RGBA")))
    quad = TriangleMesh(np.array([[-1.0, 0, 0], [1, 0, 0], [1, 0, 2], [-1, 0, 2]]), np.array([[0, 1, 2], [0, 2, 3]]))
    uv = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])
    look = Material("checked", (1.0, 1.0, 1.0, 1.0), base_color_texture=Texture("c", data, "image/png"))
    visual = Visual("quad", (Surface(quad, look, uv),))
    picture = render([visual], head_on([visual]), SIZE, CLEAR).astype(int)
    corners = [picture[y, x, :3] for y, x in ((20, 30), (20, 66), (52, 30), (52, 66))]
    assert [int(np.argmax(c)) for c in corners[:3]] == [0, 1, 2]
    assert np.ptp(corners[3]) < 30


def test_glass_lets_what_is_behind_it_through():
    glass = Material("glass", (1.0, 1.0, 1.0, 0.2), alpha_mode="BLEND")
    pane = block("pane", [-0.5, -0.7, 0], [0.5, -0.69, 1], glass)
    picture = render([pane, CUBE], head_on([CUBE]), SIZE, CLEAR).astype(int)
    assert picture[36, 48, 0] > picture[36, 48, 1] + 40
    alone = render([pane], head_on([CUBE]), SIZE, CLEAR)
    assert 30 < alone[36, 48, 3] < 200


def test_categories_have_their_own_colours():
    door = block("door", [-0.5, -0.5, 0], [0.5, 0.5, 1], label=PartLabel.DOOR)
    picture = render([door], head_on([door]), SIZE, PictureStyle("transparent", by_category=True, shadow=False))
    assert picture[36, 48, 2] > picture[36, 48, 0]


def test_borders_between_parts_are_drawn():
    halves = [block("left", [-0.5, -0.5, 0], [0, 0.5, 1]), block("right", [0, -0.5, 0], [0.5, 0.5, 1])]
    drawn, bare = (render(halves, head_on(halves), SIZE, PictureStyle(outlines=on)) for on in (True, False))
    assert drawn[36, 47:49, 0].min() < 0.9 * bare[36, 47:49, 0].min()


def test_nothing_at_all_is_an_empty_picture():
    assert (render([], Camera(vec3(0.0, -3.0, 1.0), np.zeros(3)), SIZE) == 255).all()


def test_pictures_are_the_same_each_time():
    views = [render([CUBE], three_quarter_view(box_of([CUBE])), SIZE) for _ in range(2)]
    np.testing.assert_array_equal(*views)


def test_a_size_of_nothing_is_refused():
    with pytest.raises(ValueError, match="positive width and height"):
        render([CUBE], head_on([CUBE]), (0, 10))


def cabinet():
    body, door = block("body", [-0.5, -0.2, 0], [0.5, 0.5, 1]), block("door", [-0.5, -0.25, 0], [0.5, -0.2, 1])
    axis = Axis(vec3(-0.5, -0.25, 0.0), vec3(0.0, 0.0, -1.0))
    joint = Joint("door_joint", JointType.REVOLUTE, "base", "door", axis, JointLimits(0.0, 1.5))
    return ArticulatedObject("cabinet", "base", (Link("base", (body,)), Link("door", (door,))), (joint,))


def test_an_opened_door_stands_in_front():
    closed, opened = posed_visuals(cabinet()), posed_visuals(cabinet(), opened_values(cabinet()))
    assert closed[1].mesh.box.low[1] == pytest.approx(-0.25)
    assert opened[1].mesh.box.low[1] < -1.2
    assert [v.name for v in opened] == ["body", "door"]


def test_what_stays_keeps_its_surfaces():
    made = cabinet()
    body, door = posed_visuals(made, opened_values(made))
    assert body.surfaces is made.links[0].visuals[0].surfaces
    assert door.surfaces is not made.links[1].visuals[0].surfaces


def test_half_open_is_half_the_range():
    assert opened_values(cabinet(), 0.5) == {"door_joint": 0.75}


def test_an_unknown_joint_is_refused():
    with pytest.raises(ArticulationError, match="drawer_joint"):
        posed_visuals(cabinet(), {"drawer_joint": 1.0})


def test_before_and_after_stand_side_by_side_and_differ():
    both = before_after(cabinet(), SIZE)
    assert both.shape == (72, 192, 4)
    assert np.abs(both[:, :96].astype(int) - both[:, 96:]).sum() > 10_000


def test_before_may_be_another_model():
    alone = before_after(cabinet(), SIZE, before=[CUBE])
    assert not np.array_equal(alone[:, :96], before_after(cabinet(), SIZE)[:, :96])


def test_a_contact_sheet_has_a_cell_and_a_caption_for_each_picture():
    picture = np.full((50, 60, 4), 255, np.uint8)
    sheet = contact_sheet([picture] * 5, ["one", "two", "three", "four", "five"], columns=2)
    strip = sheet.shape[0] // 3 - 50
    assert sheet.shape[:2] == (3 * (50 + strip), 120)
    assert sheet[50 : 50 + strip, :60, :3].min() < 120  # the caption's ink
    assert sheet[-strip:, 60:, :3].min() == 255  # no sixth


@pytest.mark.parametrize("captions", [[], ["one", "two"]])
def test_a_contact_sheet_needs_a_caption_each(captions):
    with pytest.raises(ValueError, match="a caption each"):
        contact_sheet([np.zeros((4, 4, 4), np.uint8)], captions)


def test_pictures_become_files():
    picture = render([CUBE], head_on([CUBE]), SIZE, CLEAR)
    png, jpeg = encode_png(picture), encode_jpeg(picture)
    assert png.startswith(b"\x89PNG")
    assert jpeg.startswith(b"\xff\xd8")


def test_a_gallery_becomes_a_glb_each_and_a_sheet():
    gallery = builtin_gallery()
    few = Gallery(gallery.hinges[:1], gallery.rails[:1])
    files = gallery_files(few)
    assert sorted(files.contents) == ["butt.glb", "centre_mount.glb", "templates.png"]
    assert files.contents["butt.glb"].startswith(b"glTF")
    assert gallery_sheet(few, (40, 30)).shape[1] == 160


def test_hardware_keeps_its_metal_among_categories():
    hinge = Visual("hinge_1", CUBE.surfaces, VisualRole.HARDWARE)
    picture = render([hinge], head_on([hinge]), SIZE, PictureStyle("transparent", by_category=True, shadow=False))
    assert picture[36, 48, 0] > 2 * picture[36, 48, 2]


def test_an_image_that_is_broken_is_drawn_grey():
    grey = _decode(Texture("a.png", b"\x89PNG\r\n\x1a\n and no more", "image/png"))
    assert grey.shape == (1, 1, 4)
    assert len(set(grey[0, 0, :3].tolist())) == 1


def sliding(*leaves):
    """Returns a case whose leaves (x from, x to, distance along x, y) slide, metres."""
    links, joints = [Link("base", (block("back", [-1.0, 0.0, 0], [1.0, 0.5, 1]),))], []
    for k, (left, right, distance, y) in enumerate(leaves):
        links.append(Link(f"leaf_{k}", (block(f"leaf_{k}", [left, y, 0], [right, y + 0.02, 1]),)))
        axis = Axis(vec3(0.0, 0.0, 0.0), vec3(np.sign(distance), 0.0, 0.0))
        limits = JointLimits(0.0, abs(distance))
        joints.append(Joint(f"joint_{k}", JointType.PRISMATIC, "base", f"leaf_{k}", axis, limits))
    return ArticulatedObject("sliding", "base", tuple(links), tuple(joints))


@pytest.mark.parametrize(
    ("leaves", "shown"),
    [
        ([(-1.0, 0.02, 0.98, -0.05), (-0.02, 1.0, -0.98, -0.1)], [0.98, 0.0]),
        ([(-1.0, 0.02, 0.3, -0.05), (-0.02, 1.0, -0.3, -0.1)], [0.3, 0.3]),
        ([(-1.0, 0.0, -0.9, -0.05), (0.0, 1.0, 0.9, -0.05)], [0.9, 0.9]),
        ([(-1.0, -0.3, 0.65, -0.05), (-0.35, 0.35, 0.65, -0.1), (0.3, 1.0, -0.65, -0.05)], [0.65, 0.65, 0.0]),
    ],
    ids=["change places", "meet half way", "part", "three leaves"],
)
def test_leaves_that_would_only_change_places_are_not_both_shown_open(leaves, shown):
    values = opened_values(sliding(*leaves))
    assert [values[f"joint_{k}"] for k in range(len(leaves))] == pytest.approx(shown)
