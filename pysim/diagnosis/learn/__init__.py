"""Laws that no catalogue has, learned from measurements: curves in a model's slots, their classes and formulas."""
