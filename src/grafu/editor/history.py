"""What was chosen one step after another, with undo and redo without limit. It is a value."""

from typing import final

from grafu.dataclass import dataclass
from grafu.pipeline.settings import Settings


@final
@dataclass(frozen=True)
class History:
    """The settings as they are, those before (oldest first) and those that were undone (next first)."""

    present: Settings
    past: tuple[Settings, ...] = ()
    future: tuple[Settings, ...] = ()

    def then(self, settings: Settings) -> "History":
        """Returns the history after one more choice; what was undone is gone. The same settings change nothing."""
        return self if settings == self.present else History(settings, (*self.past, self.present))

    def undone(self) -> "History":
        """Returns the history one step back; itself where there is none."""
        if not self.past:
            return self
        return History(self.past[-1], self.past[:-1], (self.present, *self.future))

    def redone(self) -> "History":
        """Returns the history one step on again; itself where nothing was undone."""
        if not self.future:
            return self
        return History(self.future[0], (*self.past, self.present), self.future[1:])

    def back_to(self, settings: Settings) -> "History":
        """Returns the history in which these settings hold again; nothing is left that was to come after them."""
        if settings not in self.past:
            return History(settings, self.past)
        last = max(k for k, before in enumerate(self.past) if before == settings)
        return History(settings, self.past[:last])
