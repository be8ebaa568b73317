"""What is called a drawer and holds drawers is their case; else a drawer stays one."""

from dataclasses import replace

import pytest

import grafu
from grafu.asset.part import Asset, Part, PartSource
from grafu.joints.named_cases import with_case_label
from grafu.vocabulary import PartLabel
from small_scenes import box, scene


def named(part: Part) -> Part:
    return replace(part, labelled_by="name")


def hollow(name: str, low, high, wall: float = 0.02, *, front: bool = False, lid: bool = True) -> Part:
    """A box with walls, open in front unless it has a `front`, and from above without a `lid`."""
    (x0, y0, z0), (x1, y1, z1), t = low, high, wall
    boards = [
        box("a", low, (x0 + t, y1, z1)),
        box("b", (x1 - t, y0, z0), high),
        box("c", low, (x1, y1, z0 + t)),
        box("d", (x0, y1 - t, z0), high),
        *([box("e", (x0, y0, z1 - t), high)] if lid else []),
        *([box("f", low, (x1, y0 + t, z1))] if front else []),
    ]
    whole = box(name, low, high)
    return named(replace(whole, surfaces=tuple(surface for board in boards for surface in board.surfaces)))


CASE = hollow("drawer_box", (-0.3, -0.25, 0.0), (0.3, 0.25, 0.6))
TRAYS = [
    hollow(f"drawer_{k}", (-0.275, -0.27, 0.03 + 0.29 * k), (0.275, 0.2, 0.28 + 0.29 * k), 0.01, front=True, lid=False)
    for k in (0, 1)
]
KNOBS = [box(f"handle_{k}", (-0.02, -0.3, 0.15 + 0.29 * k), (0.02, -0.27, 0.17 + 0.29 * k)) for k in (0, 1)]


def moving(asset: Asset) -> set[str]:
    return {joint.child for joint in grafu.functionalize(asset).object.joints}


def test_drawers_slide_out_of_the_one_that_holds_them():
    assert moving(scene(CASE, *TRAYS, *KNOBS)) == {"drawer_0", "drawer_1"}


FRONTS = [named(box(f"drawer_{k}", (-0.3, -0.27, 0.3 * k), (0.3, -0.25, 0.29 + 0.3 * k))) for k in (0, 1)]
INNER = hollow("drawer_0", (-0.25, -0.2, 0.04), (0.25, 0.2, 0.2), front=True, lid=False)

SIDE = box("side", (0.3, -0.25, 0.0), (0.32, 0.25, 0.6))

OTHERS = {
    "one drawer in a drawer": scene(CASE, INNER, SIDE),
    "drawers above one another": scene(*TRAYS),
    "fronts before a drawer": scene(CASE, *FRONTS),
    "boards of a drawer": scene(CASE, named(box("drawer_bottom", (-0.28, -0.2, 0.03), (0.28, 0.2, 0.05)))),
    "what the user called a drawer": scene(replace(CASE, labelled_by="user"), INNER),
    "one drawer": scene(CASE),
}


@pytest.mark.parametrize("what", OTHERS)
def test_else_nothing_is_taken_for_a_case(what):
    assert with_case_label(OTHERS[what]) is OTHERS[what]


def test_a_case_has_no_category():
    made = with_case_label(scene(CASE, INNER))
    assert [(part.label, part.labelled_by) for part in made.parts] == [
        (PartLabel.MISC, "shape"),
        (PartLabel.DRAWER, "name"),
    ]


def labels(asset: Asset) -> dict[str, PartLabel]:
    return {part.id: part.label for part in with_case_label(asset).parts if part.source.name.startswith("drawer")}


def test_what_holds_two_drawers_beside_other_parts_is_a_case():
    drawer = PartLabel.DRAWER
    assert labels(scene(CASE, *TRAYS, SIDE)) == {"drawer_box": PartLabel.MISC, "drawer_0": drawer, "drawer_1": drawer}


@pytest.mark.parametrize(
    ("kind", "link", "holds"), [("urdf", "slide", True), ("urdf", "body", False), ("glb", "slide", False)]
)
def test_on_the_link_of_the_body_of_a_robot_one_drawer_of_another_link_tells_a_case(kind, link, holds):
    boards = [box(f"board_{k}", (0.3 + 0.02 * k, -0.25, 0.0), (0.32 + 0.02 * k, 0.25, 0.9)) for k in range(3)]
    links = dict.fromkeys(("drawer_box", *(board.id for board in boards)), "body") | {"drawer_0": link}
    parts = [replace(p, source=PartSource(p.source.name, link=links[p.id])) for p in (CASE, INNER, *boards)]
    found = labels(replace(scene(*parts), kind=kind))
    assert found == {"drawer_box": PartLabel.MISC if holds else PartLabel.DRAWER, "drawer_0": PartLabel.DRAWER}


UPPER = hollow("drawer_top", (-0.3, -0.25, 0.6), (0.3, 0.25, 0.9))
SIDE_BY_SIDE = [
    hollow(f"drawer_{k + 2}", (x, -0.22, 0.63), (x + 0.265, 0.2, 0.85), 0.01, front=True, lid=False)
    for k, x in enumerate((-0.27, 0.005))
]


@pytest.mark.parametrize(("link", "holds"), [("", True), ("body", True), ("slide", False)])
def test_beside_the_largest_case_another_may_hold_drawers(link, holds):
    """In a robot it is on the link of the body: what has a link of its own, with trays in it, is a drawer."""
    boards = [box(f"board_{k}", (0.3 + 0.02 * k, -0.25, 0.0), (0.32 + 0.02 * k, 0.25, 0.9)) for k in range(3)]
    parts = [CASE, *TRAYS, UPPER, *SIDE_BY_SIDE, *boards]
    if link:
        links = {p.id: "body" for p in (CASE, *boards)} | {p.id: p.id for p in TRAYS} | {"drawer_top": link}
        links |= {p.id: link if link == "slide" else p.id for p in SIDE_BY_SIDE}
        parts = [replace(p, source=PartSource(p.source.name, link=links[p.id])) for p in parts]
    cases = {name for name, label in labels(replace(scene(*parts), kind="urdf")).items() if label is PartLabel.MISC}
    assert cases == ({"drawer_box", "drawer_top"} if holds else {"drawer_box"})
