"""Checks of shapes and types in every function and dataclass of the package, at a fraction of their usual cost.

jaxtyping's import hook writes `@jaxtyping.jaxtyped(typechecker=...)` above each of them. Its decorator binds arguments
by `inspect` at every call and has them checked twice. Here the type checker wraps the function itself, and only a
signature that names axes gets a context of its own, where one name is one size. What is refused is the same.
"""

import inspect
from collections.abc import Callable, Iterator
from dataclasses import is_dataclass
from functools import partial, wraps
from typing import Any, get_args, get_type_hints

import jaxtyping
from beartype import BeartypeConf, beartype

typed = beartype(conf=BeartypeConf(violation_type=jaxtyping.TypeCheckError))
usual = jaxtyping.jaxtyped
_own_names = usual("context")
_OWN = "_names_its_own_axes"


def use_in_import_hook() -> None:
    """Lets jaxtyping's import hook decorate with `checked`: for modules that are imported from now on."""
    jaxtyping.jaxtyped = checked


def checked(target: Any = None, *, typechecker: Callable[[Any], Any]) -> Any:
    """Returns a function or dataclass whose arguments and results are checked, called like `jaxtyping.jaxtyped`."""
    if target is None:
        return partial(checked, typechecker=typechecker)
    if inspect.isclass(target):
        if is_dataclass(target):
            target.__init__ = checked(target.__init__, typechecker=typechecker)
        return target
    if not inspect.isfunction(target) or inspect.isgeneratorfunction(target):
        return usual(target, typechecker=typechecker)  # a generator runs after its call, and its context, ended
    return target if hasattr(target, _OWN) else _checked_function(target, typechecker)


def _checked_function(function: Callable[..., Any], typechecker: Callable[[Any], Any]) -> Callable[..., Any]:
    stated = function.__annotations__
    hints = {name: _resolved(hint, function.__globals__) for name, hint in stated.items()}
    function.__annotations__ = hints
    inner = typechecker(function)
    function.__annotations__ = stated
    return _in_own_names(inner) if any(map(_names_axes, hints.values())) else inner


def _resolved(hint: Any, names: dict[str, Any]) -> Any:
    """Returns the type that a hint in quotes means; where it cannot be said yet, or at all, anything passes."""

    def one(value: hint) -> None: ...

    try:
        return get_type_hints(one, names, include_extras=True)["value"]
    except Exception:  # as jaxtyping does: a hint for readers may name what only type checkers know
        return Any


def _in_own_names(function: Callable[..., Any]) -> Callable[..., Any]:
    @wraps(function)
    def in_own_names(*args: Any, **kwargs: Any) -> Any:
        __tracebackhide__ = True
        with _own_names:
            return function(*args, **kwargs)

    setattr(in_own_names, _OWN, True)
    return in_own_names


def _names_axes(hint: Any) -> bool:
    dims = [one.dim_str for one in _within(hint) if isinstance(one, type(jaxtyping.AbstractArray))]
    return any(not (axis.isdigit() or axis in ("_", "...")) for dim in dims for axis in dim.split())


def _within(hint: Any) -> Iterator[Any]:
    yield hint
    for part in hint if isinstance(hint, list) else get_args(hint):
        yield from _within(part)
