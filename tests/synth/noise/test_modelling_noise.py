"""One model's modelling noise applied: each decision leaves its mark, and nothing else changes."""

from dataclasses import replace

import numpy as np
import pytest

from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.fronts.layout import Door, Drawer, Stack
from grafu.synth.generate import with_noise
from grafu.synth.noise.modelling_noise import Joined, Misfit, ModellingNoise, PartCut, apply_noise, as_given
from grafu.synth.truth.check import faults_in
from grafu.vocabulary import PartLabel

TIDY = make_cabinet(Cabinet(layout=Stack((Door(shelves=1), Drawer()))))
NEAT = ModellingNoise("clean cad")
BODY = tuple(p.id for p in TIDY.parts if p.label.is_support)
WALLS = ("side_panel_left", "side_panel_right", "back_panel")


def ids(asset: object) -> list[str]:
    return [part.id for part in asset.parts]  # type: ignore[attr-defined]


def test_a_neat_model_stays_as_it_is() -> None:
    whole, defects = apply_noise(TIDY, NEAT)

    assert ids(whole) == ids(TIDY)
    assert defects == ()
    for before, after in zip(TIDY.parts, whole.parts, strict=True):
        assert np.allclose(before.mesh.vertices, after.mesh.vertices)


DECISIONS = [
    replace(NEAT, loose_objects=("nailers", "things on top")),
    replace(NEAT, joined=(Joined(WALLS, PartLabel.SIDE_PANEL),)),
    replace(NEAT, joined=(Joined(("handle_1", "handle_2"), None),)),
    replace(NEAT, cuts=(PartCut("side_panel_left", "planks", count=3, axis=1), PartCut("shelf_1", "edge strip"))),
    replace(NEAT, cuts=(PartCut("drawer", "box apart"), PartCut("back_panel", "pieces"))),
    replace(NEAT, joined=(Joined(BODY, PartLabel.MISC, named=False),), cuts=(PartCut("drawer", "front alone"),)),
    replace(NEAT, faces=(("sheet", ("back_panel", "bottom_panel")), ("doubled", ("door",)))),
    replace(NEAT, faces=(("loose", ("door",)), ("inverted", ("drawer",)), ("shells", ("top_panel", "drawer")))),
    replace(NEAT, misfits=(Misfit("door", (0.0, 0.004, 0.0)), Misfit("drawer", (0.003, 0.0, 0.0), grown=True))),
    replace(NEAT, ajar=(("drawer", 0.3),)),
    replace(NEAT, factors=(-1.1, 0.9, 1.2)),
    replace(NEAT, bend=0.002),
    replace(NEAT, yaw=float(np.pi / 2)),
    replace(NEAT, missing=("top_panel", "handle_1")),
    replace(NEAT, masked=0.5, mislabelled=True, shuffled=True),
]


@pytest.mark.parametrize("noise", DECISIONS, ids=lambda u: str(DECISIONS.index(u)))
def test_each_decision_makes_a_sound_specimen(noise: ModellingNoise) -> None:
    specimen = with_noise("made", "cabinet", TIDY, noise, 4)

    assert not faults_in(specimen)
    assert {j.part for j in specimen.whole.joints} == {"door", "drawer"}
    assert {e.child for e in (*specimen.truth.hinges, *specimen.truth.rails)} == {"door", "drawer"}
    assert specimen.whole.box.low[2] == pytest.approx(0.0, abs=0.005)


def test_geometry_out_of_place_is_declared() -> None:
    sunk = replace(NEAT, misfits=(Misfit("door", (0.0, 0.004, 0.0)),))
    loose = replace(NEAT, misfits=(Misfit("door", (0.0, -0.004, 0.0)),))
    open_drawer = replace(NEAT, ajar=(("drawer", 0.3),))

    kinds = {apply_noise(TIDY, u)[1][0].kind: apply_noise(TIDY, u)[1][0].parts for u in (sunk, loose)}
    assert kinds == {"interpenetrating": ("door",), "floating": ("door",)}
    assert apply_noise(TIDY, open_drawer)[1][0].kind == "ajar"


def test_decisions_about_parts_that_are_gone_are_passed_over() -> None:
    gone = replace(
        NEAT,
        joined=(Joined(WALLS, PartLabel.MISC),),
        cuts=(PartCut("back_panel", "planks"),),
        misfits=(Misfit("side_panel_left", (0.001, 0.0, 0.0)),),
        faces=(("sheet", ("side_panel_right",)),),
    )

    whole, defects = apply_noise(TIDY, gone)

    assert ids(whole)[0] == "joined_1"
    assert defects == ()


def test_what_is_given_states_no_joints_and_lacks_what_is_missing() -> None:
    u = replace(NEAT, missing=("top_panel", "side_panel_left"), masked=1.0)

    given, defects = as_given(TIDY, u, {"top_panel"})

    assert given.joints == ()
    assert set(ids(TIDY)) - set(ids(given)) == {"top_panel"}
    assert {p.label for p in given.parts} == {PartLabel.UNKNOWN}
    assert [(d.kind, d.parts) for d in defects] == [("missing", ("top_panel",))]


def test_the_last_still_parts_are_kept() -> None:
    still = {p.id for p in TIDY.parts if p.label.is_support}

    given, defects = as_given(TIDY, replace(NEAT, missing=tuple(still)), still)

    assert ids(given) == ids(TIDY)
    assert defects == ()


def test_a_wrong_label_is_declared() -> None:
    given, [defect] = as_given(TIDY, replace(NEAT, mislabelled=True, seed=1), ())

    wrong = [p.id for p, q in zip(given.parts, TIDY.parts, strict=True) if p.label is not q.label]
    assert defect.kind == "mislabelled"
    assert list(defect.parts) == wrong
