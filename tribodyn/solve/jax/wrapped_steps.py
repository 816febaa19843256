"""What step-size controllers of diffrax that wrap another one have in common."""

from typing import Any

import diffrax

#: Untyped, as diffrax declares tolerances as variables where wrappers have properties.
_Controller: Any = diffrax.AbstractAdaptiveStepSizeController


class WrappedSteps(_Controller):
    """A controller around another one, whose tolerances are its own."""

    controller: diffrax.AbstractAdaptiveStepSizeController

    @property
    def rtol(self) -> Any:  # noqa: D102  (diffrax's)
        return self.controller.rtol

    @property
    def atol(self) -> Any:  # noqa: D102  (diffrax's)
        return self.controller.atol

    @property
    def norm(self) -> Any:  # noqa: D102  (diffrax's)
        return self.controller.norm
