"""Where a term is missing, and what it looks like: probes in the slots of a model, or at its inputs and outputs."""
