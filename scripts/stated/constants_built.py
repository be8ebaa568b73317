"""Sentences of the pages on what is built: additions, joints, templates and exports (see `constants.py`)."""

from collections.abc import Iterator
from math import degrees

from build_blender_addon import LARGEST
from judge_additions_table import COVERED

from grafu.additions.carcass.config import CarcassConfig
from grafu.additions.compartment.config import SolidBodyConfig
from grafu.additions.drawer_box.config import DrawerBoxConfig
from grafu.additions.grip.config import GripConfig
from grafu.additions.handle.config import HandleConfig
from grafu.additions.handle.grasp_config import GraspConfig
from grafu.additions.interior.config import InteriorConfig
from grafu.additions.top.config import TopConfig
from grafu.articulation.build_material import MassConfig
from grafu.articulation.collision_clearance import ShapeClearanceConfig
from grafu.articulation.collision_shapes import CollisionShapeConfig
from grafu.articulation.floor_clearance import FloorConfig
from grafu.articulation.joint_dynamics import DynamicsConfig
from grafu.articulation.physics import PhysicsConfig
from grafu.articulation.stability import StabilityConfig
from grafu.asset.wall_units import WallUnitConfig
from grafu.completion.features import FeatureConfig
from grafu.export.gltf_packing import DracoConfig
from grafu.export.usd.config import UsdConfig
from grafu.joints.config import RealizationConfig
from grafu.judging.tops import DEFAULT_TOP_MEASURE_CONFIG as TOP_MEASURE
from grafu.metrics.collision import ConnectivityConfig
from grafu.simulation.config import CheckConfig
from grafu.templates import user
from grafu.templates.rails import TRAVEL

Sentence = tuple[str, str, tuple[float | int | str, ...]]
TOP, SOLID, BOX, CARCASS = TopConfig(), SolidBodyConfig(), DrawerBoxConfig(), CarcassConfig()
HANDLE, GRIP, GRASP, INTERIOR = HandleConfig(), GripConfig(), GraspConfig(), InteriorConfig()
BUILT, SEEN, MOVES = RealizationConfig(), FeatureConfig(), DynamicsConfig()
MASS, SHAPES = MassConfig(), CollisionShapeConfig()
FLOOR, STANDS, WALL, CHECK = FloorConfig(), StabilityConfig(), WallUnitConfig(), CheckConfig()
PHYSICS = PhysicsConfig()


def per_cent(ratio: float) -> float:
    """Returns a fraction in per cent, without the last digits of floats."""
    return round(100 * ratio, 6)


def mm(metres: float) -> float:
    """Returns metres in millimetres, without the last digits of floats."""
    return round(1000 * metres, 6)


def additions() -> Iterator[Sentence]:
    """Yields what docs/additions.md repeats."""
    page = "additions.md"
    yield page, "do not hide it (up to {} m)", (TOP.gallery,)
    yield page, "gives a missing one a probability of at least {}", (CARCASS.weighed,)
    yield page, "an inset top (up to {} m)", (TOP.recess,)
    yield page, "Openings under {} % of the footprint are sinks and gaps", (per_cent(TOP.openings.least),)
    yield page, "{} to {} m above the floor)", (TOP.supports.lowest, TOP.supports.highest)
    yield page, "they stand around {} % of the footprint", (per_cent(TOP.supports.footprint),)
    yield page, "open below {} % of their height", (per_cent(TOP.supports.open_below),)
    yield page, "A top counts as there from {} % on. Within {} % of that", (per_cent(TOP.coverage), per_cent(TOP.doubt))
    yield page, "(by more than {} % of the top's height)", (per_cent(TOP.apart),)
    yield page, "A kneehole of up to {} m between two pedestals", (TOP.outline.kneehole,)
    yield (
        page,
        "It is {} mm thick, ends {} mm before the fronts and {} mm beyond the sides",
        (
            mm(TOP.thickness),
            mm(TOP.front),
            mm(TOP.side),
        ),
    )
    yield page, "What begins {} to {} mm above the rim", (mm(TOP.outline.slot), mm(TOP.outline.high_slot))
    yield page, "over all that reaches to within {} % of the height below it", (per_cent(TOP_MEASURE.near),)
    yield page, "that plan lies more than {} % of the height below it", (per_cent(TOP_MEASURE.opened),)
    yield page, "where one new top lies over {} % of it", (per_cent(COVERED),)
    yield (
        page,
        "stay {} mm on each side for a rail (at most {} % of the front's width), {} mm below, "
        "{} mm above and {} mm behind",
        (
            mm(BOX.side_gap),
            per_cent(BOX.side_ratio),
            mm(BOX.under),
            mm(BOX.over),
            mm(BOX.behind),
        ),
    )
    yield (
        page,
        "at most {} mm from it and level to {} mm over {} % of it, with nothing more of the body within {} mm behind",
        (mm(SOLID.near), mm(SOLID.flat), per_cent(SOLID.faced), mm(SOLID.least_depth)),
    )
    yield page, "walls of {} mm are left around it (at most {} %", (mm(SOLID.wall), per_cent(SOLID.wall_ratio))
    yield page, "Walls are {} mm thick, the bottom {} mm.", (mm(BOX.wall), mm(BOX.bottom))
    yield page, "walls must stand on both sides over {} % of the depth", (per_cent(CARCASS.walled),)
    yield page, "a {} mm back is set", (mm(CARCASS.back),)
    yield page, "and a {} mm bottom between them", (mm(CARCASS.bottom),)
    yield (
        page,
        "Fingers need a gap of {} mm, reach in {} mm deep, pull at an edge of {} mm, and pinch what stands out {} mm.",
        (
            mm(GRASP.gap),
            mm(GRASP.reach),
            mm(GRASP.length),
            mm(GRASP.stub),
        ),
    )
    yield page, "opposite the hinge, {} mm from the free edge", (mm(HANDLE.inset),)
    yield page, "Doors from {} m height on: {} m above the floor", (HANDLE.tall, int(HANDLE.reach_height))
    yield page, "Up to {} m: at half height", (HANDLE.short,)
    yield (
        page,
        "fronts over {} m high in their upper part; drawers wider than {} m take two",
        (HANDLE.high, HANDLE.wide),
    )
    yield page, "In {} poses it must be clear", (HANDLE.poses,)
    yield (
        page,
        "a wall of {} mm behind it; at most {} % of the thickness is removed",
        (mm(GRIP.wall), per_cent(GRIP.depth_ratio)),
    )
    yield page, "keep {} mm from the others", (mm(GRIP.margin),)
    yield page, "shelves about {} m apart; dividers about {} m apart", (INTERIOR.shelf_pitch, INTERIOR.divider_pitch)
    yield page, "(behind doors, {} m high, {} m deep and wide)", (INTERIOR.hanging_height, INTERIOR.hanging_depth)
    yield page, "never more than {} of a kind", (INTERIOR.most_panels,)
    yield (
        page,
        "Panels are {} mm thick and stand {} mm behind the opening",
        (mm(INTERIOR.thickness), mm(INTERIOR.inset)),
    )
    yield page, "(within {} mm, over {} % of each half)", (mm(INTERIOR.touch), per_cent(INTERIOR.carried))
    yield page, "it is set back by up to {} % of the depth", (per_cent(INTERIOR.deepest_inset),)
    yield page, "its open bays are under {} % of the whole plan", (per_cent(TOP.openings.least),)
    yield page, "found by shape ({} to {} m deep", (TOP.evidence.shallowest_basin, TOP.evidence.deepest_basin)


def joints() -> Iterator[Sentence]:
    """Yields what docs/joints.md, templates.md and exports.md repeat."""
    page = "joints.md"
    yield page, "smaller by {} of the largest side on each side", (BUILT.depth,)
    pin, footing = BUILT.hinge.pin, BUILT.hinge.footing
    turns = (degrees(BUILT.closing.least_turn), degrees(BUILT.closing.widest_turn))
    yield page, "the least angle, of {:g} to {:g} degrees", turns
    yield page, "or lies at most {} mm behind it", (mm(BUILT.closing.behind),)
    yield page, "a face beside the door within {:g} barrel radii", (pin.widest_seam,)
    yield page, "a face behind the border within {:g} radii, at most {:g} wider", (pin.widest_seam, pin.widest_strip)
    yield page, "a face beside the door within {:g} mm", (1000 * BUILT.contact,)
    yield page, "both fronts flush within {:g} mm", (1000 * BUILT.flush,)
    yield page, "one plane of its part, within {:g} mm", (1000 * footing.resting,)
    yield page, "less than {} of a leaf rests, or with a block over {:g} mm", (footing.rests, 1000 * footing.thickest)
    yield page, "at most the template's and {} degrees", (round(degrees(BUILT.door_opening)),)
    hinge = BUILT.hinge
    yield page, "2 hinges up to {} m and one more per {} m", (hinge.two_up_to, hinge.one_more_per)
    yield page, "length {} of the body", (BUILT.rail_ratio,)
    yield page, "Travel: {} of the rail", (TRAVEL,)
    yield page, "up to {} where that much is stated", (BUILT.rail.most_of_rail,)
    yield page, "| {} % of the side |", (per_cent(BUILT.max_trim),)
    yield page, "shrunk on all sides | {} % of its volume |", (per_cent(BUILT.max_carve),)
    carved = (per_cent(BUILT.max_carve), per_cent(BUILT.max_carve_last))
    yield (
        page,
        "cut out of a static part | {} % of its surface or volume; {} % where no other step frees the path |",
        carved,
    )
    yield page, "in how many of {} poses", (ConnectivityConfig().poses,)
    yield "templates.md", "by more than {} % are refused", (per_cent(user._FIT),)
    yield "templates.md", "at most {:,} faces", (user._LIMITS.max_faces,)
    yield "templates.md", "within {} % of the protrusion before the foot plane", (per_cent(user._ON_PLANE),)
    yield (
        "exports.md",
        "Damping is inertia (or mass) over {} s; dry friction brakes a door by {:g} rad/s2, is {:g} % of a",
        (
            MOVES.settling,
            MOVES.hinge_braking,
            per_cent(MOVES.rail_friction),
        ),
    )
    yield "exports.md", "velocity is {:g} rad/s or {:g} m/s", (MOVES.hinge_velocity, MOVES.rail_velocity)
    yield "exports.md", "A pull of {:g} N at the far", (MOVES.pull,)
    yield "exports.md", "opens whatever is not lifted within {:g} s", (2 * MOVES.opened,)
    yield "exports.md", "friction takes no more than {:g} % of it", (per_cent(MOVES.braking_ratio),)
    yield "exports.md", "damped more, down to {:g} ms", (mm(MOVES.quickest),)
    yield from standing()
    yield from extension()
    yield "exports.md", "Nothing moves under less than {:g} N at its", (MOVES.touch,)
    yield (
        "exports.md",
        "| wood, and all that has no word | {:g} | {:g} mm:",
        (MASS.default_density, mm(MASS.solid_wood)),
    )
    yield (
        "exports.md",
        "boards up to {:g} mm and posts up to {:g} mm",
        (mm(2 * MASS.solid_wood), mm(4 * MASS.solid_wood)),
    )
    yield "exports.md", "are solid | {:g} mm |", (mm(MASS.board_thickness),)
    yield "exports.md", "| handles without a word | {:g} | {:g} mm |", (MASS.handle_density, mm(MASS.handle_wall))
    yield "exports.md", "| hinges and rails | {:g} | {:g} mm:", (MASS.hardware_density, mm(MASS.hardware_wall))
    yield "exports.md", "is cut up to {} times beside that", (SHAPES.pieces.most_cuts,)
    yield "exports.md", "handles, legs and bars up to {} times", (SHAPES.cuts_of_bars,)
    yield "exports.md", "at least {:g} mm thick", (mm(SHAPES.least_thickness),)
    yield "exports.md", "in any of {} poses of a motion", (ShapeClearanceConfig().poses,)
    yield "exports.md", "A link has at most {}:", (SHAPES.most_shapes,)
    yield "exports.md", "a pull of {:g} N at its far", (MOVES.counterbalance.pull,)
    yield "exports.md", "an armature of {:g} % of what moves", (per_cent(UsdConfig().armature),)
    draco = DracoConfig()
    yield "exports.md", "a grid of {:g} mm, so by at most {:g} mm along", (mm(draco.step), mm(draco.step) / 2)
    yield "exports.md", "Normals have {} bits", (draco.normal_bits,)
    yield "exports.md", "steps of 1/{:g}; triangles", (1 / draco.uv_step,)
    catch = MOVES.catch
    yield "exports.md", "| {:g} N | within {:g} mm of closed", (catch.force, mm(catch.detent))
    yield "exports.md", "| {:g} N | a drawer within {:g} mm of closed", (catch.force, mm(catch.rail))
    yield "exports.md", "a door within {:g} mm", (mm(catch.hinge),)
    yield "exports.md", "falls to nothing over the last {:g} % of that way", (per_cent(catch.fade),)
    yield "exports.md", "at most {:g} % of the joint's range", (per_cent(catch.most),)
    yield "exports.md", "a pull of {:g} N at the grip still opens", (MOVES.pull,)
    yield "exports.md", "take no more than {:g} % of it", (per_cent(catch.ease),)


def standing() -> Iterator[Sentence]:
    """Yields what docs/exports.md repeats of how a piece stands, and of how results are checked."""
    page = "exports.md"
    yield page, "Collision shapes of moving links stand {:g} mm off", (mm(FLOOR.gap),)
    yield (
        page,
        "does not bear {:g} N at each door and {:g} N at each drawer",
        (STANDS.turning_pull, STANDS.sliding_pull),
    )
    yield (
        page,
        "at most {:g} m tall, or the input has it between {:g} m and {:g} m",
        (
            WALL.tallest,
            WALL.lowest,
            WALL.highest,
        ),
    )
    yield page, "at least {:g} mm behind all that ends within {:g} mm", (mm(WALL.behind), mm(WALL.feet))
    feet, rolling = PHYSICS.feet, PHYSICS.rolling
    yield page, "end up to {:g} mm above it reach down", (mm(feet.short),)
    yield page, "of those that end up to\n{:g} mm above it do", (mm(feet.hanging),)
    yield page, "a flat of {:g} mm below", (mm(rolling.flat),)
    yield page, "swivelling, by {:g} % of what", (per_cent(rolling.resistance),)
    yield page, "at most {:g} N (doors) or {:g} N (drawers)", (CHECK.turning_pull, CHECK.sliding_pull)
    yield page, "no faster than {:g} m/s, then pushes it", (CHECK.hand_speed,)
    yield page, "opens to {:g} % of its range, closes below {:g} %", (per_cent(CHECK.opened), per_cent(CHECK.closed))
    yield page, "no other joint moves by {:g} %", (per_cent(CHECK.closed),)
    yield page, "must carry a {:g} cm cube", (100 * CHECK.cube,)


def extension() -> Iterator[Sentence]:
    """Yields what docs/blender.md repeats of how the extension is built."""
    yield "blender.md", "without OpenUSD is larger than {:g} MB", (LARGEST / 1e6,)
