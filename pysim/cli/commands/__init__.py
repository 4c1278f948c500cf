"""The commands, a file each: `COMMAND` and the function that it runs. `pysim/cli/command.py` says how."""
