"""XML read with care: no entities, no network, no document types. It knows no URDF."""

from pathlib import Path
from typing import Any

from lxml import etree

from grafu.asset.mesh_files import read_bytes
from grafu.asset.options import Limits
from grafu.errors import UnreadableAsset


def read_xml(path: Path, limits: Limits) -> Any:
    """Returns the root element of an XML file.

    Raises:
        UnreadableAsset: if the file is missing, not XML, or declares entities (a known way to exhaust memory).
    """
    data = read_bytes(path, limits)
    if b"<!ENTITY" in data.upper():
        raise UnreadableAsset(
            f"{path} declares XML entities, which are refused: expected plain URDF; expand them first"
        )
    parser = etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False, remove_comments=True)
    try:
        return etree.fromstring(data, parser)
    except etree.XMLSyntaxError as error:
        reason = str(error).splitlines()[0]
        raise UnreadableAsset(f"{path} is not readable XML ({reason}): expected a URDF") from None
