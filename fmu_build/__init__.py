"""Modelica to FMU."""
