"""Proof that nothing moved: two versions of the package run the same cases, and every number is compared."""
