"""Figure 2.1: the command of a stepped-sine test."""
