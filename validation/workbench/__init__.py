"""The picture of the workbench that leads the README."""
