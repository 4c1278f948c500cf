"""Table 4.4: transfer functions against the responses they were fitted to."""
