"""What a user of Python holds and does: six nouns, which are values that never change, and their verbs.

`pysim` itself shows the verbs. A noun prints in a few lines, gives tables, draws itself with `plot()`, and is a thin
face of what `pysim.workflow` opens and `pysim.present` shows.
"""
