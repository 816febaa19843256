"""Quantities of the computation itself: of an integration, and of a search."""

from tribodyn.quantities.quantity import Quantity

QUANTITIES = (
    Quantity("solver", "Method", definition="Method of integration, chosen or by solver.method."),
    Quantity("steps", "Steps", digits=",d", definition="Steps of the integration."),
    Quantity(
        "rhs_evaluations",
        "Right-hand sides",
        digits=",d",
        definition="Evaluations of the equations of motion.",
    ),
    Quantity(
        "wall_time",
        "Wall time",
        "s",
        ".3g",
        "Time that the computation took, without start and drawing.",
    ),
    Quantity("objective_name", "Objective", definition="Quantity, or sum of quantities, that was sought."),
    Quantity("objective", "Objective at the best", definition="In SI units of its own."),
    Quantity("objective_start", "Objective at the start", definition="In SI units of its own."),
    Quantity("method", "Method", definition="Method of the search, see method_reason in the summary."),
    Quantity("evaluations", "Evaluations", digits=",d", definition="Candidates that were evaluated."),
    Quantity(
        "evaluations_feasible",
        "Feasible evaluations",
        digits=",d",
        definition="Candidates that satisfy all constraints.",
        below="of these feasible",
    ),
    Quantity(
        "evaluations_without_figures",
        "Evaluations without quantities",
        digits=",d",
        definition="Candidates that cannot be made, or for which no state was found; `message` says why.",
        below="of these without quantities",
    ),
)
