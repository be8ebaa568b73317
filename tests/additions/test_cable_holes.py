"""A drawn back with holes for cables stays as drawn: it is not missing, gets no second one, and its holes stay open."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
import shapely
from shapely.geometry import Point, Polygon

from grafu.additions.carcass.complete import complete_carcass
from grafu.additions.carcass.config import CarcassConfig
from grafu.additions.carcass.missing_panels import missing_panels
from grafu.additions.carcass.step import add_carcass_boards
from grafu.additions.step import StepRequest
from grafu.additions.top.section import slab_mesh
from grafu.articulation.articulated_object import Visual, VisualRole
from grafu.articulation.collision_shapes import corners_of, shapes_of
from grafu.articulation.convex_pieces import convex_pieces
from grafu.asset.part import Asset, Part
from grafu.geometry.appearance import Surface
from grafu.geometry.mesh import TriangleMesh
from grafu.joints.make_plan import plan_from_annotation
from grafu.pipeline.additions import planned_scene
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.case.case import Case
from grafu.synth.fronts.layout import Pair
from grafu.vocabulary import PartLabel

WHOLE = make_cabinet(Cabinet("cabinet", Case(width=0.8), Pair()))
BACK = next(part for part in WHOLE.parts if part.label is PartLabel.BACK_PANEL)
HOLES: dict[str, Sequence[shapely.Geometry]] = {
    "one outlet of 4 cm": [Point(0.13, 0.21).buffer(0.0205)],
    "one outlet of 6 cm": [Point(0.1, 0.2).buffer(0.03)],
    "outlets in a row": [Point(x, 0.36).buffer(0.03) for x in (-0.24, -0.08, 0.08, 0.24)],
    "a slot and an outlet": [shapely.box(-0.3, 0.5, -0.2, 0.56), Point(0.2, 0.2).buffer(0.035)],
    "a large cut-out": [shapely.box(-0.28, 0.16, 0.28, 0.62)],
}


def with_holes(holes: Sequence[shapely.Geometry]) -> Asset:
    """The cabinet with holes cut through its back: outlines over (x, z)."""
    low, high = BACK.box.low, BACK.box.high
    plate = shapely.box(low[0], low[2], high[0], high[2]).difference(shapely.union_all(list(holes)))
    assert isinstance(plate, Polygon)
    assert len(plate.interiors) == len(holes)
    slab = slab_mesh(plate, float(low[1]), float(high[1]))
    mesh = TriangleMesh(slab.vertices[:, [0, 2, 1]], slab.faces[:, ::-1])
    back = replace(BACK, surfaces=(Surface(mesh),))
    return replace(WHOLE, parts=tuple(back if part is BACK else part for part in WHOLE.parts))


def back_of(asset: Asset) -> Part:
    return asset.part(BACK.id)


def outlines_of_shapes(part: Part) -> shapely.Geometry:
    """All collision shapes of a part seen from the front."""
    shapes = shapes_of(Visual(part.id, part.surfaces, VisualRole.PART, part.label))
    flat = [shapely.MultiPoint(np.asarray(corners_of(shape))[:, [0, 2]]).convex_hull for shape in shapes]
    return shapely.union_all(flat)


@pytest.mark.parametrize("name", HOLES)
def test_a_back_with_holes_is_not_missing_and_gets_no_second_one(name: str) -> None:
    asset = with_holes(HOLES[name])
    plan = plan_from_annotation(asset)
    scene = planned_scene(asset, plan)

    assert missing_panels(scene, plan) == ()
    assert complete_carcass(scene, plan).additions == ()
    expected = StepRequest(plan, boards=frozenset({PartLabel.BACK_PANEL}))  # the network expects one
    for config in (None, CarcassConfig()):
        made = add_carcass_boards(scene, expected, config)
        assert made.additions == ()
        assert np.array_equal(made.scene.parts[BACK.id].mesh.vertices, back_of(asset).mesh.vertices)


@pytest.mark.parametrize("name", HOLES)
def test_holes_stay_open_in_collision_shapes(name: str) -> None:
    covered = outlines_of_shapes(back_of(with_holes(HOLES[name])))

    for hole in HOLES[name]:
        assert hole.difference(covered).area >= 0.7 * hole.area
        circle = shapely.maximum_inscribed_circle(hole)
        assert not covered.intersects(Point(*circle.coords[0]).buffer(0.55 * circle.length))
    plate = shapely.box(BACK.box.low[0], BACK.box.low[2], BACK.box.high[0], BACK.box.high[2])
    board = plate.difference(shapely.union_all(list(HOLES[name])))
    assert board.difference(covered).area <= 0.02 * board.area


def test_a_sheet_has_open_holes_too() -> None:
    plate = shapely.box(-0.4, 0.0, 0.4, 0.7).difference(HOLES["one outlet of 6 cm"][0])
    slab = slab_mesh(plate, 0.0, 0.001)
    kept = np.all(slab.vertices[slab.faces][:, :, 2] == 0.0, axis=1)
    sheet = TriangleMesh(slab.vertices, slab.faces[kept])

    pieces = convex_pieces(sheet)

    hulls = shapely.union_all([shapely.MultiPoint(piece.vertices[:, :2]).convex_hull for piece in pieces])
    assert not hulls.intersects(Point(0.1, 0.2).buffer(0.015))


def test_a_whole_back_and_one_with_screw_holes_are_one_shape() -> None:
    assert len(shapes_of(Visual("back", BACK.surfaces, VisualRole.PART, BACK.label))) == 1
    screws = with_holes([Point(x, 0.3).buffer(0.004) for x in (-0.2, 0.2)])
    back = back_of(screws)
    assert len(shapes_of(Visual("back", back.surfaces, VisualRole.PART, back.label))) == 1


def test_rails_above_and_below_are_no_back() -> None:
    low, high = BACK.box.low, BACK.box.high
    rails = [
        TriangleMesh.box_mesh(type(BACK.box)(np.array([low[0], low[1], a]), np.array([high[0], high[1], b])))
        for a, b in ((low[2], low[2] + 0.1), (high[2] - 0.1, high[2]))
    ]
    back = replace(BACK, surfaces=tuple(Surface(mesh) for mesh in rails))
    asset = replace(WHOLE, parts=tuple(back if part is BACK else part for part in WHOLE.parts))
    plan = plan_from_annotation(asset)

    assert [panel.what for panel in missing_panels(planned_scene(asset, plan), plan)] == [PartLabel.BACK_PANEL]
