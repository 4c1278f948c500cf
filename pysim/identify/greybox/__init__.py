"""Grey-box fitting: the parameters of a model from measurements, with their doubt (thesis Sections 2.6 and 4.4)."""

from pysim.identify.greybox.command import Rest
from pysim.identify.greybox.fit import Effort, fit
from pysim.identify.greybox.gauss_newton import GaussNewton
from pysim.identify.greybox.interior_point import InteriorPoint
from pysim.identify.greybox.objective import COMBINED, FREQUENCY, NOISE, OBJECTIVES, TIME, Objective
from pysim.identify.greybox.parameters import Parameter, Tie
from pysim.identify.greybox.problem import Problem, problem
from pysim.identify.greybox.profile import Profile, profile
from pysim.identify.greybox.search import Tried
from pysim.identify.greybox.simulation import Simulation
from pysim.identify.greybox.sine_log import SinePlan
from pysim.identify.greybox.treatment import Measurements, Treatment
from pysim.identify.greybox.workers import Cluster, Processes, Threads

__all__ = [
    "COMBINED",
    "FREQUENCY",
    "NOISE",
    "OBJECTIVES",
    "TIME",
    "Cluster",
    "Effort",
    "GaussNewton",
    "InteriorPoint",
    "Measurements",
    "Objective",
    "Parameter",
    "Problem",
    "Processes",
    "Profile",
    "Rest",
    "Simulation",
    "SinePlan",
    "Threads",
    "Tie",
    "Treatment",
    "Tried",
    "fit",
    "problem",
    "profile",
]
