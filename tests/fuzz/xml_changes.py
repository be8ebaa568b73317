"""Changes of XML: elements gone, renamed, doubled, nested; attributes that hold anything; entities; encodings."""

from collections.abc import Callable
from copy import deepcopy
from random import Random
from typing import Any

from lxml import etree

from fuzz.entries import Files, data_of, plain

_NUMBERS = ("nan", "inf", "-inf", "1e400", "-1", "0", "1e300", "1e-300", "0x10", "1,5", "9" * 5000, "-0", "1e9")
_TEXTS = ("", " ", "x" * 70_000, "\u202e", "door", "cabinet.urdf", "a b c d e f g h", "-1 -1 -1", "nan nan nan")
_FALSE = (*_NUMBERS, *_TEXTS, "0 0 0", "1e400 0 0", "1 2", "1 2 3 4", "inf 0 0", "1e308 1e308 1e308")
_LAUGHS = "".join(f'<!ENTITY l{n} "{f"&l{n - 1};" * 10}">' for n in range(1, 9))
_ENTITIES = (
    f'<!DOCTYPE robot [<!ENTITY l0 "ha">{_LAUGHS}]>',
    '<!DOCTYPE robot [<!ENTITY l8 SYSTEM "../outside/secret.xml">]>',
    '<!DOCTYPE robot [<!ENTITY l8 SYSTEM "file:///etc/passwd">]>',
    '<!DOCTYPE robot [<!ENTITY % p SYSTEM "../outside/secret.dtd"> %p;]>',
    '<!DOCTYPE robot SYSTEM "../outside/secret.dtd">',
    '<!DOCTYPE robot PUBLIC "-//x//y" "http://127.0.0.1:9/x.dtd">',
    f'<!DOCTYPE robot [<!ENTITY l8 "{"a" * 50_000}">]>',
)


def _of_tree(change: Callable[[Any, Random], bool]) -> Callable[[Files, Random], Files | None]:
    def changed(files: Files, rng: Random) -> Files | None:
        names = plain(files, ".urdf", ".sdf", ".xml", ".dae")
        if not names:
            return None
        name = rng.choice(names)
        try:
            root = etree.fromstring(data_of(files, name), etree.XMLParser(huge_tree=True))
        except etree.XMLSyntaxError:
            return None
        return {**files, name: etree.tostring(root)} if change(root, rng) else None

    changed.__name__ = change.__name__
    return changed


def _below(root: Any) -> list[Any]:
    return [element for element in root.iter(etree.Element) if element is not root]


@_of_tree
def drop_element(root: Any, rng: Random) -> bool:
    found = _below(root)
    if found:
        gone = rng.choice(found)
        gone.getparent().remove(gone)
    return bool(found)


@_of_tree
def rename_element(root: Any, rng: Random) -> bool:
    element = rng.choice([root, *_below(root)])
    element.tag = rng.choice(("link", "joint", "visual", "robot", "x", "{urn:x}link", "mesh", "box", "xacro"))
    return True


@_of_tree
def double_element(root: Any, rng: Random) -> bool:
    found = _below(root)
    if not found:
        return False
    chosen = rng.choice(found)
    size = len(etree.tostring(chosen))
    for _ in range(max(1, min(rng.choice((1, 1, 2, 20, 6000)), 3_000_000 // size))):
        chosen.addnext(deepcopy(chosen))
    return True


@_of_tree
def move_element(root: Any, rng: Random) -> bool:
    found = _below(root)
    if len(found) < 2:
        return False
    moved, target = rng.sample(found, 2)
    if target in moved.iterdescendants():
        return False
    target.append(moved)
    return True


@_of_tree
def other_attribute(root: Any, rng: Random) -> bool:
    found = [(e, k) for e in root.iter(etree.Element) for k in e.attrib]
    if not found:
        return False
    element, key = rng.choice(found)
    values = [e.get(k) for e, k in found[:200]]
    element.set(key, rng.choice(_FALSE if rng.random() < 0.7 else values))
    return True


@_of_tree
def no_attribute(root: Any, rng: Random) -> bool:
    found = [(e, k) for e in root.iter(etree.Element) for k in e.attrib]
    if found:
        element, key = rng.choice(found)
        del element.attrib[key]
    return bool(found)


@_of_tree
def deep_elements(root: Any, rng: Random) -> bool:
    inner = rng.choice([root, *_below(root)])
    tag = rng.choice(("link", "visual", "a"))
    for _ in range(rng.choice((100, 250, 5000))):
        inner = etree.SubElement(inner, tag)
    return True


@_of_tree
def long_chain(root: Any, rng: Random) -> bool:
    """Links that hang on one another, thousands deep."""
    links = [e.get("name") for e in root.findall("link") if e.get("name")]
    if not links:
        return False
    above = rng.choice(links)
    for k in range(rng.choice((50, 1500))):
        etree.SubElement(root, "link", name=f"chain_{k}")
        joint = etree.SubElement(root, "joint", name=f"chain_joint_{k}", type=rng.choice(("fixed", "revolute")))
        etree.SubElement(joint, "parent", link=above)
        etree.SubElement(joint, "child", link=f"chain_{k}")
        above = f"chain_{k}"
    return True


@_of_tree
def other_shape(root: Any, rng: Random) -> bool:
    found = list(root.iter("geometry"))
    if not found:
        return False
    geometry = rng.choice(found)
    for child in list(geometry):
        geometry.remove(child)
    shape = rng.choice(("box", "cylinder", "sphere", "capsule", "plane"))
    keys = {"box": ("size",), "sphere": ("radius",)}.get(shape, ("radius", "length"))
    etree.SubElement(geometry, shape, {key: rng.choice((*_FALSE, "0.1", "0.1 0.2 0.3")) for key in keys})
    return True


@_of_tree
def comments_within(root: Any, rng: Random) -> bool:
    element = rng.choice([root, *_below(root)])
    inserted = rng.choice((etree.Comment("x"), etree.ProcessingInstruction("x", "y"), etree.Comment("x" * 100_000)))
    element.insert(rng.randint(0, len(element)), inserted)
    return True


def declare_entities(files: Files, rng: Random) -> Files | None:
    names = plain(files, ".urdf", ".sdf", ".xml", ".dae")
    if not names:
        return None
    name = rng.choice(names)
    data = data_of(files, name)
    body = data[data.find(b"<robot") :] if b"<robot" in data else data
    body = body.replace(b'name="', b'name="&l8;', rng.randint(0, 3))
    declared = rng.choice(_ENTITIES).encode()
    if rng.random() < 0.3:
        coding = rng.choice(("utf-16", "utf-16-be", "utf-32"))
        head = f'<?xml version="1.0" encoding="{coding}"?>'
        return {**files, name: (head + (declared + body).decode("utf-8", "replace")).encode(coding)}
    return {**files, name: b'<?xml version="1.0"?>' + declared + body}


CHANGES = (
    *(drop_element, other_attribute, no_attribute) * 2,
    *(rename_element, double_element, move_element, deep_elements, long_chain, other_shape, comments_within),
    *(declare_entities, other_attribute),
)
