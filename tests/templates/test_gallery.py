import pytest

from grafu.errors import TemplateError
from grafu.render.gallery import as_articulated, natural_template, shown_template
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import JointType, MechanismClass


def test_there_are_at_least_eight_hinges_over_all_classes_and_both_rails():
    gallery = builtin_gallery()
    assert len(gallery.hinges) >= 8
    assert all(len(gallery.hinges_of(c)) >= 2 for c in (MechanismClass.C, MechanismClass.F, MechanismClass.P))
    assert {r.mechanism for r in gallery.rails} == {MechanismClass.CENTRE, MechanismClass.CORNER}


def test_a_gallery_refuses_repeated_ids():
    with pytest.raises(TemplateError, match=r"ids must be unique: got .*butt"):
        builtin_gallery().extended(builtin_gallery())


@pytest.mark.parametrize("model", [*builtin_gallery().hinges, *builtin_gallery().rails], ids=lambda m: m.id)
def test_a_template_becomes_an_object_that_stands_and_moves(model):
    template = natural_template(model)
    shown = as_articulated(template)
    assert min(link.mesh.box.low[2] for link in shown.links) == pytest.approx(0.0, abs=1e-12)
    assert shown.joints[0].limits.upper == template.range
    expected = JointType.PRISMATIC if "mount" in model.mechanism.value else JointType.REVOLUTE
    assert shown.joints[0].type is expected
    assert all(v.name.startswith(("hinge_", "rail_")) for link in shown.links for v in link.visuals)


def test_long_templates_are_shown_short():
    piano = next(h for h in builtin_gallery().hinges if h.id == "piano")
    assert shown_template(piano).size.length < 0.2 < natural_template(piano).size.length
