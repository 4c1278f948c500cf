"""What the thesis printed, redone with one folder per table and figure; its numbers are in pysim.thesis."""
