"""What a drawer waits for, and what that waits for in its turn."""

from grafu.articulation.waiting import all_before


def test_what_waits_for_what_waits() -> None:
    waits = {"drawer": ("door",), "door": ("flap", "leaf"), "leaf": ()}
    assert all_before("drawer", waits) == {"door", "flap", "leaf"}
    assert all_before("flap", waits) == set()


def test_a_circle_comes_to_an_end() -> None:
    assert all_before("a", {"a": {"b"}, "b": {"a"}}) == {"a", "b"}
