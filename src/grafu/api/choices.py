"""Choices of a caller's words: which hardware a joint has."""

from grafu.api.request import optional_number, require, require_word
from grafu.errors import OptionError
from grafu.joints.plan import JointChoice
from grafu.vocabulary import MECHANISM_MENU, MechanismClass


def joint_choice(**fields: object) -> JointChoice:
    """Returns the choice with these fields.

    Raises:
        TypeError: if one has a wrong type.
        OptionError: if one is out of range.
    """
    require_word(fields["template"], "template", "the id of a template, as str")
    require_word(fields["mount"], "mount")
    require(fields.get("count", 0), int, "count", "a whole number")
    optional_number(fields.get("scale"), "scale")
    try:
        return JointChoice(**fields)  # type: ignore[arg-type]  # it checks them itself
    except ValueError as error:
        raise OptionError(str(error).replace("`JointChoice.", "`")) from None


def mechanism_class(name: str | None) -> MechanismClass | None:
    """Returns a class of hinges or rails by its name; None: any.

    Raises:
        TypeError: if `name` is no str.
        OptionError: if there is no such class.
    """
    if name is None or not require_word(name, "mechanism", "a class such as `contact`, or None"):
        return None
    named = {word: mechanism for mechanism in MECHANISM_MENU for word in (mechanism.in_words, mechanism.value)}
    if name not in named:
        known = ", ".join(mechanism.in_words for mechanism in MECHANISM_MENU)
        raise OptionError(f"`mechanism` must be one of {known}: got {name!r}")
    return named[name]
