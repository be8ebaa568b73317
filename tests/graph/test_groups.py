"""What hangs together is one group, and what stands alone is one too."""

from grafu.graph.groups import joined_groups


def test_a_way_over_others_joins() -> None:
    joined = {"a": ("b",), "b": ("a", "c"), "c": ("b",), "d": (), "e": ("f",), "f": ("e",)}
    assert joined_groups(joined) == [frozenset("abc"), frozenset("d"), frozenset("ef")]
    assert joined_groups({}) == []
