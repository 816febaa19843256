"""Array types of signatures: the kind of number and the names of the axes.

``Float[Array, "segment node pair"]`` is an array of floats with three axes. Within one call an axis of the
same name has the same length everywhere; ``"..."`` stands for any axes, ``"*contact"`` for any number of axes
that have a name together, ``"3"`` for a fixed length, ``""`` for a scalar. A single name starts with a space,
``" pair"``, so that linters do not take it for a variable. `Array` may be of NumPy or of JAX (a tracer too);
where the axes allow a scalar, a plain number serves as well.

The static checker reads these as annotated `Any`. At run time they are stand-ins that cost nothing, unless
the environment variable ``TRIBODYN_CHECK_SHAPES`` is set before the first import: then they are jaxtyping's,
and `tests/support/shape_checks.py` compares every argument and result with them.
"""

import os
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from typing import Annotated as Bool
    from typing import Annotated as Complex
    from typing import Annotated as Float
    from typing import Annotated as Int

    Array = Any
elif os.environ.get("TRIBODYN_CHECK_SHAPES"):
    import jax
    import numpy as np
    from jaxtyping import Bool, Complex, Float, Int

    Array = np.ndarray | np.generic | jax.Array | bool | int | float | complex
else:
    import numpy as np

    class Float:
        """Stands for an array type wherever nobody checks: what `help` shows of it."""

        scalar = float

        def __class_getitem__(cls, item: tuple[object, str]) -> type:
            return cls.scalar if item[1] == "" else np.ndarray

    class Bool(Float):
        """Of booleans."""

        scalar = bool

    class Int(Float):
        """Of whole numbers."""

        scalar = int

    class Complex(Float):
        """Of complex numbers."""

        scalar = complex

    Array = Any

__all__ = ["Array", "Bool", "Complex", "Float", "Int"]
