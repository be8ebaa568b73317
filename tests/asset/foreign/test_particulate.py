"""Particulate's files, written exactly as its evaluation writes them: what is read, and what is refused."""

import io
import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.asset.foreign.attach import attach_motions
from grafu.asset.foreign.frames import quarter_turns
from grafu.asset.foreign.particulate import UP_ROTATIONS, normalisation, read_particulate
from grafu.asset.part import AnnotatedJoint
from grafu.errors import AssetError, AssetTooLarge, ExportError, UnreadableAsset
from grafu.export.files import write_files
from grafu.export.particulate import ParticulateConfig, export_particulate
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.transform import transform_points
from grafu.pipeline.foreign import read_foreign
from grafu.synth.truth.clashes import articulated_of
from grafu.vocabulary import JointType, PartLabel
from predictions import cabinet, require_same_joints, way
from sketches import Sketched, board, drawer, sketch

CABINET = cabinet()
OBJECT = articulated_of(CABINET)
TURNS = list(quarter_turns())
Arrays = dict[str, np.ndarray]


def arrays_in(folder: Path) -> Arrays:
    with np.load(folder / "eval" / "pred.npz") as stored:
        return dict(stored)


def write_arrays(folder: Path, arrays: Arrays) -> None:
    stored = io.BytesIO()
    np.savez(stored, **arrays)  # type: ignore[arg-type]
    (folder / "eval" / "pred.npz").write_bytes(stored.getvalue())


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    write_files(export_particulate(OBJECT), tmp_path / "run")
    return tmp_path / "run"


@pytest.mark.parametrize("up", UP_ROTATIONS)
@pytest.mark.parametrize(
    "T", [way(TURNS[0]), way(TURNS[1], 10.0, (3.0, -2.0, 1.0)), way(TURNS[11], 0.02), way(TURNS[20], 100.0)]
)
def test_joints_come_back_whatever_up_was_stated(up: str, T: np.ndarray, tmp_path: Path) -> None:
    write_files(export_particulate(OBJECT, ParticulateConfig(up, T)), tmp_path / "run")  # type: ignore[arg-type]
    found = attach_motions(CABINET, read_particulate(tmp_path / "run" / "eval" / "pred.npz"))

    require_same_joints(found, CABINET)
    assert any(f"joints in its normalised frame of up_dir {up};" in note for note in found.notes)
    assert {part.id: part.carried_by for part in found.parts} == {part.id: part.carried_by for part in CABINET.parts}


@given(st.sampled_from(sorted(UP_ROTATIONS)), st.floats(0.01, 100), st.floats(-9, 9))
def test_the_normalised_frame_is_centred_and_of_size_one(up: str, size: float, offset: float) -> None:
    box = Box(vec3(offset, 1.0, -2.0), vec3(offset + size, 1.5, 3.0))
    there = Box.around(transform_points(normalisation(box, up), box.corners()))

    np.testing.assert_allclose(there.center, 0.0, atol=1e-9)
    assert there.size.max() == pytest.approx(1.0)
    axis = {"X": 0, "Y": 1, "Z": 2}[up[-1]]
    step = np.zeros(3)
    step[axis] = -1.0 if up[0] == "-" else 1.0
    mapped = normalisation(box, up)[:3, :3] @ step
    np.testing.assert_allclose(mapped / np.linalg.norm(mapped), [0.0, 0.0, 1.0], atol=1e-12)  # what was up is Z


def test_the_format_is_what_particulate_writes(folder: Path) -> None:
    arrays = arrays_in(folder)
    lines = (folder / "eval" / "pred.obj").read_text().splitlines()
    faces = [line for line in lines if line.startswith("f ")]

    assert arrays["face_part_ids"].shape == (len(faces),)
    assert set(arrays["face_part_ids"].tolist()) == {0, 1, 2, 3}
    assert arrays["motion_hierarchy"].tolist() == [[0, 1], [0, 2], [0, 3]]
    assert arrays["is_part_revolute"].tolist() == [False, True, True, False]
    assert arrays["is_part_prismatic"].tolist() == [False, False, False, True]
    line, moment = np.split(arrays["revolute_plucker"][1].astype(float), 2)
    T = normalisation(CABINET.box, "Z")
    point = transform_points(T, CABINET.joints[0].axis.point[None])[0]
    np.testing.assert_allclose(moment, np.cross(line, point), atol=1e-6)  # l x p, not p x l
    longest = CABINET.joints[2].upper / CABINET.extent
    np.testing.assert_allclose(arrays["prismatic_range"][3], [0.0, longest], rtol=1e-6)


def test_faces_may_come_in_any_order(folder: Path) -> None:
    arrays = arrays_in(folder)
    obj = folder / "eval" / "pred.obj"
    lines = obj.read_text().splitlines()
    faces = [line for line in lines if line.startswith("f ")]
    order = np.random.default_rng(3).permutation(len(faces))
    obj.write_text("\n".join([line for line in lines if line not in faces] + [faces[k] for k in order]))
    write_arrays(folder, arrays | {"face_part_ids": arrays["face_part_ids"][order]})

    require_same_joints(attach_motions(CABINET, read_foreign(folder)), CABINET)


def test_groups_and_materials_do_not_disturb_the_order_of_faces(folder: Path) -> None:
    obj = folder / "eval" / "pred.obj"
    count = [0]

    def named(match: re.Match[str]) -> str:
        count[0] += 1
        return f"g piece{count[0] % 3}\nusemtl m{count[0] % 2}\n{match[0]}"

    obj.write_text(re.sub(r"^f ", named, obj.read_text(), flags=re.MULTILINE))

    require_same_joints(attach_motions(CABINET, read_foreign(folder)), CABINET)


def test_a_range_below_zero_keeps_its_sign(folder: Path) -> None:
    arrays = arrays_in(folder)
    arrays["revolute_plucker"] *= -1
    arrays["revolute_range"] = -arrays["revolute_range"][:, ::-1]
    arrays["prismatic_axis"] *= -1
    arrays["prismatic_range"] = -arrays["prismatic_range"][:, ::-1]
    write_arrays(folder, arrays)

    require_same_joints(attach_motions(CABINET, read_foreign(folder)), CABINET, sense=-1.0)


def test_a_part_that_turns_and_slides_turns(folder: Path) -> None:
    arrays = arrays_in(folder)
    arrays["is_part_prismatic"][:] = True
    arrays["is_part_prismatic"][0] = False
    arrays["prismatic_axis"][:] = [0.0, 1.0, 0.0]
    write_arrays(folder, arrays)
    read = read_foreign(folder)

    assert [joint.type for joint in read.joints] == [JointType.REVOLUTE, JointType.REVOLUTE, JointType.PRISMATIC]
    assert "part_1 is predicted to turn and to slide: only the turn is read" in read.notes


def test_an_axis_without_a_direction_moves_nothing(folder: Path) -> None:
    arrays = arrays_in(folder)
    arrays["revolute_plucker"][1] = 0.0
    write_arrays(folder, arrays)
    read = read_foreign(folder)

    assert [joint.part for joint in read.joints] == ["part_2", "part_3"]
    assert any("part_1" in note and "left still" in note for note in read.notes)


def test_an_object_that_cannot_move_is_read(folder: Path) -> None:
    arrays = arrays_in(folder)
    arrays["is_part_revolute"][:] = arrays["is_part_prismatic"][:] = False
    arrays["motion_hierarchy"] = np.zeros(0)
    write_arrays(folder, arrays)

    assert attach_motions(CABINET, read_foreign(folder)).joints == ()


def dropped(key: str) -> Callable[[Arrays], Arrays]:
    return lambda arrays: {name: array for name, array in arrays.items() if name != key}


def changed(key: str, change: Callable[[np.ndarray], np.ndarray]) -> Callable[[Arrays], Arrays]:
    return lambda arrays: arrays | {key: change(arrays[key])}


@pytest.mark.parametrize(
    ("damage", "why"),
    [
        (dropped("revolute_range"), r"lacks `revolute_range`: expected Particulate's eval/pred.npz"),
        (
            changed("revolute_plucker", lambda a: a[:, :3]),
            r"`revolute_plucker` has the shape \(4, 3\): expected \(n, 6\)",
        ),
        (changed("face_part_ids", lambda a: a[:-1]), r"names the parts of \d+ faces, pred.obj has \d+"),
        (changed("face_part_ids", lambda a: a + 9), r"`face_part_ids` names parts 9..12: there are 0..3"),
        (changed("motion_hierarchy", lambda a: a - 1), r"`motion_hierarchy` names parts -1"),
        (changed("revolute_range", lambda a: a * np.nan), r"`revolute_range` holds numbers that are not finite"),
        (changed("is_part_prismatic", lambda a: a[:2]), r"`is_part_prismatic` has 2 rows: expected one for each of 4"),
        (changed("prismatic_axis", lambda a: a.astype("U4")), r"`prismatic_axis` holds no numbers"),
        (changed("motion_hierarchy", lambda a: np.array([[1, 2], [2, 1]])), r"must form a tree"),
    ],
)
def test_damaged_arrays_are_refused_in_one_line(damage: Callable[[Arrays], Arrays], why: str, folder: Path) -> None:
    write_arrays(folder, damage(arrays_in(folder)))
    with pytest.raises(UnreadableAsset, match=why) as error:
        read_foreign(folder)
    assert "\n" not in str(error.value)


def test_missing_and_foreign_files_are_refused_in_one_line(folder: Path) -> None:
    obj = folder / "eval" / "pred.obj"
    whole = obj.read_bytes()
    obj.write_text(re.sub(r"f (\d+) (\d+) (\d+)", r"f \1 \2 \3 \1", whole.decode()))
    with pytest.raises(UnreadableAsset, match="faces of more than three corners: triangulate it"):
        read_foreign(folder)
    obj.write_text("v 0 0 0\n")
    with pytest.raises(UnreadableAsset, match="holds no faces"):
        read_foreign(folder)
    obj.unlink()
    with pytest.raises(UnreadableAsset, match=r"pred.obj is missing: expected Particulate's"):
        read_foreign(folder)
    (folder / "eval" / "pred.npz").write_text("no archive")
    with pytest.raises(UnreadableAsset, match="expected a NumPy archive of plain arrays"):
        read_foreign(folder)
    np.savez(folder / "eval" / "pred.npz", face_part_ids=np.array([{}]))  # what only pickle can say is not loaded
    with pytest.raises(UnreadableAsset, match="expected a NumPy archive of plain arrays"):
        read_foreign(folder)


def with_rows(arrays: Arrays, count: int) -> Arrays:
    names = [key for key in arrays if key not in ("face_part_ids", "motion_hierarchy")]
    return arrays | {key: np.repeat(arrays[key][:1], count, axis=0) for key in names}


def test_more_parts_than_are_read_are_refused(folder: Path) -> None:
    write_arrays(folder, with_rows(arrays_in(folder), 5_001))
    with pytest.raises(AssetTooLarge, match="5,001 parts: at most 5,000 are read"):
        read_foreign(folder)


def test_each_of_thousands_of_parts_gets_its_own_faces_and_parent(folder: Path) -> None:
    count = 4_000
    corners = np.arange(3 * count).reshape(-1, 3) + 1
    lines = [f"v {k % 3} {k // 3} {k % 2}" for k in range(3 * count)]
    lines += [f"f {a} {b} {c}" for a, b, c in corners]
    (folder / "eval" / "pred.obj").write_text("\n".join(lines))
    chain = np.stack([np.arange(count - 1), np.arange(1, count)], axis=1)
    of_face = np.arange(count)[::-1]  # the last part has the first face
    write_arrays(folder, with_rows(arrays_in(folder), count) | {"face_part_ids": of_face, "motion_hierarchy": chain})

    read = read_foreign(folder)
    assert [part.parent for part in read.parts] == [None, *(f"part_{k}" for k in range(count - 1))]
    np.testing.assert_array_equal([part.mesh.vertices[0, 1] for part in read.parts], of_face)


@pytest.mark.parametrize(("place", "value"), [(6, 1), (8, 99)], ids=["encrypted", "unknown compression"])
def test_archives_that_cannot_be_unpacked_are_refused_in_one_line(place: int, value: int, folder: Path) -> None:
    path = folder / "eval" / "pred.npz"
    archive = bytearray(path.read_bytes())
    for header, shift in ((b"PK\x03\x04", 0), (b"PK\x01\x02", 2)):  # each file's header, and its line in the directory
        start = archive.find(header)
        while start >= 0:
            archive[start + place + shift] = value
            start = archive.find(header, start + 4)
    path.write_bytes(bytes(archive))

    with pytest.raises(UnreadableAsset, match="expected a NumPy archive of plain arrays"):
        read_foreign(folder)


@given(st.floats(0, 1), st.integers(0, 200), st.binary(max_size=20))
def test_damage_anywhere_is_read_or_refused_in_one_line(
    tmp_path_factory: pytest.TempPathFactory, place: float, cut: int, inserted: bytes
) -> None:
    folder = tmp_path_factory.mktemp("damaged")
    files = export_particulate(OBJECT)
    for name in files.names:
        (folder / Path(name).name).write_bytes(files[name])
    data = files["eval/pred.npz"]
    at = int(place * len(data))
    (folder / "pred.npz").write_bytes(data[:at] + inserted + data[at + cut :])
    said = ""
    try:
        read_foreign(folder)
    except AssetError as error:
        said = str(error)
    assert "\n" not in said


def test_a_mirror_image_cannot_be_written() -> None:
    with pytest.raises(ExportError, match="no mirror image"):
        ParticulateConfig("Z", np.diag([-1.0, 1.0, 1.0, 1.0]))


@pytest.mark.parametrize("up", UP_ROTATIONS)
def test_drawers_may_come_out_on_both_sides(up: str, tmp_path: Path) -> None:
    before, behind = (
        drawer("before", (-0.46, -0.4, 0.1), (0.46, -0.02, 0.9)),
        drawer("behind", (-0.46, 0.02, 0.1), (0.46, 0.4, 0.9)),
    )
    out = AnnotatedJoint("behind", JointType.PRISMATIC, Axis(vec3(0.0, 0.4, 0.5), vec3(0.0, 1.0, 0.0)), 0.0, 0.3)
    desk = sketch(
        board("left", PartLabel.SIDE_PANEL, (-0.5, -0.4, 0.0), (-0.47, 0.4, 1.0)),
        board("right", PartLabel.SIDE_PANEL, (0.47, -0.4, 0.0), (0.5, 0.4, 1.0)),
        board("top", PartLabel.TOP_PANEL, (-0.5, -0.42, 1.0), (0.5, 0.42, 1.02)),
        before,
        Sketched(behind.part, out),
    )
    write_files(export_particulate(articulated_of(desk), ParticulateConfig(up)), tmp_path / "run")  # type: ignore[arg-type]

    require_same_joints(attach_motions(desk, read_foreign(tmp_path / "run")), desk)
