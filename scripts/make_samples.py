"""Writes samples/*.glb: synthetic furniture without joints, its parts named nodes, as an artist's file would hold it.

    python scripts/make_samples.py [FOLDER]

The same code gives the same bytes. Run it again after a change to `grafu.synth.samples` or the GLB writer.
"""

import json
import struct
import sys
from pathlib import Path

from grafu.asset.edit import as_static_object
from grafu.export.glb import GlbConfig, export_glb
from grafu.synth.samples import SAMPLES

HEADER, CHUNK = "<4sII", "<II"


def sample_bytes(name: str) -> bytes:
    """Returns one sample as GLB, without what grafu would otherwise note about its parts."""
    files = export_glb(as_static_object(SAMPLES[name]()), GlbConfig(animate=False))
    return without_extras(files["model.glb"])


def without_extras(glb: bytes) -> bytes:
    """Returns a GLB whose nodes carry no `extras`."""
    length, kind = struct.unpack_from(CHUNK, glb, struct.calcsize(HEADER))
    start = struct.calcsize(HEADER) + struct.calcsize(CHUNK)
    tables = json.loads(glb[start : start + length])
    for node in tables["nodes"]:
        node.pop("extras", None)
    text = json.dumps(tables, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    body = struct.pack(CHUNK, len(text), kind) + text + glb[start + length :]
    return struct.pack(HEADER, b"glTF", 2, struct.calcsize(HEADER) + len(body)) + body


def main(folder: Path) -> None:
    """Writes every sample into a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    for name in SAMPLES:
        data = sample_bytes(name)
        (folder / f"{name}.glb").write_bytes(data)
        print(f"{name}.glb  {len(data) / 1000:.0f} kB")


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent.parent / "samples")
