"""Names of result folders: each can be a folder on every system, stays inside, and differs from all others."""

import os
import re
from pathlib import Path, PureWindowsPath

import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.errors import AssetError
from grafu.export.output_names import (
    MOST_BYTES,
    InputPlaces,
    file_safe,
    output_name,
    same_place,
    told_apart,
    why_not_apart,
)
from grafu.export.whole_file import hidden_name
from grafu.visible import visible

NAMES = st.one_of(
    st.text(st.characters(exclude_characters="/\0", exclude_categories=("Cs",)), min_size=1, max_size=300),
    st.binary(min_size=1, max_size=300).map(lambda held: os.fsdecode(held.translate(None, b"/\0"))),
)


@pytest.mark.parametrize(
    "file",
    [
        *("con.glb", "NUL.glb", "Aux.v2.glb", "prn .x.glb", "COM1.glb", "lpt9.glb", "com¹.glb", "CONOUT$.glb"),
        *("a .glb", "a..glb", "a:b.glb", "a?.glb", "a*.glb", 'a".glb', "a<b>.glb", "a|b.glb", "a\\b.glb"),
        *("a\nb.glb", "a\x7f.glb", "a\x9b.glb", ".grafu.json.glb", ".GRAFU.JSON.glb"),
    ],
)
def test_names_that_some_system_cannot_hold_are_refused(file: str) -> None:
    with pytest.raises(AssetError, match="rename the input") as refusal:
        output_name(Path("models") / file)
    assert visible(str(refusal.value)) == str(refusal.value)
    assert visible(file) in str(refusal.value)


def test_what_leads_out_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    for stem in ("", ".", ".."):
        monkeypatch.setattr(Path, "stem", stem)  # of `...glb`, as some versions of Python read it
        with pytest.raises(AssetError, match="no folder of its own"):
            output_name(Path("model.glb"))


def test_a_name_that_a_run_would_clear_away_is_refused(tmp_path: Path) -> None:
    with pytest.raises(AssetError, match="keeps for itself"):
        output_name(hidden_name(tmp_path / "cabinet", "old").with_name("x.glb").with_stem(
            hidden_name(tmp_path / "cabinet", "old").name
        ))  # fmt: skip


@pytest.mark.parametrize(
    "name", ["cabinet", "Schränkchen", "扉", "a.b", ".hidden", "console", "com10", "nulls", "a b", "~", "lpt"]
)
def test_usual_names_stay(name: str) -> None:
    assert output_name(Path(f"{name}.glb")) == name


def test_a_folder_is_called_as_it_is(tmp_path: Path) -> None:
    (tmp_path / "v1.5").mkdir()

    assert output_name(tmp_path / "v1.5") == "v1.5"
    assert output_name(tmp_path / "v1.5" / ".") == "v1.5"


@given(NAMES)
def test_every_name_is_a_folder_of_its_own_or_refused(name: str) -> None:
    try:
        made = output_name(Path(f"models/{name}.glb"))
    except AssetError:
        return
    assert made not in ("", ".", "..")
    assert len(made.encode("utf-8")) <= MOST_BYTES
    assert not set(made) & set('<>:"/\\|?*')
    assert made[-1] not in ". "
    assert made.isprintable() or all(ord(one) > 0x9F for one in made if not one.isprintable())
    assert Path(os.path.normpath(Path("out") / made)).parent == Path("out")
    assert not PureWindowsPath(made).is_reserved()
    assert len(hidden_name(Path(made), "new").name.encode()) <= 255


@given(st.text(min_size=121, max_size=200, alphabet="aäが🚪"), st.text(alphabet="aäが🚪", max_size=9))
def test_long_names_are_cut_between_characters_and_stay_apart(name: str, more: str) -> None:
    first, second = output_name(Path(f"{name}x.glb")), output_name(Path(f"{name}y{more}.glb"))

    assert name.startswith(first.rpartition("~")[0])
    assert len(first.encode()) > MOST_BYTES - 4
    assert same_place(first) != same_place(second)


def test_names_that_are_no_unicode_stay_apart() -> None:
    first, second = (output_name(Path(os.fsdecode(b"caf" + end + b".glb"))) for end in (b"\xe9", b"\xe8"))

    assert first != second
    assert first.startswith("caf_~")


def test_one_place_on_some_disk_is_one_place() -> None:
    assert same_place("Cafe\u0301") == same_place("CAF\u00c9")


@pytest.fixture
def models(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "models" / "cab" / "meshes").mkdir(parents=True)
    (tmp_path / "models" / "cab" / "cab.urdf").write_text("<robot/>")
    monkeypatch.chdir(tmp_path)
    return tmp_path / "models"


@pytest.mark.parametrize("given", ["models/cab", "models/cab/cab.urdf", "models/cab/meshes", "models/../models/cab"])
@pytest.mark.parametrize("result", ["models/cab", "models", ".", "models/cab/meshes/.."])
def test_an_input_inside_is_found(models: Path, given: str, result: str) -> None:
    assert "choose another --out" in why_not_apart(Path(result), [Path(given)])
    assert "choose another --out" in why_not_apart(Path(result).absolute(), [Path("gone.glb"), Path(given)])


@pytest.mark.parametrize("result", ["models/cab/out", "models/cab/meshes", "models/other", "out/cab", "models/cabin"])
def test_results_beside_and_below_are_apart(models: Path, result: str) -> None:
    (models.parent / "models/cabin").mkdir()

    assert why_not_apart(Path(result), [Path("models/cab"), Path("models/cab/cab.urdf")]) == ""


def test_links_are_followed_both_ways(models: Path) -> None:
    os.symlink(models, "link")
    os.symlink(models / "cab" / "cab.urdf", "by_link.urdf")
    (models / "out").mkdir()
    os.symlink(models.parent / "elsewhere.glb", models / "out" / "in.glb")
    Path("elsewhere.glb").write_bytes(b"")

    assert why_not_apart(Path("link/cab"), [Path("models/cab")])
    assert why_not_apart(Path("models/cab"), [Path("link/cab/cab.urdf")])
    assert why_not_apart(Path("models/cab"), [Path("by_link.urdf")])
    assert why_not_apart(Path("models/out"), [Path("models/out/in.glb")])  # the link would go
    assert not why_not_apart(Path("models/out"), [Path("elsewhere.glb")])


def test_places_are_compared_as_the_disk_knows_them(models: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    real = os.stat

    def folding(path: Path) -> os.stat_result:
        return real(str(path).replace("MODELS/CAB", "models/cab"))

    monkeypatch.setattr(os, "stat", folding)  # a disk on which case does not count

    assert why_not_apart(Path("MODELS/CAB"), [Path("models/cab/cab.urdf")])


def test_each_input_is_looked_at_once_however_many_results_there_are(
    models: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    looked: list[Path] = []
    real = os.stat
    monkeypatch.setattr(os, "stat", lambda path: looked.append(path) or real(path))
    places = InputPlaces([Path(f"models/{k}.glb") for k in range(100)])
    assert 100 <= len(looked) <= 3 * 100

    looked.clear()
    assert [places.why_not_apart(Path(f"out/{k}")) for k in range(100)] == [""] * 100
    assert len(looked) == 100


@pytest.mark.parametrize("name", ["CON", "aux", "nul", "Com1", "lpt9", "prn.x", ".con", "-aux", "aux.2", "con."])
def test_a_file_within_results_is_never_called_as_a_device(name: str) -> None:
    assert file_safe(name).startswith("_")
    assert file_safe(name).lower().endswith(name.lower().lstrip(".-"))


@given(NAMES)
def test_every_name_of_a_file_within_results_is_one_on_every_system(name: str) -> None:
    stem = file_safe(name)
    assert re.fullmatch(r"[A-Za-z0-9_][A-Za-z0-9_.-]*(~[0-9a-f]{8})?", stem)
    assert len(stem.encode()) <= MOST_BYTES
    assert not PureWindowsPath(f"{stem}.obj").is_reserved()
    assert file_safe(stem) == stem or "~" in stem


def test_long_names_within_results_stay_apart() -> None:
    assert file_safe("x" * 300 + "a") != file_safe("x" * 300 + "b")
    assert file_safe("console") == "console"


@pytest.mark.parametrize(
    ("path", "name"),
    [
        ("45526/mobility.urdf", "45526"),
        ("chair/Model.GLB", "chair"),
        ("v1.5/scene.gltf", "v1.5"),
        ("a/robot.xml", "a"),
        ("a/model_2.glb", "model_2"),
        ("con/object.obj", "object"),  # Windows has no folder of this name
        ("/scene.glb", "scene"),
    ],
)
def test_a_file_whose_name_is_generic_is_named_by_its_folder(path: str, name: str) -> None:
    assert output_name(Path(path)) == name


@pytest.mark.parametrize(
    ("paths", "names"),
    [
        (["d1/model.glb", "d2/model.glb", "e/other.glb"], ("d1", "d2", "other")),
        (["x/d/model.glb", "y/d/model.glb"], ("x", "y")),  # their folders are called alike, too
        (["x/d/model.glb", "x/d/scene.glb"], ("model", "scene")),  # one folder holds both
        (["x/d/model.glb", "x/d/model.obj"], ("d", "d")),
        (["x/cabinet.glb", "y/cabinet.glb"], ("x", "y")),
        (["x/d/cabinet.glb", "y/d/cabinet.glb"], ("x_d_cabinet", "y_d_cabinet")),
        (["x/1/cabinet.glb", "x/2/cabinet.glb", "y/1/cabinet.glb"], ("x_1_cabinet", "x_2_cabinet", "y_1_cabinet")),
        (["/x/d/cabinet.glb", "/y/d/cabinet.glb", "/x_d_cabinet.glb"], ("cabinet", "cabinet", "x_d_cabinet")),
        (["d1/model.glb", "d2/MODEL.obj"], ("d1", "d2")),
        (["d1/model.glb", "d2/model.glb", "e/d1.glb"], ("model", "d2", "d1")),  # a folder has another's name
        (["con/model.glb", "d2/model.glb"], ("model", "d2")),  # no folder may be called so
        ([], ()),
    ],
)
def test_names_that_are_shared_give_way_to_folders(paths: list[str], names: tuple[str, ...]) -> None:
    given = [Path(path) for path in paths]
    assert told_apart(given, [output_name(path) for path in given]) == names
