"""Write the logs of a machine as a data set: `python -m validation.rig_diagnosis shaft.friction FOLDER`."""

import sys

from pysim.io import write_dataset
from validation.rig_diagnosis.case import SEED
from validation.rig_diagnosis.machines import MACHINES, measured

if len(sys.argv) != 3 or sys.argv[1] not in MACHINES:
    sys.exit(f"name a machine, {', '.join(MACHINES)}, and a new folder")
write_dataset(sys.argv[2], measured(sys.argv[1], SEED).dataset)
