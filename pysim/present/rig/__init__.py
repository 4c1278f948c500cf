"""Tests of the rig under its controllers, shown: `steps` and `heave`, a file each."""
