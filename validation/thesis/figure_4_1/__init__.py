"""Figure 4.1: steady flow over the command."""
