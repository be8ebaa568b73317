"""Every exception that grafu raises, named by whose fault it is.

    FunctionalizationError
      AssetError              the input is at fault
        UnreadableAsset         missing, damaged, or not a kind of file that is read
        UnsegmentedAsset        one piece where several parts were expected
        AssetTooLarge           more parts, faces or bytes than the limits allow
        UnknownLabel            a label outside the vocabulary, where unknown is not allowed
      GraphError              a functional graph breaks an invariant
      ArticulationError       an articulated object is not a tree, or a limit is upside down
      TemplateError           a mechanism template is at fault
      WeightsError            the network's trained weights are missing or do not fit
      OptionError             options contradict each other, or ask for what there is not
      ExportError             a format cannot say this, or the output cannot be written
      TooComplex              it takes more time or room than its budget holds
      ReplyError              what a language model replied cannot be used
      NotRun                  a method of an evaluation needs what is not there: an endpoint, an installed program

A part that cannot be realized is not an exception: it is an outcome with a reason (`grafu.joints.report`).
Messages are one line: what was given, what was expected, how to fix it.
"""

from collections.abc import Iterable

_LONGEST = 2000  # characters of a message


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """Returns `; did you mean X?` with the known word that looks most like the given one; empty where none does."""
    near = nearest(word, known)
    return f"; did you mean `{near}`?" if near else ""


def nearest(word: str, known: Iterable[str]) -> str:
    """Returns the known word that looks most like the given one, whatever its case; empty where none does."""
    from difflib import get_close_matches  # late: only where something is wrong

    by_case = {one.casefold(): one for one in known}
    near = get_close_matches(word[:100].casefold(), by_case, 1)
    return by_case[near[0]] if near else ""


class FunctionalizationError(Exception):
    """Base of all errors that grafu raises on purpose; the middle of a very long message is cut out."""

    def __str__(self) -> str:
        text = super().__str__()
        return text if len(text) <= _LONGEST else f"{text[: _LONGEST // 2]} ... {text[-_LONGEST // 2 :]}"


class AssetError(FunctionalizationError):
    """The input asset is at fault."""


class UnreadableAsset(AssetError):
    """The input is missing, damaged, or of a kind that is not read."""


class UnsegmentedAsset(AssetError):
    """The input holds one piece where several parts were expected."""


class AssetTooLarge(AssetError):
    """The input exceeds a stated limit on parts, faces or bytes."""


class UnknownLabel(AssetError):
    """A label is outside the vocabulary where `unknown` is not allowed."""


class GraphError(FunctionalizationError):
    """A functional graph breaks an invariant."""


class ArticulationError(FunctionalizationError):
    """An articulated object is not a tree, or its joints are ill-defined."""


class TemplateError(FunctionalizationError):
    """A mechanism template is damaged or incomplete."""


class WeightsError(FunctionalizationError):
    """The trained weights of the network are missing, damaged, or made for another network."""


class OptionError(FunctionalizationError):
    """Options contradict each other, or ask for something that there is not."""


class ExportError(FunctionalizationError):
    """A format cannot express the object, or the output cannot be written."""


class NotBuilt(FunctionalizationError):
    """The editor's process could not build what was asked for, or was stopped."""


class TooComplex(FunctionalizationError):
    """Work on a part, or on the whole, would take more time or memory than its budget allows."""


class ReplyError(FunctionalizationError):
    """What a language model replied is not in the form that was asked for, or names what there is not."""


class NotRun(FunctionalizationError):
    """A method of an evaluation needs an endpoint or an installed program that is not there."""
