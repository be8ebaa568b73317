"""Made URDFs whose joints hang on moving links: a folding door of two leaves, and a drawer in a door."""

from pathlib import Path

Box = tuple[float, float, float, float, float, float]
"""Low corner, then high corner, metres; front -Y, Z up."""

_CARCASS: dict[str, Box] = {
    "side_left": (-0.42, -0.2, 0.0, -0.4, 0.2, 0.8),
    "side_right": (0.4, -0.2, 0.0, 0.42, 0.2, 0.8),
    "back_panel": (-0.4, 0.18, 0.0, 0.4, 0.2, 0.8),
    "bottom_panel": (-0.4, -0.2, 0.0, 0.4, 0.18, 0.02),
    "top_panel": (-0.42, -0.2, 0.8, 0.42, 0.2, 0.82),
}
LEAVES: dict[str, Box] = {
    "door_leaf_1": (-0.415, -0.22, 0.03, -0.001, -0.201, 0.79),
    "door_leaf_2": (0.001, -0.22, 0.03, 0.415, -0.201, 0.79),
}


def _visuals(boxes: dict[str, Box], origin: tuple[float, float, float]) -> str:
    found = []
    for name, bounds in boxes.items():
        low, high = bounds[:3], bounds[3:]
        middle = [(a + b) / 2 - o for a, b, o in zip(low, high, origin, strict=True)]
        size = [b - a for a, b in zip(low, high, strict=True)]
        words = [" ".join(f"{v:.6g}" for v in values) for values in (middle, size)]
        found.append(
            f'<visual name="{name}"><origin xyz="{words[0]}"/><geometry><box size="{words[1]}"/></geometry></visual>'
        )
    return "".join(found)


def _link(name: str, boxes: dict[str, Box], origin: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> str:
    return f'<link name="{name}">{_visuals(boxes, origin)}</link>'


def _joint(
    name: str,
    kind: str,
    parent: str,
    child: str,
    xyz: tuple[float, ...],
    axis: str,
    limits: tuple[float, float],
    more="",
) -> str:
    at = " ".join(f"{v:.6g}" for v in xyz)
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/><origin xyz="{at}"/>'
        f'<axis xyz="{axis}"/><limit lower="{limits[0]}" upper="{limits[1]}" effort="1" velocity="1"/>{more}</joint>'
    )


def _written(folder: Path, name: str, *elements: str) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{name}.urdf"
    path.write_text(f'<robot name="{name}">{"".join(elements)}</robot>')
    return path


def folding_door(folder: Path, mimic: str = '<mimic joint="leaf_1_joint" multiplier="-2"/>') -> Path:
    """A cabinet whose two leaves cover it: leaf 1 hangs on the left side, leaf 2 on leaf 1, and folds inwards."""
    pin_1, pin_2 = (-0.415, -0.22, 0.0), (0.0, -0.201, 0.0)
    return _written(
        folder,
        "folding_door",
        _link("base", _CARCASS),
        _link("leaf_1", {"door_leaf_1": LEAVES["door_leaf_1"]}, pin_1),
        _link("leaf_2", {"door_leaf_2": LEAVES["door_leaf_2"]}, pin_2),
        _joint("leaf_1_joint", "revolute", "base", "leaf_1", pin_1, "0 0 -1", (0.0, 1.4)),
        _joint(
            "leaf_2_joint",
            "revolute",
            "leaf_1",
            "leaf_2",
            tuple(b - a for a, b in zip(pin_1, pin_2, strict=True)),
            "0 0 -1",
            (-2.8, 0.0),
            mimic,
        ),
    )


def _door_and_drawer(
    folder: Path,
    name: str,
    door: dict[str, Box],
    drawer: dict[str, Box],
    front: tuple[float, float, float],
    axis: str,
    opening: float,
) -> Path:
    """A cabinet whose door hangs on its left side, and a drawer on that door: frame at `front`, `opening` in metres."""
    pin = (-0.415, -0.22, 0.0)
    from_pin = tuple(b - a for a, b in zip(pin, front, strict=True))
    return _written(
        folder,
        name,
        _link("base", _CARCASS),
        _link("door", door, pin),
        _link("drawer", drawer, front),
        _joint("door_joint", "revolute", "base", "door", pin, "0 0 -1", (0.0, 1.5)),
        _joint("drawer_joint", "prismatic", "door", "drawer", from_pin, axis, (0.0, opening)),
    )


DOOR_DRAWER: dict[str, Box] = {
    "drawer_front": (-0.28, -0.22, 0.26, 0.28, -0.201, 0.54),
    "drawer_wall_left": (-0.26, -0.201, 0.28, -0.25, 0.05, 0.5),
    "drawer_wall_right": (0.25, -0.201, 0.28, 0.26, 0.05, 0.5),
    "drawer_wall_back": (-0.25, 0.04, 0.28, 0.25, 0.05, 0.5),
    "drawer_floor": (-0.25, -0.201, 0.28, 0.25, 0.04, 0.29),
}
DOOR_FRAME: dict[str, Box] = {
    "door_low": (-0.415, -0.22, 0.03, 0.415, -0.201, 0.25),
    "door_high": (-0.415, -0.22, 0.55, 0.415, -0.201, 0.79),
    "door_left": (-0.415, -0.22, 0.25, -0.29, -0.201, 0.55),
    "door_right": (0.29, -0.22, 0.25, 0.415, -0.201, 0.55),
    "door_cheek_left": (-0.3, -0.201, 0.27, -0.28, 0.06, 0.52),
    "door_cheek_right": (0.28, -0.201, 0.27, 0.3, 0.06, 0.52),
}


def drawer_in_door(folder: Path) -> Path:
    """A cabinet with one door, through which a drawer is pulled out that runs between two cheeks on the door."""
    return _door_and_drawer(folder, "drawer_in_door", DOOR_FRAME, DOOR_DRAWER, (0.0, -0.22, 0.4), "0 -1 0", 0.2)


INNER_DRAWER: dict[str, Box] = {
    "drawer_front": (-0.28, 0.03, 0.26, 0.28, 0.05, 0.54),
    "drawer_wall_left": (-0.26, -0.195, 0.28, -0.25, 0.03, 0.5),
    "drawer_wall_right": (0.25, -0.195, 0.28, 0.26, 0.03, 0.5),
    "drawer_wall_back": (-0.25, -0.195, 0.28, 0.25, -0.185, 0.5),
    "drawer_floor": (-0.25, -0.185, 0.28, 0.25, 0.03, 0.29),
}
PLAIN_DOOR: dict[str, Box] = {
    "door_panel": (-0.415, -0.22, 0.03, 0.415, -0.201, 0.79),
    "door_cheek_left": (-0.3, -0.201, 0.27, -0.28, 0.025, 0.52),
    "door_cheek_right": (0.28, -0.201, 0.27, 0.3, 0.025, 0.52),
}


def drawer_behind_door(folder: Path) -> Path:
    """A cabinet with one door; a drawer on its inner side slides inwards, which the cabinet's back stops."""
    return _door_and_drawer(folder, "drawer_behind_door", PLAIN_DOOR, INNER_DRAWER, (0.0, 0.05, 0.4), "0 1 0", 0.19)
