"""The thesis' test bench as a co-simulation: the rig's FMU, its controllers in Python, a crane; steps and heave."""

from pysim.rig.heave_test import HeaveFigures, HeaveTest, heave_figures
from pysim.rig.rig_member import rig_member
from pysim.rig.rig_system import OUTPUTS, load_controllers, rig_system
from pysim.rig.standstill import standstills
from pysim.rig.step_test import StepFigures, StepTest, step_figures

__all__ = [
    "OUTPUTS",
    "HeaveFigures",
    "HeaveTest",
    "StepFigures",
    "StepTest",
    "heave_figures",
    "load_controllers",
    "rig_member",
    "rig_system",
    "standstills",
    "step_figures",
]
