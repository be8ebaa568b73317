"""A judge of carved grips that shares nothing with how they are carved: solids are compared by manifold3d."""

import manifold3d
import numpy as np
import trimesh

from grafu.additions.grip.carve import Carved
from grafu.asset.part import Part
from grafu.geometry.mesh import TriangleMesh


def pieces(mesh: TriangleMesh) -> list[trimesh.Trimesh]:
    """The connected pieces, faces drawn twice taken once."""
    merged = trimesh.Trimesh(mesh.vertices, mesh.faces, process=False)
    merged.merge_vertices(digits_vertex=7)
    merged.update_faces(merged.unique_faces() & merged.nondegenerate_faces())
    found = list(merged.split(only_watertight=False))
    for piece in found:
        trimesh.repair.fix_normals(piece)
    return found


def solid(mesh: TriangleMesh) -> manifold3d.Manifold:
    """The union of all pieces that are closed."""
    closed = [piece for piece in pieces(mesh) if piece.is_watertight]
    made = [
        manifold3d.Manifold(
            manifold3d.Mesh64(np.array(p.vertices, dtype=np.float64), np.array(p.faces, dtype=np.uint64))
        )
        for p in closed
    ]
    assert all(m.status() == manifold3d.Error.NoError for m in made)
    return manifold3d.Manifold.batch_boolean(made, manifold3d.OpType.Add) if made else manifold3d.Manifold()


def open_pieces(mesh: TriangleMesh) -> int:
    return sum(not piece.is_watertight for piece in pieces(mesh))


def slivers(mesh: TriangleMesh) -> int:
    return int((mesh.face_areas < 1e-14 * mesh.box.size.max() ** 2).sum())


def assert_sound(before: Part, carved: Carved) -> None:
    """The part is what it was less one grip: nothing broke, nothing was added, nothing changed its look."""
    after = carved.part
    size = float(before.box.size.max())
    assert (after.id, after.label, after.source, after.carried_by) == (
        before.id, before.label, before.source, before.carried_by,
    )  # fmt: skip
    assert np.abs(after.box.low - before.box.low).max() < 1e-6 * max(size, 1.0)
    assert np.abs(after.box.high - before.box.high).max() < 1e-6 * max(size, 1.0)
    old, new = solid(before.mesh), solid(after.mesh)
    assert (new - old).volume() < 1e-6 * max(old.volume(), 1e-12)
    assert old.volume() - new.volume() >= 0.3 * carved.volume - 1e-15
    assert len(pieces(after.mesh)) - len(pieces(before.mesh)) <= (0 if carved.volume else 1)  # else a lining
    assert open_pieces(after.mesh) <= open_pieces(before.mesh)
    materials = {s.material for s in before.surfaces}
    assert {s.material for s in after.surfaces} <= materials
    assert slivers(after.mesh) <= slivers(before.mesh)


def least_wall(part: Part, carved: Carved) -> float:
    """How much material a line straight into the middle of the grip meets, metres."""
    body, out = solid(part.mesh), np.asarray(carved.outward)
    start, end = np.asarray(carved.centre) + 0.01 * out, np.asarray(carved.centre) - 2 * part.box.diagonal * out
    probe = manifold3d.Manifold.cylinder(float(np.linalg.norm(end - start)), 1e-4, circular_segments=4)
    turn = trimesh.geometry.align_vectors(np.array([0.0, 0.0, 1.0]), -out)
    turn[:3, 3] = start
    met = body ^ probe.transform(turn[:3])
    return float(met.volume() / (2e-8))  # the probe's section is a square of that area
