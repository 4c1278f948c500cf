"""Learned laws, which no catalogue has: curves at a model's slots, fitted to measurements, as classes and formulas."""
