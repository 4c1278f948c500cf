"""Friction of a simulated shaft, found again from ten pulses per revolution."""
