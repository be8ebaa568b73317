"""XML read with care: no entities, no network, no document types, no endless nesting. It knows no URDF."""

from pathlib import Path
from typing import Any

from lxml import etree

from grafu.asset.resources import ModelFiles
from grafu.errors import UnreadableAsset


def read_xml(path: Path, files: ModelFiles) -> Any:
    """Returns the root element of an XML file of a model.

    Raises:
        UnreadableAsset: if the file is missing, not XML, nested more than 255 elements deep, or declares a document
            type: its entities are a known way to exhaust memory and to read other files.
        AssetTooLarge: if it is larger than the limits allow.
    """
    data = files.read(path)
    files.limits.require("values", data.count(b"<") + data.count(b"="), path)
    # libxml2's own limits hold as long as `huge_tree` is not asked for: depth, length of texts, growth by entities
    parser = etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False, remove_comments=True)
    try:
        root = etree.fromstring(data, parser)
    except (etree.XMLSyntaxError, ValueError, LookupError) as error:  # text beside an encoding it does not have
        reason = (str(error).splitlines() or [""])[0]
        raise UnreadableAsset(f"{path} is not readable XML ({reason}): expected a URDF") from None
    if root.getroottree().docinfo.internalDTD is not None:
        raise UnreadableAsset(
            f"{path} declares a document type or XML entities, which are refused: expected plain URDF"
        )
    return root
