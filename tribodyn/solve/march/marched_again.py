"""Extremes of a motion that another library integrates: every mesh cycle is marched again natively."""

from tribodyn.dynamics.extremes import no_extremes, take_in
from tribodyn.dynamics.parameters import Model
from tribodyn.numerics.shapes import Array, Float
from tribodyn.solve.choice import choose
from tribodyn.solve.integrator import IntegratedCycles, Integrator
from tribodyn.solve.march.native_integrator import NativeIntegrator
from tribodyn.solve.methods import AUTO, method_file
from tribodyn.solve.tolerances import StepTolerances


class MarchedAgain:
    """Wraps an integrator: where extremes are sought, a native one follows it, see `integrator.Integrator`.

    As it starts every mesh cycle where the other did, it goes astray by no more than a cycle's error.

    Parameters
    ----------
    integrator : Integrator
    model : Model
    samples : int
        Samples per mesh cycle, at least 1.
    tolerances : StepTolerances
    """

    def __init__(self, integrator: Integrator, model: Model, samples: int, tolerances: StepTolerances):
        self.started = self.extremes = False
        self._integrator = integrator
        self._model, self._samples, self._tolerances = model, samples, tolerances
        self._native: NativeIntegrator | None = None

    def integrate(self, state: Float[Array, " state"], first_cycle: int, cycles: int) -> IntegratedCycles:
        """See `integrator.Integrator`; what the second integration costs is not counted."""
        self._integrator.started = self.started
        part = self._integrator.integrate(state, first_cycle, cycles)
        self.started = True
        if not self.extremes:
            return part
        native = self._native or self._follower(state)
        found = no_extremes()
        for cycle in range(len(part.samples) // self._samples):
            native.started = False
            again = native.integrate(part.samples[cycle * self._samples], first_cycle + cycle, 1)
            assert again.extremes is not None
            take_in(found, again.extremes)
        return part._replace(extremes=found)

    def _follower(self, state: Float[Array, " state"]) -> NativeIntegrator:
        file = method_file(choose(AUTO, self._model, state).method)
        self._native = NativeIntegrator(file, self._model, 0, self._tolerances)
        self._native.extremes = True
        return self._native
