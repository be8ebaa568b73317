"""Whatever stands in an HSSD model's JSON files: it is read, or refused in one line."""

import copy
import tempfile
from pathlib import Path
from typing import Any

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from grafu.asset.load import load_asset
from grafu.errors import FunctionalizationError
from grafu.synth.samples import KINDS
from hssd_models import hssd_model

MODEL = hssd_model(KINDS["drop-down flap"](), meshes=2)
JUNK = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(-3, 2**70),
    st.floats(),
    st.sampled_from(["", "nan", "1", "door", "rest", "/", "\0", "../x", "rotation"]),
    st.lists(st.integers(-1, 9), max_size=3),
    st.dictionaries(st.sampled_from(["pid", "x", "value"]), st.integers(0, 2), max_size=2),
)


def places(value: Any, path: tuple = ()) -> list[tuple]:
    """Returns the path to every value in a JSON document, the document itself left out."""
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    return [p for key, below in items for p in [(*path, key), *places(below, (*path, key))]]


def changed(document: Any, path: tuple, junk: Any) -> Any:
    document = copy.deepcopy(document)
    holder = document
    for key in path[:-1]:
        holder = holder[key]
    holder[path[-1]] = junk
    return document


@settings(max_examples=80, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(st.data())
def test_a_model_is_read_or_refused_in_one_line(data):
    model = copy.copy(MODEL)
    field = data.draw(st.sampled_from(["parts", "articulations"]))
    document = getattr(model, field)
    place = data.draw(st.sampled_from(places(document)))
    setattr(model, field, changed(document, place, data.draw(JUNK)))
    with tempfile.TemporaryDirectory() as folder:
        path = model.save(Path(folder))
        assert said_of(path).count("\n") == 0


def said_of(path: Path) -> str:
    """Returns what is said of a model that is refused, or nothing of one that is read."""
    try:
        asset = load_asset(path)
    except FunctionalizationError as error:
        return str(error)
    assert len(asset.parts) >= 2
    return ""
