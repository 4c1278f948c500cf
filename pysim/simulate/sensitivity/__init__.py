"""What parameters do to a run and to a periodic steady state."""
