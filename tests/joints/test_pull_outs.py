"""A slim front with a rack behind it that nothing else holds slides out with the rack; other doors stay hinged."""

from dataclasses import replace

import pytest

from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.graph.parse import parse_graph
from grafu.joints.plan import JointRequest, RealizationPlan
from grafu.joints.pull_outs import with_pull_outs
from grafu.joints.realize import realize
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.report import report_of
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import JointType, PartLabel
from judging import GALLERY, installed, swept_collisions
from small_scenes import box, cylinder, scene

FRONT = box("door", (0.0, -0.021, 0.1), (0.3, -0.001, 0.8))
HANDLE = cylinder("handle", ((0.1, -0.05, 0.72), (0.2, -0.05, 0.72)))
POSTS = [cylinder(f"handle_post_{k}", ((x, -0.05, 0.72), (x, -0.02, 0.72))) for k, x in enumerate((0.11, 0.19))]
CASE = [
    replace(part, label=label)
    for part, label in (
        (box("left", (0.0, 0.0, 0.1), (0.018, 0.5, 0.8)), PartLabel.SIDE_PANEL),
        (box("right", (0.282, 0.0, 0.1), (0.3, 0.5, 0.8)), PartLabel.SIDE_PANEL),
        (box("floor", (0.018, 0.0, 0.1), (0.282, 0.5, 0.118)), PartLabel.BOTTOM_PANEL),
        (box("top", (0.018, 0.0, 0.782), (0.282, 0.5, 0.8)), PartLabel.TOP_PANEL),
        (box("back", (0.018, 0.482, 0.118), (0.282, 0.5, 0.782)), PartLabel.BACK_PANEL),
    )
]
RACK = [
    box("post_near", (0.14, 0.0, 0.15), (0.16, 0.02, 0.75)),
    box("post_far", (0.14, 0.44, 0.15), (0.16, 0.46, 0.75)),
    box("tray_low", (0.05, 0.0, 0.15), (0.25, 0.46, 0.16)),
    box("tray_high", (0.05, 0.0, 0.45), (0.25, 0.46, 0.46)),
    *(box(f"bar_{k}", (x, 0.0, 0.16), (x + 0.012, 0.46, 0.23)) for k, x in enumerate((0.05, 0.238))),
]


def requests(*parts):
    hinge = JointRequest("door", JointType.REVOLUTE, Axis(vec3(0.0, -0.02, 0.45), vec3(0.0, 0.0, -1.0)), "network")
    asset = scene(*parts)
    return with_pull_outs(RealizationPlan((hinge,), ()), asset, parse_graph(asset)).joints


def test_a_rack_slides_out_with_its_front():
    asset = scene(FRONT, HANDLE, *POSTS, *CASE, *RACK)
    made = functionalize(asset, MotionSource.NETWORK, builtin_gallery())
    (joint,) = made.object.joints
    assert (joint.child, joint.type) == ("door", JointType.PRISMATIC)
    assert joint.axis.direction[1] == pytest.approx(-1.0)
    moving = {visual.name for visual in made.object.link("door").visuals}
    assert {"door", *(part.id for part in RACK)} <= moving
    assert not moving & {part.id for part in CASE}
    assert not swept_collisions(made.object, joint, 20)
    assert joint.limits.upper > 0.3
    report = report_of(made)
    assert [guess.part for guess in report.guesses if guess.part == "door"] == []
    assert [one.part for one in report.added if one.style == "drawer box"] == []


OTHERS = {
    "nothing behind it": (FRONT, *CASE),
    "shelves between the sides": (FRONT, *CASE, box("shelf", (0.018, 0.02, 0.45), (0.282, 0.48, 0.46))),
    "a rack on the floor of the case": (FRONT, *CASE, *RACK, box("foot", (0.1, 0.1, 0.118), (0.2, 0.2, 0.15))),
    "a rack that ends far behind the front": (
        FRONT,
        *CASE,
        box("post", (0.14, 0.1, 0.15), (0.16, 0.12, 0.75)),
        RACK[1],
        box("tray_low", (0.05, 0.1, 0.15), (0.25, 0.46, 0.16)),
        box("tray_high", (0.05, 0.1, 0.45), (0.25, 0.46, 0.46)),
    ),
    "one loose board": (FRONT, *CASE, box("board", (0.05, 0.0, 0.15), (0.25, 0.46, 0.75))),
    "a wide front": (
        box("door", (-0.3, -0.02, 0.1), (0.6, 0.0, 0.8)),
        *(part for part in CASE if part.id not in ("left", "right")),
        *RACK,
    ),
}


@pytest.mark.parametrize("what", OTHERS)
def test_other_doors_stay_hinged(what):
    (request,) = requests(*OTHERS[what])
    assert (request.type, request.attached) == (JointType.REVOLUTE, ())


def test_the_rack_behind_a_front_is_attached_to_it():
    (request,) = requests(FRONT, *CASE, *RACK)
    assert request.type is JointType.PRISMATIC
    assert set(request.attached) == {part.id for part in RACK}


def test_what_is_called_a_drawer_and_slides_takes_its_rack_with_it():
    rail = JointRequest("door", JointType.PRISMATIC, Axis(vec3(0.15, -0.01, 0.45), vec3(0.0, -1.0, 0.0)), "network")
    aside = replace(rail, axis=Axis(rail.axis.point, vec3(-1.0, 0.0, 0.0)))

    def attached(request, *parts):
        asset = scene(*parts)
        (made,) = with_pull_outs(RealizationPlan((request,), ()), asset, parse_graph(asset)).joints
        return made.type, set(made.attached)

    assert attached(rail, FRONT, *CASE, *RACK) == (JointType.PRISMATIC, {part.id for part in RACK})
    assert attached(rail, FRONT, *CASE) == (JointType.PRISMATIC, set())
    assert attached(aside, FRONT, *CASE, *RACK) == (JointType.PRISMATIC, set())  # a sliding door before a rack


def test_a_bin_on_its_front_slides_out_with_it_and_a_board_does_not():
    walls = [
        box("b", (0.05, 0.0, 0.15), (0.25, 0.4, 0.155)),
        *(box("b", (x, 0.0, 0.15), (x + 0.005, 0.4, 0.55)) for x in (0.05, 0.245)),
        *(box("b", (0.05, y, 0.15), (0.25, y + 0.005, 0.55)) for y in (0.0, 0.395)),
    ]
    bucket = replace(
        box("bucket", (0.0, 0.0, 0.0), (1.0, 1.0, 1.0)), surfaces=tuple(s for wall in walls for s in wall.surfaces)
    )
    board = box("board", (0.05, 0.0, 0.15), (0.25, 0.4, 0.55))

    assert [r.attached for r in requests(FRONT, *CASE, bucket)] == [("bucket",)]
    assert [r.attached for r in requests(FRONT, *CASE, board)] == [()]


def pails(width: float = 0.3, runners: bool = True):
    """A front with two rails on it that a pail hangs in; the rails run in runners on the sides of the case."""
    side = (width - 0.018 - 0.018) / 2
    middle, out = width / 2, side - 0.014
    case = [
        box("left", (0.0, 0.0, 0.1), (0.018, 0.5, 0.8)),
        box("right", (width - 0.018, 0.0, 0.1), (width, 0.5, 0.8)),
        box("back", (0.018, 0.482, 0.1), (width - 0.018, 0.5, 0.8)),
    ]
    name = "fixed_runner" if runners else "ledge"
    held = []
    for sign in (-1, 1):
        edges = sorted((middle + sign * side, middle + sign * out))
        held.append(box(f"{name}_{sign}", (edges[0], 0.01, 0.4), (edges[1], 0.47, 0.43)))
        edges = sorted((middle + sign * out, middle + sign * (out - 0.015)))
        held.append(box(f"carrier_rail_{sign}", (edges[0], -0.001, 0.405), (edges[1], 0.45, 0.425)))
        edges = sorted((middle + sign * (out - 0.005), middle + sign * (out - 0.025)))
        held.append(box(f"pail_rim_{sign}", (edges[0], 0.02, 0.425), (edges[1], 0.4, 0.435)))
    inner = out - 0.02
    ends = (middle - inner, middle + inner)
    held += [
        box("pail_floor", (ends[0], 0.02, 0.15), (ends[1], 0.4, 0.155)),
        *(box(f"pail_wall_{x > middle}", (min(x, x - d), 0.02, 0.15), (max(x, x - d), 0.4, 0.56))
          for x, d in ((ends[0], -0.004), (ends[1], 0.004))),
    ]  # fmt: skip
    return box("door", (0.0, -0.021, 0.1), (width, -0.001, 0.8)), case, held


@pytest.mark.parametrize("width", [0.3, 0.6])
def test_what_hangs_on_rails_of_the_front_slides_out_though_these_run_in_runners(width):
    front, case, held = pails(width)
    (request,) = requests(front, *case, *held)

    assert request.type is JointType.PRISMATIC
    assert set(request.attached) == {part.id for part in held if not part.id.startswith("fixed_runner")}


def test_what_lies_on_ledges_of_the_case_as_well_stays_in_it():
    front, case, held = pails(runners=False)

    assert [r.type for r in requests(front, *case, *held)] == [JointType.REVOLUTE]


def test_what_runs_in_runners_and_does_not_touch_the_front_stays_behind_it():
    front, case, held = pails()
    clear = [part for part in held if not part.id.startswith("carrier")]
    carriers = [part for part in held if part.id.startswith("carrier")]
    cut = [box(p.id, (p.box.low[0], 0.005, p.box.low[2]), tuple(p.box.high)) for p in carriers]

    assert [r.type for r in requests(front, *case, *clear, *cut)] == [JointType.REVOLUTE]


def test_a_front_wider_than_high_stays_hinged():
    front, case, held = pails(0.8)

    assert [r.type for r in requests(front, *case, *held)] == [JointType.REVOLUTE]


def test_baskets_that_were_guessed_to_move_by_themselves_are_pieces_of_the_rack():
    basket = RACK[2]
    own = JointRequest(basket.id, JointType.PRISMATIC, Axis(vec3(0.15, 0.2, 0.15), vec3(0.0, -1.0, 0.0)), "network")
    hinge = JointRequest("door", JointType.REVOLUTE, Axis(vec3(0.0, -0.02, 0.45), vec3(0.0, 0.0, -1.0)), "network")

    def moving(label):
        rack = [replace(part, label=label) if part is basket else part for part in RACK]
        asset = scene(FRONT, *CASE, *rack)
        return [r.moving for r in with_pull_outs(RealizationPlan((hinge, own), ()), asset, parse_graph(asset)).joints]

    assert moving(PartLabel.UNKNOWN) == ["door"]
    assert moving(PartLabel.DRAWER) == ["door", basket.id]


def as_one(name, parts):
    """One part with the surfaces of several."""
    return replace(
        parts[0], id=name, label=PartLabel.UNKNOWN, surfaces=tuple(s for part in parts for s in part.surfaces)
    )


def test_a_rack_may_be_drawn_in_one_part_but_boards_that_hang_in_the_air_are_none():
    (request,) = requests(FRONT, *CASE, as_one("rack", RACK))
    assert (request.type, request.attached) == (JointType.PRISMATIC, ("rack",))

    boards = [box("b", (0.05, 0.0, z), (0.25, 0.46, z + 0.01)) for z in (0.15, 0.4, 0.6, 0.74)]
    assert [r.attached for r in requests(FRONT, *CASE, as_one("boards", boards))] == [()]


def opening(*behind):
    """How far a front opens whose mesh holds what is behind it, too (metres)."""
    front = as_one("door", (FRONT, *behind))
    slide = JointRequest("door", JointType.PRISMATIC, Axis(FRONT.box.center, vec3(0.0, -1.0, 0.0)), "network")
    built = installed(realize(RealizationPlan((slide,)), scene(front, *CASE), GALLERY))
    return built["door"].opening


def test_rails_run_beside_an_open_rack_that_is_drawn_with_its_front():
    corners = [(x, y) for x in (0.06, 0.23) for y in (0.0, 0.44)]
    posts = [box("post", (x, y, 0.15), (x + 0.01, y + 0.01, 0.75)) for x, y in corners]
    boards = [box("board", (0.06, 0.0, z), (0.24, 0.45, z + 0.003)) for z in (0.16, 0.365, 0.57, 0.745)]
    assert opening(*posts, *boards) > 0.3


def test_rails_run_along_two_bins_one_behind_the_other_but_not_along_one_far_behind():
    def bin_at(first, last):
        return box("bin", (0.05, first, 0.15), (0.25, last, 0.55))

    assert opening(bin_at(-0.001, 0.21), bin_at(0.24, 0.45)) > 0.3
    assert opening(bin_at(-0.001, 0.21), bin_at(0.32, 0.45)) < 0.25
