"""What studies say of sweeps: batches, cases between cases, ends of branches."""
