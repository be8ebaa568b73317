"""The text of an MJCF model: included files put in place, elements named by number, what is not read taken out.

Included files are sought like all files of a model. What is multiplied (`<replicate>`) is counted before it is built.
"""

import re
from dataclasses import field
from pathlib import Path
from typing import Any, final

from grafu.asset.options import check_parts
from grafu.asset.resources import ModelFiles
from grafu.asset.scan_files import parse_xml
from grafu.dataclass import dataclass
from grafu.errors import UnreadableAsset

SHOWN_GROUPS = 3  # as in MuJoCo's viewer: models keep collision shapes in group 3 and above
COLLISION = re.compile(r"collision|collider", re.IGNORECASE)
_EXPECTED = "an MJCF model"
_GROUPS = tuple(str(group) for group in range(SHOWN_GROUPS))
_MOST_INCLUDED = 200
_SECTIONS = ("compiler", "default", "asset", "worldbody")
_IN_BODIES = {"body", "geom", "joint", "freejoint", "frame", "replicate"}
_PLAIN = {"site", "camera", "light", "inertial", "plugin"}  # nothing is lost with them
_IN_DEFAULTS = {"default", "geom", "joint", "mesh", "material"}
_IN_ASSETS = {"mesh", "texture", "material"}
_OF_COMPILER = {"angle", "eulerseq", "autolimits", "meshdir", "texturedir", "assetdir", "strippath"}
_NAMED = {"body": "b", "geom": "g", "joint": "j", "freejoint": "j"}
_NUMBERED = re.compile(r"([bgj]\d+_)(.*)", re.DOTALL)


@final
@dataclass
class MjcfText:
    """The elements that are read. Bodies, geoms and joints are numbered; `names` and `classes` are those they had.

    `couplings` are the joint that follows, the joint that leads (by the names they had), multiplier and offset.
    """

    root: Any
    names: dict[str, str] = field(default_factory=dict)
    classes: dict[str, str] = field(default_factory=dict)
    couplings: list[tuple[str, str, str]] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)

    def name(self, numbered: str) -> str:
        """Returns the name that an element had, with the number that a copy of it got; empty where it had none."""
        match = _NUMBERED.fullmatch(numbered)
        stated = self.names.get(match[1], "") if match else ""
        return stated + match[2] if match and stated else ""

    def class_of(self, numbered: str) -> str:
        """Returns the class of an element, its own or that of the nearest body or frame around it."""
        match = _NUMBERED.fullmatch(numbered)
        return self.classes.get(match[1], "") if match else ""

    def without_files(self, meshes: set[str]) -> None:
        """Takes all assets out; the geoms with these numbers become boxes, which changes no pose."""
        for element in self.root.findall("asset"):
            self.root.remove(element)
        for element in [*self.root.iter("geom")]:
            for key in ("mesh", "material", "hfield", "fitscale"):
                element.attrib.pop(key, None)
            if element.get("name") in meshes:
                element.attrib.pop("fromto", None)
                element.attrib.update({"type": "box", "size": "1 1 1"})
        for default in self.root.iter("default"):
            for element in [*default.findall("mesh"), *default.findall("material")]:
                default.remove(element)


def whole_text(path: Path, files: ModelFiles) -> MjcfText:
    """Returns what is read of an MJCF file and the files that it includes.

    Raises:
        UnreadableAsset: if it is no MJCF, or an included file is missing, includes itself or leads out of the folder.
        AssetTooLarge: if it has more of something than the limits allow.
    """
    root = _parsed(path, files)
    if root.tag != "mujoco":
        raise UnreadableAsset(f"{path} has the root <{root.tag}>: expected <mujoco>, {_EXPECTED}")
    _include(root, path, files)
    text = MjcfText(root)
    text.couplings += [
        (e.get("joint1", ""), e.get("joint2", ""), e.get("polycoef", "0 1")) for e in root.iterfind("equality/joint")
    ]
    _keep(text, root, set(_SECTIONS))
    for element in root.iter("compiler"):
        for key in set(element.attrib) - _OF_COMPILER:
            del element.attrib[key]
        element.attrib.update({"inertiafromgeom": "true", "balanceinertia": "true"})
        element.attrib.update({"boundmass": "0.001", "boundinertia": "0.000001"})
    if root.find("compiler") is None:
        root.insert(0, root.makeelement("compiler", {"boundmass": "0.001", "boundinertia": "0.000001"}))
    for section, kept in (("default", _IN_DEFAULTS), ("asset", _IN_ASSETS)):
        for element in root.findall(section):
            _keep(text, element, kept)
    for element in root.findall("worldbody"):
        _number(text, element, path, files)
    return text


def _parsed(path: Path, files: ModelFiles) -> Any:
    return parse_xml(files.read(path), path, _EXPECTED, files.limits)


def _include(root: Any, path: Path, files: ModelFiles) -> None:
    """Puts the children of each included file where it is included; names count from the folder of the model."""
    seen: set[Path] = set()
    while (element := next(root.iter("include"), None)) is not None:
        name, parent = element.get("file", ""), element.getparent()
        sought = files.seek(name, path.parent)
        if sought.path is None:
            raise UnreadableAsset(
                f"{path}: the included file {name[:200]!r} {sought.why}: expected a file of the model"
            )
        if sought.path in seen or len(seen) >= _MOST_INCLUDED or parent is None:
            raise UnreadableAsset(f"{path}: {name[:200]!r} is included twice or by itself: expected each file once")
        seen.add(sought.path)
        at = parent.index(element)
        parent.remove(element)
        for child in reversed(_parsed(sought.path, files)):
            parent.insert(at, child)


def _keep(text: MjcfText, parent: Any, kept: set[str]) -> None:
    for element in [*parent]:
        if element.tag not in kept:
            parent.remove(element)
        elif element.tag == parent.tag == "default":
            _keep(text, element, kept)


def _number(text: MjcfText, world: Any, path: Path, files: ModelFiles) -> None:
    """Numbers what lies in the world, takes out what is not read, and counts each copy that will be made.

    MuJoCo's time grows with the square of bodies and of copies, so that all are counted before it is asked.
    """
    stack = [(world, "", 1)]
    total = bodies = shown = 0
    looks = _looks(text.root)
    while stack:
        above, given, times = stack.pop()
        for element in [*above]:
            if element.tag not in _IN_BODIES:
                above.remove(element)
                if element.tag not in _PLAIN:
                    text.notes.append(f"<{element.tag}> is not read and was left out")
                continue
            given_here = element.get("childclass", given)
            many = times * max(_whole(element.get("count", "1")), 1) if element.tag == "replicate" else times
            total += many
            files.limits.require("nodes", total, path)
            bodies += many if element.tag == "body" else 0
            shown += many if element.tag == "geom" and _is_shown(element, given_here, looks) else 0
            if element.tag in _NAMED:
                key = f"{_NAMED[element.tag]}{len(text.classes)}_"
                text.names[key], text.classes[key] = element.get("name", ""), element.get("class", given)
                element.set("name", key)
            for plugin in element.findall("plugin") if element.tag == "geom" else ():
                element.remove(plugin)
            stack.append((element, given_here, many))
    check_parts(max(bodies, shown), path, files.limits)


def _looks(root: Any) -> dict[str, dict[str, str]]:
    """Returns for each class what its geoms are like; an empty name is that of the main class."""
    found: dict[str, dict[str, str]] = {"": {}}
    above = [(element, "", True) for element in root.findall("default")]
    while above:
        element, parent, is_main = above.pop(0)
        name = "" if is_main else element.get("class", "")
        found[name] = {**found[parent], **found.get(name, {})}
        for geom in element.findall("geom"):
            found[name] |= geom.attrib
        above += [(child, name, False) for child in element.findall("default")]
    return found


def _is_shown(geom: Any, given: str, looks: dict[str, dict[str, str]]) -> bool:
    """Whether a geom is surely shown; MuJoCo decides on the others."""
    of = geom.get("class", given)
    look = {**looks.get(of, looks[""]), **geom.attrib}
    group, alpha = look.get("group", "0"), look.get("rgba", "1").split()[-1:]
    is_solid = look.get("type") not in ("plane", "hfield", "sdf") and not COLLISION.search(of)
    return is_solid and group in _GROUPS and alpha != ["0"]


def _whole(text: str) -> int:
    return int(text) if text.strip().isdecimal() and len(text) < 10 else 10**9
