"""Where the names in a URDF lead: relative paths, and ROS packages (`package://NAME/meshes/door.obj`).

A package is a folder with a `package.xml` at most four levels above the URDF, or the folder that the user gave. Where
neither is known and the URDF lies in a folder called `urdf` or `robots`, its package is the folder above, and of that
only the folders that packages keep meshes and images in. It reads no meshes.
"""

from pathlib import Path

from grafu.asset.resources import MISSING, OUTSIDE, ModelFiles, Sought

_LEVELS = 4
_URDF_FOLDERS = frozenset({"urdf", "robots"})
_BESIDE = ("meshes", "mesh", "visual", "textures", "materials", "images", "media")


def package_files(urdf: Path, files: ModelFiles) -> ModelFiles:
    """Returns the files of a model that may also be read from the package around its URDF."""
    package = _package(urdf)
    if package is not None:
        return files.with_roots(package)
    folder = urdf.absolute().parent
    if folder.name.lower() not in _URDF_FOLDERS:
        return files
    return files.with_roots(*(folder.parent / name for name in _BESIDE))


def find_in_package(name: str, urdf: Path, files: ModelFiles) -> Sought:
    """Returns the file that a URDF means by a name, or in words why there is none; see the module."""
    _, scheme, rest = name.rpartition("://")
    if not scheme:
        return files.seek(name, urdf.parent)
    tails = [tail for tail in dict.fromkeys((rest.lstrip("/"), rest.partition("/")[2].lstrip("/"))) if tail]
    if name.lower().startswith("file:"):
        tails.insert(0, f"/{rest.lstrip('/')}")
    tried = [files.seek(tail, folder) for tail in tails for folder in _bases(urdf, files)]
    found = next((sought for sought in tried if sought.path is not None), None)
    # that a name leads out at one of several places says nothing while it leads nowhere at the others
    return found or Sought(None, OUTSIDE if tried and all(s.why == OUTSIDE for s in tried) else MISSING)


def _bases(urdf: Path, files: ModelFiles) -> list[Path]:
    folder = urdf.absolute().parent
    above = [p for p in folder.parents if files.holds(p)][:_LEVELS]
    package = _package(urdf)
    beside = [folder.parent] if folder.name.lower() in _URDF_FOLDERS else []
    return list(dict.fromkeys([folder, *above, *([package] if package else []), *beside]))


def _package(urdf: Path) -> Path | None:
    folder = urdf.absolute().parent
    return next((p for p in (folder, *folder.parents)[:_LEVELS] if (p / "package.xml").is_file()), None)
