"""A user's own hinge is what is built, where it fits."""

import json
from pathlib import Path

from grafu.cli.main import main
from grafu.templates.gallery import builtin_gallery

SAMPLE = Path(__file__).parents[2] / "samples" / "wardrobe.glb"


def own_hinge(folder: Path) -> None:
    """Writes the built-in butt hinge as if a user had drawn it, in metres."""
    model = next(hinge for hinge in builtin_gallery().hinges if hinge.id == "butt")
    template = model.build(model.natural)
    folder.mkdir(parents=True)
    for end in ("static", "dynamic"):
        getattr(template, end).mesh.to_trimesh().export(folder / f"{end}.obj")
    size = model.natural
    middle = -size.leaf / 2
    snaps = {
        f"{end}_snap": {
            "center": [side * size.thickness, middle, 0],
            "normal": [side, 0, 0],
            "u": [0, size.leaf / 2, 0],
            "v": [0, 0, size.length / 2],
        }
        for end, side in (("static", -1), ("dynamic", 1))
    }
    axis = {"point": [0, 0, 0], "direction": [0, 0, 1]}
    sizes = {"length": size.length, "leaf": size.leaf, "thickness": size.thickness, "radius": size.radius}
    annotation = {"kind": "hinge", "class": "C", "axis": axis, "opening": [0, 1, 0], "range_deg": 110, **snaps, **sizes}
    (folder / "template.json").write_text(json.dumps(annotation))


def test_doors_hang_on_the_users_own_hinges(tmp_path):
    own_hinge(tmp_path / "mine" / "art_deco")
    arguments = ["functionalize", str(SAMPLE), "--out", str(tmp_path / "out"), "--formats", "urdf"]

    assert main([*arguments, "--templates", str(tmp_path / "mine")]) == 0

    report = json.loads((tmp_path / "out" / "wardrobe" / "report.json").read_text())
    used = {joint["template"] for joint in report["joints"] if joint["type"] == "revolute"}
    assert used == {"art_deco"}


def test_a_hinge_that_there_is_not_is_refused_before_anything_is_read(tmp_path, capsys):
    code = main(["functionalize", str(tmp_path / "none.glb"), "--hinge", "spring", "--out", str(tmp_path / "out")])

    assert code == 2
    assert "the preferred hinge must be one of butt" in capsys.readouterr().err
