"""Undo and redo, compared with a list and a place in it."""

from hypothesis import given
from hypothesis import strategies as st

from grafu.editor.history import History
from grafu.pipeline.settings import Settings

STEPS = st.lists(st.sampled_from(["undo", "redo"]) | st.integers(0, 4), max_size=40)


def numbered(number: int) -> Settings:
    return Settings(hinge=f"hinge-{number}")


@given(STEPS)
def test_it_is_a_list_and_a_place_in_it(steps):
    history, listed, place = History(numbered(0)), [numbered(0)], 0
    for step in steps:
        if step == "undo":
            history, place = history.undone(), max(place - 1, 0)
        elif step == "redo":
            history, place = history.redone(), min(place + 1, len(listed) - 1)
        else:
            history = history.then(numbered(step))
            if numbered(step) != listed[place]:
                listed, place = [*listed[: place + 1], numbered(step)], place + 1
        assert (*history.past, history.present, *history.future) == tuple(listed)
        assert history.present == listed[place]


@given(STEPS.filter(lambda steps: all(isinstance(step, int) for step in steps)), st.integers(0, 6))
def test_going_back_to_what_was_built_drops_what_came_after(steps, wanted):
    history = History(numbered(9))
    for step in steps:
        history = history.then(numbered(step))
    back = history.back_to(numbered(wanted))
    assert back.present == numbered(wanted)
    assert back.future == ()
    assert back.past == history.past[: len(back.past)]
