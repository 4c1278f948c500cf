"""Reconstruction of a bench's command from the column in which it was logged."""

from pysim.identify.logged.command import logged_command
from pysim.identify.logged.wave import LoggedWave, logged_wave

__all__ = ["LoggedWave", "logged_command", "logged_wave"]
