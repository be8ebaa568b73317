"""Hypothesis strategies of several tests: specs of synthetic furniture of every kind.

Draw a spec and call `made(spec)` in the test: a failure then shows the spec, and not thousands of vertices.
"""

from math import pi

from hypothesis import strategies as st

from grafu.asset.part import Asset
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.cabinets.chest import Chest, make_chest
from grafu.synth.cabinets.corner import CornerCabinet, make_corner_cabinet
from grafu.synth.case.case import Case
from grafu.synth.case.construction import Base, FaceFrame, Top
from grafu.synth.fronts.hold import Hold
from grafu.synth.fronts.layout import CellRow, Door, Drawer, Layout, OpenCell, Pair, Stack
from grafu.synth.tables.desk import Desk, make_desk
from grafu.synth.tables.table import DrawerTable, make_table

handles = st.sampled_from(["bar-round", "bar-profile", "bail", "knob-round", "ring", "cup-shell", "none"])
boards = st.sampled_from(["slab", "chamfered", "rounded", "arched", "planks", "raised panel", "two panels"])
frames = st.sampled_from(["shaker", "glass", "mirror", "muntins", "louvred", "arched rail"])
flat_styles = st.one_of(boards, frames)
drawer_styles = st.one_of(flat_styles, st.just("bowed"))
pair_styles = st.one_of(drawer_styles, st.sampled_from(["swept", "swept frame", "half arched"]))
grips = st.sampled_from(["scoop", "slot", "edge channel", "finger hole", "lip"])
holds = st.builds(
    Hold,
    place=st.sampled_from(["usual", "middle line", "top edge", "bottom edge"]),
    along=st.one_of(st.none(), st.floats(0.0, 1.0)),
    length=st.one_of(st.none(), st.floats(0.02, 2.0)),
    ratio=st.floats(0.1, 1.0),
    count=st.sampled_from([1, 1, 2]),
)
drawer_boxes = st.sampled_from(["whole", "no bottom", "shell", "front only"])
yaws = st.floats(-pi, pi).map(lambda angle: round(angle, 3))
small_counts = st.integers(0, 2)

doors = st.one_of(
    st.builds(Door, st.sampled_from(["left", "right"]), drawer_styles, handles, shelves=small_counts, hold=holds),
    st.builds(Door, st.sampled_from(["top", "bottom"]), flat_styles, handles, shelves=small_counts, hold=holds),
    st.builds(
        Door, st.sampled_from(["left", "right", "top", "bottom"]), handle=st.just("none"), hold=holds, grip=grips
    ),
)
drawers = st.builds(Drawer, drawer_boxes, drawer_styles, handles, hold=holds)
pairs = st.builds(Pair, pair_styles, handles, shelves=small_counts, muntin=st.sampled_from([0.0, 0.03]))
leaves = st.one_of(doors, drawers, pairs, st.builds(OpenCell, small_counts))
betweens = st.sampled_from(["panel", "rail", "nothing"])


def _cells(children: st.SearchStrategy[Layout]) -> st.SearchStrategy[Layout]:
    several = st.lists(children, min_size=2, max_size=3).map(tuple)
    return st.one_of(st.builds(CellRow, several, between=betweens), st.builds(Stack, several, between=betweens))


layouts = st.one_of(leaves, _cells(leaves))
cases = st.builds(
    Case,
    width=st.floats(0.6, 1.6),
    height=st.floats(0.6, 2.0),
    depth=st.floats(0.3, 0.6),
    panel=st.sampled_from([0.008, 0.018, 0.03]),
    base=st.builds(Base, st.sampled_from(["none", "plinth", "legs", "toe kick", "posts", "sled"])),
    top=st.builds(
        Top, st.sampled_from(["between", "over", "none", "stretchers"]), overhang=st.sampled_from([0.0, 0.02])
    ),
    frame=st.sampled_from([None, FaceFrame(0.04), FaceFrame(0.04, "bars"), FaceFrame(0.04, "strips", 0.001)]),
)
mounts = st.sampled_from(["overlay", "inset"])
cabinet_specs = st.builds(Cabinet, case=cases, layout=layouts, mount=mounts, gap=st.sampled_from([0.002, 0.003]))
table_specs = st.builds(DrawerTable, has_aprons=st.booleans(), two_sided=st.booleans())
desk_specs = st.builds(Desk, left=st.one_of(st.none(), doors))
chest_specs = st.builds(Chest, overhang=st.floats(0.0, 0.03))
corner_specs = st.builds(CornerCabinet, along_x=st.floats(0.8, 1.3), mount=mounts)
furniture_specs = st.one_of(cabinet_specs, cabinet_specs, table_specs, desk_specs, chest_specs, corner_specs)

_MAKERS = {
    Cabinet: make_cabinet,
    DrawerTable: make_table,
    Desk: make_desk,
    Chest: make_chest,
    CornerCabinet: make_corner_cabinet,
}


def made(spec: Cabinet | DrawerTable | Desk | Chest | CornerCabinet) -> Asset:
    """Returns the furniture of a drawn spec."""
    return _MAKERS[type(spec)](spec)
