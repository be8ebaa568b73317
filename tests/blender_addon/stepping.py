"""One step of a probe: an operator called as a user would, taken back, done again, what it left. It asserts nothing.

Imported by probes that run in a Python that has `bpy` and `grafu`, with the add-on's folder on `sys.path`.
"""

import json
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter

import bpy

from blender_addon import objects, state
from grafu.asset.load import load_asset
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.templates.gallery import builtin_gallery

FACTS = []


def session():
    return state.session_of(bpy.context)


def snapshot() -> list:
    """What stands in the scene: settings, report without timings, and every object of the result."""
    report = json.loads(session().report_json or "{}")
    report.pop("timings", None)
    found = objects.result_objects(session())
    things = sorted(
        (o["grafu"], o["id"], round(o.get("upper", 0.0), 6), len(o.data.vertices) if o.data else 0) for o in found
    )
    return [session().settings_json, json.dumps(report, sort_keys=True), things]


def difference(when: str, wanted: list, found: list) -> list:
    """What two snapshots do not share, in words."""
    wrong = []
    for what, one, other in zip(("settings", "report", "things"), map(str, found), map(str, wanted), strict=True):
        at = next((k for k, pair in enumerate(zip(one, other, strict=False)) if pair[0] != pair[1]), None)
        if one != other:
            seen = slice(max(0, (at or 0) - 60), (at or 0) + 60)
            wrong.append(f"{when}, {what}: {one[seen]} instead of {other[seen]}")
    return wrong


def expected() -> list:
    """What the library makes of the same sources and settings: links, joints and visuals."""
    settings = state.settings_of(session())
    with TemporaryDirectory() as folder:
        path = Path(folder) / "model.glb"
        objects.export_sources(bpy.context, objects.sources_of(session()), path)
        asset = load_asset(path, settings.reading)
    made = functionalize(asset, settings.motion, builtin_gallery(), PipelineConfig(settings)).object
    things = [("link", link.id, 0.0) for link in made.links]
    things += [("joint", j.id, round(j.limits.upper, 4)) for j in made.joints]
    things += [(v.role.value, v.name, 0.0) for link in made.links for v in link.visuals]
    return sorted(things)


def agrees() -> bool:
    shown = [(kind, name, round(upper, 4)) for kind, name, upper, _ in snapshot()[2]]
    return shown == expected()


def step(title, operator, **arguments):
    """Calls an operator as a user would, then takes it back and does it again."""
    before, began = snapshot(), perf_counter()
    result = next(iter(operator("EXEC_DEFAULT", True, **arguments)))
    seconds, after = perf_counter() - began, snapshot()
    report = json.loads(session().report_json or "{}")
    fact = {
        "step": title,
        "result": result,
        "status": session().status,
        "seconds": seconds,
        "changed": before != after,
        "agrees": agrees(),
        "joints": {
            j["part"]: [j["mechanism"], j["template"], j["count"], j["upper"]] for j in report.get("joints", [])
        },
        "mounts": {j["part"]: j["mount"] for j in report.get("joints", [])},
        "added": {a["part"]: a["style"] for a in report.get("added", [])},
        "motions": {row.part: [row.moves, row.side, row.inwards] for row in session().joints},
        "rows": {row.part: row.level for row in session().joints},
    }
    if result == "FINISHED":
        bpy.ops.ed.undo()
        wrong = difference("undone", before, snapshot())
        bpy.ops.ed.redo()
        fact["wrong"] = [*wrong, *difference("redone", after, snapshot())]
    FACTS.append(fact)
    return fact
