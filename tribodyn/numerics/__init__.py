"""Elementary functions, fixed iterations, registries: what everything else rests on."""
