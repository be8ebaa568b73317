"""The names of array shapes: those of jaxtyping where a program has imported it before, as the tests do.

Elsewhere nothing checks them, and jaxtyping, with a third of all modules of the standard library behind it, is not
imported: there `Float[np.ndarray, "n 3"]` is `np.ndarray`.
"""

import sys
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING or "jaxtyping" in sys.modules:
    from jaxtyping import Bool as Bool
    from jaxtyping import Float as Float
    from jaxtyping import Float32 as Float32
    from jaxtyping import Float64 as Float64
    from jaxtyping import Int as Int
    from jaxtyping import Int32 as Int32
    from jaxtyping import Int64 as Int64
    from jaxtyping import Integer as Integer
    from jaxtyping import UInt8 as UInt8
    from jaxtyping import UInt16 as UInt16
    from jaxtyping import UInt32 as UInt32
else:

    class _AnyShape:
        """What stands for a name of jaxtyping: with a class and a shape in brackets it is that class."""

        def __getitem__(self, stated: tuple[Any, str]) -> Any:
            return stated[0]

    Bool = Float = Float32 = Float64 = Int = Int32 = Int64 = Integer = UInt8 = UInt16 = UInt32 = _AnyShape()
