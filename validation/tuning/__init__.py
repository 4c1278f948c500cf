"""The tuner of PI controllers on the plants of thesis Table 5.1."""
