"""Joint after joint is built in one scene: what is known of it goes on, or time would grow with the square of parts."""

from dataclasses import replace

import pytest

from grafu.joints.config import RealizationConfig
from grafu.joints.make_plan import plan_from_annotation
from grafu.joints.realize import realize
from grafu.processes.cache import Cache, content_key
from grafu.scene import scene
from grafu.synth.samples import furniture_of
from grafu.templates.gallery import builtin_gallery

PARTS = 40


def listed(parts: int, monkeypatch: pytest.MonkeyPatch) -> float:
    """How many entries of moving bodies are listed for each of them while the joints of a wall are built."""
    asset, count, entry = furniture_of(parts), list[str](), scene._body_entry

    def noted(of: scene.Scene, name: str):
        count.append(name)
        return entry(of, name)

    monkeypatch.setattr(scene, "_body_entry", noted)
    found = realize(plan_from_annotation(asset), asset, builtin_gallery())
    monkeypatch.setattr(scene, "_body_entry", entry)
    return len(count) / len(found.report.installed)


def test_the_moving_bodies_are_not_listed_anew_for_each_joint(monkeypatch: pytest.MonkeyPatch) -> None:
    few, many = listed(PARTS, monkeypatch), listed(2 * PARTS, monkeypatch)
    assert many <= few + 1


def test_a_run_that_keeps_what_it_builds_builds_the_same() -> None:
    asset = furniture_of(PARTS)
    plan, gallery = plan_from_annotation(asset), builtin_gallery()
    plain = realize(plan, asset, gallery)
    kept = realize(plan, asset, gallery, RealizationConfig(), Cache(100))
    assert content_key(plain.object) == content_key(kept.object)
    reports = [replace(found.report, timings=()) for found in (plain, kept)]
    assert content_key(reports[0]) == content_key(reports[1])
