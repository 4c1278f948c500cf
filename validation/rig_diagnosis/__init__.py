"""The thesis' test bench diagnosed: friction that its linear model lacks, an overlap, and nothing at all."""
