"""Simulate FMUs fast, compare them with a test bench, and find the physical effect they lack."""
