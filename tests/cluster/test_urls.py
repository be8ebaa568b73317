"""URLs: what they name, what they hold, and what is refused because logs and reports would state it."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.cluster.config import ClusterConfig, FetchConfig
from grafu.cluster.urls import Url, place_of
from grafu.errors import OptionError

PARTS = st.text(st.characters(codec="utf-8", exclude_characters="/@?*["), min_size=1, max_size=8).filter(str.strip)


@given(st.lists(PARTS, min_size=1, max_size=4))
def test_a_url_is_made_of_its_parts(parts: list[str]) -> None:
    url = Url("s3://bucket")
    for part in parts:
        assert (url / part).parent == url
        url = url / part
        assert url.name == part
    assert str(url) == "s3://bucket/" + "/".join(parts)
    assert Url("s3://bucket").holds(url)
    assert not url.holds(Url("s3://bucket"))
    assert not url.has_pattern


def test_neighbours_with_a_common_beginning_do_not_hold_each_other() -> None:
    assert not Url("s3://bucket/out").holds(Url("s3://bucket/output/cab.glb"))


def test_a_bucket_is_its_own_parent() -> None:
    assert Url("s3://bucket/").parent == Url("s3://bucket")


@pytest.mark.parametrize("text", ["s3://", "s3:///", "s3://key:secret@bucket/x", "https://host/cab.glb", "http://h/x"])
def test_what_cannot_be_used_or_holds_a_password_is_refused(text: str) -> None:
    with pytest.raises(OptionError) as refused:
        place_of(text)
    assert "secret" not in str(refused.value)


@pytest.mark.parametrize(
    ("text", "place"),
    [
        ("models/cab.glb", Path("models/cab.glb")),
        ("C:/models/cab.glb", Path("C:/models/cab.glb")),
        ("file:///models/a%20b.glb", Path("/models/a b.glb")),
        ("hf://datasets/owner/name@main/cab.glb", Url("hf://datasets/owner/name@main/cab.glb")),
        ("S3://bucket/Cab.glb/", Url("s3://bucket/Cab.glb")),
    ],
)
def test_paths_stay_paths(text: str, place: object) -> None:
    assert place_of(text) == place


@pytest.mark.parametrize("wrong", [{"in_flight_per_cpu": 0.0}, {"tries": 0}, {"losses": 0}, {"poll_seconds": -1.0}])
def test_settings_that_make_no_sense_are_refused(wrong: dict[str, float]) -> None:
    with pytest.raises(OptionError):
        ClusterConfig(**wrong)  # type: ignore[arg-type]
    with pytest.raises(OptionError):
        FetchConfig(files=0)
