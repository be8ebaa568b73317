"""Makes part-segmented 3D furniture work: hinges, rails, limits, physics.

    import grafu
    result = grafu.functionalize("samples/sideboard.glb")
    result.save("results/sideboard", formats=["glb", "urdf"])

Importing the package imports nothing else; each name below is imported when it is first used.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from grafu.collecting import without_collecting
from grafu.linear_algebra import sleeping_soon
from grafu.version import __version__ as __version__

if TYPE_CHECKING:
    from grafu.api.functions import functionalize as functionalize
    from grafu.api.functions import load as load
    from grafu.api.functions import piece_names as piece_names
    from grafu.api.result import Result as Result
    from grafu.asset.part import Asset as Asset
    from grafu.errors import FunctionalizationError as FunctionalizationError

_HOMES = {
    "load": "grafu.api.functions",
    "functionalize": "grafu.api.functions",
    "piece_names": "grafu.api.functions",
    "Result": "grafu.api.result",
    "Asset": "grafu.asset.part",
    "FunctionalizationError": "grafu.errors",
}
__all__ = ["Asset", "FunctionalizationError", "Result", "__version__", "functionalize", "load", "piece_names"]


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module 'grafu' has no attribute {name!r}: it offers {', '.join(__all__)}")
    with without_collecting(), sleeping_soon():
        found = globals()[name] = getattr(import_module(_HOMES[name]), name)
    return found


def __dir__() -> list[str]:
    """Returns what the package offers, for completion in a shell."""
    return sorted(__all__)
