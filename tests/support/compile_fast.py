"""Options of programs that XLA makes for one call: the equations are tested, not how fast they are."""

#: LLVM leaves the code as it is; in programs of thousands of operations this halves the time to make them.
#: Only for programs that run for less than they take to compile.
ONE_CALL = {"xla_backend_optimization_level": 0}
