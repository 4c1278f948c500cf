"""The tests that are too slow for every change."""
