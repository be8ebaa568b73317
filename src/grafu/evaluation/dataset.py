"""Which models there are to measure on, and each as an asset whose joints are the truth. It measures nothing.

A dataset is a folder (PartNet-Mobility, HSSD with S2O annotations, files of every format that is read, the authors'
releases, results that were gone through in `grafu edit`, any mixture of them), one model, or `synth:SEED:COUNT`:
furniture that is made on the spot.
"""

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache
from itertools import count
from pathlib import Path
from typing import Final, final, get_args

from grafu.asset.hssd_annotation import is_hssd
from grafu.asset.json_files import read_json
from grafu.asset.load import AFTER_MESHES, READERS, SCENES, detect, is_partnet_mobility, load_asset, scene_kind
from grafu.asset.mesh_files import MESH_SUFFIXES
from grafu.asset.part import Asset, Part
from grafu.asset.resources import ModelFiles
from grafu.data.furfun.layout import LayoutKind
from grafu.dataclass import dataclass
from grafu.errors import AssetError, OptionError, UnreadableAsset
from grafu.evaluation.dataset_decided import files_of_decided, is_decided, read_decided
from grafu.evaluation.dataset_release import is_release, read_release_model, release_models
from grafu.evaluation.welded import WELDED, weld_of, welded
from grafu.export.output_names import GENERIC_STEMS
from grafu.synth.generate import make_specimen
from grafu.synth.specimen import Specimen

_RELEASES: Final = get_args(LayoutKind)
_DECIDED: Final = "decided"
_KIND_OF: Final = {**{name: name for name in READERS}, "gltf": "glb", "mesh folder": "mesh", "mesh file": "mesh"}
KINDS: Final = (*dict.fromkeys(_KIND_OF.values()), *_RELEASES, _DECIDED, "made", WELDED)
"""The kinds of models: what reads them, `glb`, `mesh`, a release, decided by hand, made on the spot, or that welded."""
TEST_SEED = 990_002  # of the synthetic furniture that nothing is trained on or chosen by
_MADE = "synth"
_ON_THE_SPOT = ("made", WELDED)
_TEST_COUNT = 100
_MOST_MADE = 1_000_000  # more are a slip of the pen: a month of work
_ROBOT_FILES = ("urdf", "sdf", "mjcf")  # all of which are robots; of OpenUSD scenes only some are
_MESHES_OF = frozenset({"meshes", "mesh", "visual", "collision", "textured_objs", "objs", "textures", "images"})
_DEEPEST = 3  # folders below the one that is asked for
EXPECTED = (
    "PartNet-Mobility folders (mobility.urdf, or mobility_v2.json with result.json), HSSD models (<id>.glb with "
    "<id>.artpre.json), URDF or other robot files, GLB or other scenes, folders of meshes, a release "
    "(graphs_unfunctional or graph_unfunc), results with decisions.jsonl, "
    f"or {_MADE}:SEED:COUNT, {WELDED}:SEED:COUNT"
)


@final
@dataclass(frozen=True, slots=True)
class ModelRef:
    """One model of a dataset, not read yet. `id` is unique in its dataset and safe as a file name.

    `path` is what is read: a folder or a file; of a release, the model's input graph. A `made` model has none: it is
    number `number` of the furniture of `seed`.

    Raises:
        OptionError: if the id is no file name, the kind unknown, or the fields do not fit the kind.
    """

    id: str
    kind: str
    path: Path | None = None
    seed: int | None = None
    number: int | None = None

    def __post_init__(self) -> None:
        if not self.id or self.id in (".", "..") or set(self.id) & set("/\\\0"):
            raise OptionError(f"`id` must be a file name: got {self.id!r}")
        if self.kind not in KINDS:
            raise OptionError(f"`kind` must be one of {', '.join(KINDS)}: got {self.kind!r}")
        made = (self.seed, self.number)
        if self.kind in _ON_THE_SPOT:
            if self.path is not None or any(value is None or value < 0 for value in made):
                raise OptionError(
                    f"a synthetic model has a seed and a number from 0, and no path: got {made}, {self.path}"
                )
        elif self.path is None or made != (None, None):
            raise OptionError(f"a {self.kind} model has a path, and no seed or number: got {self.path}, {made}")


def find_models(data: str | Path, split: str = "") -> tuple[ModelRef, ...]:
    """Returns the models of a dataset, in the order of their ids; made ones in the order of their numbers.

    Args:
        data: a folder of models, also in folders of their own, or one model; `synth:SEED:COUNT`, or `synth` for the
            test furniture; `welded` in place of `synth` for the same, welded.
        split: the name of a split of a release (`full_split`): only its test models. Other datasets have none.

    Raises:
        OptionError: if `synth:...` is not two numbers, or asks for too many.
        AssetError: if there is nothing that is read, or no such split.
    """
    for word in (_MADE, WELDED):
        if str(data) == word or str(data).startswith(f"{word}:"):
            return _made_models(str(data), word)
    path = Path(data)
    try:
        found = _models_in(path, split, _DEEPEST) if path.is_dir() else _one(path)
    except OSError as error:
        raise UnreadableAsset(f"{path} cannot be read ({error.strerror}): expected {EXPECTED}") from None
    if not found:
        state = "holds no model" if path.exists() else "does not exist"
        raise UnreadableAsset(f"{path} {state}: expected {EXPECTED}")
    return _with_unique_ids(found)


def find_all_models(data: Sequence[str | Path], split: str = "") -> tuple[ModelRef, ...]:
    """Returns the models of several datasets together, each in the order of `find_models`; of releases, of a split.

    Raises:
        OptionError: as by `find_models`, or if two of them have models of one id.
        AssetError: as by `find_models`.
    """
    found = [ref for one in data for ref in find_models(one, split)]
    twice = [name for name, number in Counter(ref.id for ref in found).items() if number > 1]
    if twice:
        raise OptionError(f"models of several datasets must have different ids: got `{twice[0]}` twice")
    return tuple(found)


def load_model(ref: ModelRef) -> Asset:
    """Returns a model as an asset in the object frame; its `joints` are the truth, empty where none is known.

    Raises:
        AssetError: if it is missing, damaged, or has no mesh that could move.
    """
    if ref.kind in _ON_THE_SPOT:
        return _made_asset(_specimen(ref))
    if ref.kind in _RELEASES:
        return read_release_model(_path(ref))
    if ref.kind == _DECIDED:
        return read_decided(_path(ref))
    return load_asset(_path(ref)).as_annotated()


def given_model(ref: ModelRef, truth: Asset) -> Asset:
    """Returns what a method is given of a model: the model, or what the reader finds in it where it is welded.

    Raises:
        AssetError: if a welded model is not told apart.
    """
    if ref.kind != WELDED:
        return truth
    assert ref.number is not None
    return welded(truth, weld_of(ref.number))


def files_of_model(ref: ModelRef) -> tuple[Path, ...]:
    """Returns the files or folders that a model is read from; none of a made one."""
    if ref.kind == _DECIDED:
        return files_of_decided(_path(ref))
    return () if ref.path is None else (ref.path,)


def category_of(ref: ModelRef) -> str:
    """Returns the category of a model: what its data set states (`Table`), a made one's family, or its kind."""
    if ref.kind == "made":
        return _specimen(ref).family
    if ref.kind == WELDED:
        assert ref.number is not None
        return weld_of(ref.number)
    stated = _stated_category(_path(ref)) if ref.kind == "partnet-mobility" else ""
    return stated or ref.kind


def _models_in(folder: Path, split: str, depth: int) -> list[ModelRef]:
    """Returns the models in a folder: a release, a model of its own, scene files, or what lies in its folders."""
    if is_release(folder):
        return [ModelRef(model_id, kind, path) for model_id, kind, path in release_models(folder, split)]
    if is_decided(folder):
        return [ModelRef(folder.resolve().name, _DECIDED, folder)]
    if is_partnet_mobility(folder):
        return [ModelRef(folder.resolve().name, "partnet-mobility", folder)]
    entries = sorted(p for p in folder.iterdir() if not p.name.startswith((".", "__")))
    scenes = _scene_files(entries)
    found = [ref for file in scenes for ref in _one(file)]
    if depth and not any(ref.kind in _ROBOT_FILES for ref in found):  # what lies below a robot are its meshes
        inner = [p for p in entries if p.is_dir() and p.name.lower() not in _MESHES_OF]
        below = [ref for p in inner for ref in _models_in(p, split, depth - 1)]
        found += [ref for ref in below if ref.kind != "mesh" or not scenes]
    return found or _one(folder)


def _scene_files(entries: list[Path]) -> list[Path]:
    """Returns the annotated GLBs of a folder, or else its robots, or else its other scenes: these may be copies.

    Of several files of one name the first in the table of formats counts.
    """
    kinds = {p: scene_kind(p) for p in entries if p.is_file()}
    if any(p.suffix.lower() in MESH_SUFFIXES for p in kinds):
        kinds = {p: None if kind in AFTER_MESHES else kind for p, kind in kinds.items()}
    annotated = [p for p in kinds if is_hssd(p)]
    robots = [p for p, kind in kinds.items() if kind in _ROBOT_FILES]
    found = robots or [p for p, kind in kinds.items() if kind is not None]
    order = list(SCENES)
    first: dict[str, Path] = {}
    for path in sorted(found, key=lambda p: order.index(kinds[p] or "")):
        first.setdefault(path.stem.lower(), path)
    return annotated or [path for path in found if first[path.stem.lower()] == path]


def _one(path: Path) -> list[ModelRef]:
    """Returns the one model that a file or folder is, or nothing."""
    try:
        kind, place = detect(path)
    except AssetError:
        return []
    named = place if place.is_dir() else place.parent if place.stem.lower() in GENERIC_STEMS else place.with_suffix("")
    return [ModelRef(named.resolve().name, _KIND_OF[kind], place)]


def _with_unique_ids(refs: list[ModelRef]) -> tuple[ModelRef, ...]:
    """Returns the models by id; of several with the same, each has its kind before it, and a number if need be."""
    counts = Counter(ref.id for ref in refs)
    taken = {ref.id for ref in refs if counts[ref.id] == 1}
    named = []
    for ref in refs:
        plain = name = ref.id if counts[ref.id] == 1 else f"{ref.kind}_{ref.id}"
        numbers = count(2)
        while counts[ref.id] > 1 and name in taken:
            name = f"{plain}_{next(numbers)}"
        taken.add(name)
        named.append(replace(ref, id=name))
    return tuple(sorted(named, key=lambda ref: ref.id))


def _made_models(data: str, word: str) -> tuple[ModelRef, ...]:
    numbers = data.split(":")[1:] if data != word else [str(TEST_SEED), str(_TEST_COUNT)]
    if len(numbers) != 2 or not all(n.isascii() and n.isdigit() for n in numbers) or int(numbers[1]) < 1:
        raise OptionError(f"synthetic furniture must be asked for as {word}:SEED:COUNT: got {data!r}")
    seed, size = (int(n) for n in numbers)
    if size > _MOST_MADE:
        raise OptionError(f"at most {_MOST_MADE:,} models are made: got {data!r}")
    kind = WELDED if word == WELDED else "made"
    return tuple(ModelRef(f"{word}_{seed}_{k:07d}", kind, seed=seed, number=k) for k in range(size))


@lru_cache(maxsize=2)  # asked for its category right after it was read
def _specimen(ref: ModelRef) -> Specimen:
    assert ref.seed is not None  # a synthetic model has both
    assert ref.number is not None
    return make_specimen(ref.seed, ref.number)


def _made_asset(specimen: Specimen) -> Asset:
    """Returns the furniture as it was modelled, with the joints and attached parts of its repaired version."""
    present = {part.id for part in specimen.asset.parts}
    carried = {p.id: p.carried_by for p in specimen.whole.parts if p.carried_by in present}
    parts: tuple[Part, ...] = tuple(replace(p, carried_by=carried.get(p.id)) for p in specimen.asset.parts)
    joints = tuple(joint for joint in specimen.whole.joints if joint.part in present)
    return replace(specimen.asset, name=specimen.id, parts=parts, joints=joints)


def _stated_category(folder: Path) -> str:
    try:
        meta = read_json(folder / "meta.json", ModelFiles(folder), "the facts of a PartNet-Mobility model")
    except AssetError:
        return ""
    return str(meta.get("model_cat") or "") if isinstance(meta, dict) else ""


def _path(ref: ModelRef) -> Path:
    assert ref.path is not None  # every kind but what is made on the spot has one
    return ref.path
