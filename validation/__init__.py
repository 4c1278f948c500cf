"""Published and independent results, and what redoes them: `python3 run.py validate --list`."""
