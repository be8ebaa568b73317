"""How time grows with parts (walls of doors and drawers) and with faces (a dresser, its triangles divided).

`bench.py` runs it. The exponent is the slope of a line through the logarithms: 1 is in proportion. Walls are timed
without files; the dresser from its GLB to `glb` and `urdf`, each size in a process of its own for its memory.
"""

import resource
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import median

import numpy as np
from bench_figure import Figure, Section
from bench_table import measured_table

SAMPLE = Path(__file__).parent.parent / "samples" / "dresser.glb"
PARTS, QUICK_PARTS = (40, 80, 120, 160, 200), (40, 80)  # with fewer parts a wall has fewer joints for each
FACES, QUICK_FACES = (30_000, 120_000, 500_000, 2_000_000), (30_000, 120_000)
BARS = {"parts": 1.1, "faces": 1.0}
LARGE_MB = 1500.0


@dataclass(frozen=True)
class Grown:
    """One size: parts or faces, sorted seconds of the processor, the most memory of its process in MB."""

    size: int
    cpu: tuple[float, ...]
    peak_mb: float


def time_wall(parts: int, repeats: int) -> Grown:
    """Returns the timing of a wall with so many parts, after a run that only warms up."""
    from grafu.export.formats import export
    from grafu.pipeline.functionalize import functionalize
    from grafu.pipeline.motion_source import MotionSource
    from grafu.synth.samples import furniture_of
    from grafu.templates.gallery import builtin_gallery

    asset = furniture_of(parts)

    def run() -> None:
        export(functionalize(asset, MotionSource.ANNOTATION, builtin_gallery()).object, ("glb", "urdf"))

    run()
    return Grown(len(asset.parts), _timed(run, repeats), _peak())


def time_faces(faces: int, repeats: int) -> Grown:
    """Returns the timing of the dresser with at least so many faces, after the sample itself, which only warms up."""
    import trimesh
    from bench_models import one_run

    scene = trimesh.load_scene(SAMPLE)
    bare = sum(len(mesh.faces) for mesh in scene.geometry.values())
    times = max(0, int(np.ceil(np.log(faces / bare) / np.log(4))))
    for name, mesh in list(scene.geometry.items()):
        points, triangles = mesh.vertices, mesh.faces
        for _ in range(times):
            points, triangles = trimesh.remesh.subdivide(points, triangles)
        scene.geometry[name] = trimesh.Trimesh(points, triangles, process=False)
    size = sum(len(mesh.faces) for mesh in scene.geometry.values())
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "dresser.glb"
        path.write_bytes(scene.export(file_type="glb"))
        del scene
        one_run(str(SAMPLE))

        def run() -> None:
            if one_run(str(path), size) is None:
                raise SystemExit(f"the dresser with {size} faces was refused")

        return Grown(size, _timed(run, repeats), _peak())


def _timed(run: Callable[[], None], repeats: int) -> tuple[float, ...]:
    seconds = []
    for _ in range(repeats):
        started = time.process_time()
        run()
        seconds.append(round(time.process_time() - started, 4))
    return tuple(sorted(seconds))


def _peak() -> float:
    used = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / (2**20 if sys.platform == "darwin" else 2**10)
    return round(used, 1)


def growth_section(quick: bool, repeats: int, fresh: Callable[..., Grown]) -> Section:
    """Returns the exponents in parts and faces, and time and memory at the most faces."""
    walls = [fresh(time_wall, size, repeats) for size in (QUICK_PARTS if quick else PARTS)]
    meshes = [fresh(time_faces, size, 1) for size in (QUICK_FACES if quick else FACES)]
    last = meshes[-1]
    most = f"{last.size / 1e6:.2g} million faces"
    figures = (
        Figure("growth with parts: exponent", exponents(walls), bar=BARS["parts"]),
        Figure("growth with faces: exponent", exponents(meshes), bar=BARS["faces"]),
        Figure(f"one model of {most}", last.cpu, "s"),
        Figure(f"memory at {most}", (last.peak_mb,), "MB", LARGE_MB),
    )
    return Section(figures, f"{_table('Walls', 'parts', walls)}\n{_table('A dresser', 'faces', meshes)}")


def exponents(grown: Sequence[Grown]) -> tuple[float, ...]:
    """Returns the exponent for each run: of the quickest run of each size, of the next, and so on."""
    sizes = np.log([one.size for one in grown])
    runs = zip(*(one.cpu for one in grown), strict=True)
    return tuple(round(float(np.polyfit(sizes, np.log(run), 1)[0]), 3) for run in runs)


def _table(title: str, unit: str, grown: Sequence[Grown]) -> str:
    rows = [(f"{one.size:,} {unit}", f"{median(one.cpu):.2f} s, {one.peak_mb:.0f} MB") for one in grown]
    return measured_table(title, "Seconds of the processor, and the most memory.", rows)
