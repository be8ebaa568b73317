"""Checks of shapes and types in every function and dataclass of the package, at a fraction of their usual cost.

jaxtyping's import hook writes `@jaxtyping.jaxtyped(typechecker=...)` above each of them. Its decorator binds arguments
by `inspect` at every call and has them checked twice. Here the type checker wraps the function itself, and only a
signature that names axes more than once gets a context of its own, where one name is one size. Whether an array fits
a hint without names is asked once for all arrays of its shape and kind of number. What is refused is the same. What is
called thousands of times is checked in its first calls and then now and then. A function within another is a new one
at each of the other's calls, and to prepare the checks of one takes a millisecond: of those, too, the first are checked
and then one now and then.
"""

import inspect
import re
from collections import Counter, defaultdict
from collections.abc import Callable, Iterator
from dataclasses import is_dataclass
from functools import cache, partial, wraps
from itertools import count
from types import CodeType
from typing import Any, get_args, get_type_hints

import jaxtyping
import numpy as np
from beartype import BeartypeConf, beartype

typed = beartype(conf=BeartypeConf(violation_type=jaxtyping.TypeCheckError))
usual = jaxtyping.jaxtyped
_own_names = usual("context")
_OWN = "_names_its_own_axes"
FIRST, EVERY = 1000, 31
FIRST_MADE = 50
_Hint = type(jaxtyping.AbstractArray)
fits_as_usual = _Hint.__instancecheck__
_answers: dict[tuple[Any, ...], bool] = {}
_made: defaultdict[CodeType, count] = defaultdict(count)  # how many functions were made of each code


def use_in_import_hook() -> None:
    """Lets jaxtyping's import hook decorate with `checked`: for modules that are imported from now on."""
    jaxtyping.jaxtyped = checked
    _Hint.__instancecheck__ = fits


def fits(hint: Any, value: object) -> bool:
    """Whether a value is an array as the hint states; what is known of an equal shape and kind is not asked again."""
    if type(value) is not np.ndarray or _has_names(hint):
        return fits_as_usual(hint, value)
    asked = hint, value.shape, value.dtype
    if asked not in _answers:
        _answers[asked] = fits_as_usual(hint, value)
    return _answers[asked]


@cache
def _has_names(hint: Any) -> bool:
    return any(not (axis.isdigit() or axis in ("_", "...")) for axis in hint.dim_str.split())


def checked(target: Any = None, *, typechecker: Callable[[Any], Any]) -> Any:
    """Returns a function or dataclass whose arguments and results are checked, called like `jaxtyping.jaxtyped`."""
    if target is None:
        return partial(checked, typechecker=typechecker)
    if inspect.isclass(target):
        if is_dataclass(target):
            from grafu.dataclass import compiled_init  # the hook that imports it needs this module first

            target.__init__ = checked(compiled_init(target), typechecker=typechecker)
        return target
    if not inspect.isfunction(target) or inspect.isgeneratorfunction(target):
        return usual(target, typechecker=typechecker)  # a generator runs after its call, and its context, ended
    return target if hasattr(target, _OWN) or _was_made_often(target) else _checked_function(target, typechecker)


def _was_made_often(function: Callable[..., Any]) -> bool:
    """Whether a function within another was made `FIRST_MADE` times before, but for one of `EVERY`."""
    if "<locals>" not in function.__qualname__:
        return False
    number = next(_made[function.__code__])
    return number >= FIRST_MADE and number % EVERY != 0


def _checked_function(function: Callable[..., Any], typechecker: Callable[[Any], Any]) -> Callable[..., Any]:
    """Returns the function with checks that are made at its first call: a process calls few of all functions."""

    @cache
    def made() -> Callable[..., Any]:
        return _with_checks(function, typechecker)

    return _sampled(function, made)


def _with_checks(function: Callable[..., Any], typechecker: Callable[[Any], Any]) -> Callable[..., Any]:
    stated = function.__annotations__
    resolved = {name: _resolved(hint, function.__globals__) for name, hint in stated.items()}
    function.__annotations__ = hints = _without_lone_names(resolved, function)
    inner = typechecker(function)
    function.__annotations__ = stated
    return _in_own_names(inner) if any(map(_names_axes, hints.values())) else inner


def _sampled(function: Callable[..., Any], checked_one: Callable[[], Callable[..., Any]]) -> Callable[..., Any]:
    """Returns a function of which the first `FIRST` calls of a process are checked, then one of `EVERY`."""
    calls = count()

    @wraps(function)
    def sampled(*args: Any, **kwargs: Any) -> Any:
        __tracebackhide__ = True
        call = next(calls)
        return (function if call >= FIRST and call % EVERY else checked_one())(*args, **kwargs)

    setattr(sampled, _OWN, True)
    return sampled


def _resolved(hint: Any, names: dict[str, Any]) -> Any:
    """Returns the type that a hint in quotes means; where it cannot be said yet, or at all, anything passes."""

    def one(value: hint) -> None: ...

    try:
        return get_type_hints(one, names, include_extras=True)["value"]
    except Exception:  # as jaxtyping does: a hint for readers may name what only type checkers know
        return Any


def _without_lone_names(hints: dict[str, Any], function: Callable[..., Any]) -> dict[str, Any]:
    """Returns the hints where an axis may be of any size that is named once in all of them, and there for one array."""
    arrays = [one for hint in hints.values() for one in _within(hint) if isinstance(one, _Hint)]
    named = Counter(name for one in arrays for name in re.findall(r"\w+", one.dim_str))
    parameters = inspect.signature(function).parameters.values()
    several = {p.name for p in parameters if p.kind in (p.VAR_POSITIONAL, p.VAR_KEYWORD)}

    def lone(hint: Any) -> Any:
        axes = ["_" if axis.isidentifier() and named[axis] == 1 else axis for axis in hint.dim_str.split()]
        return hint.dtype[hint.array_type, " ".join(axes)]

    return {name: lone(h) if isinstance(h, _Hint) and name not in several else h for name, h in hints.items()}


def _in_own_names(function: Callable[..., Any]) -> Callable[..., Any]:
    @wraps(function)
    def in_own_names(*args: Any, **kwargs: Any) -> Any:
        __tracebackhide__ = True
        with _own_names:
            return function(*args, **kwargs)

    setattr(in_own_names, _OWN, True)
    return in_own_names


def _names_axes(hint: Any) -> bool:
    return any(_has_names(one) for one in _within(hint) if isinstance(one, _Hint))


def _within(hint: Any) -> Iterator[Any]:
    yield hint
    for part in hint if isinstance(hint, list) else get_args(hint):
        yield from _within(part)
