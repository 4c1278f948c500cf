"""Grey-box fitting: the parameters of a model from measurements, with their intervals (thesis Sections 2.6 and 4.4)."""

from pysim.identify.greybox.fit import Effort, fit, fit_at
from pysim.identify.greybox.interior_point import InteriorPoint
from pysim.identify.greybox.least_squares import GaussNewton
from pysim.identify.greybox.nuisance import Nuisance, NuisanceKind
from pysim.identify.greybox.objective import COMBINED, FREQUENCY, NOISE, OBJECTIVES, TIME, Objective
from pysim.identify.greybox.observation import Measure, Observation
from pysim.identify.greybox.parameters import Parameter, Tie
from pysim.identify.greybox.problem import Problem, of_outputs, problem
from pysim.identify.greybox.profile import Profile, profile
from pysim.identify.greybox.residuals import Point, WeightedResiduals
from pysim.identify.greybox.runs import Simulation
from pysim.identify.greybox.search import Tried
from pysim.identify.greybox.settings import FitSettings, NoiseSettings
from pysim.identify.greybox.treatment import Measurements, Rest, SinePlan, Treatment
from pysim.identify.greybox.trust import fit_warnings, step_warnings
from pysim.identify.greybox.workers import Cluster, Processes, Threads, helper_processes

__all__ = [
    "COMBINED",
    "FREQUENCY",
    "NOISE",
    "OBJECTIVES",
    "TIME",
    "Cluster",
    "Effort",
    "FitSettings",
    "GaussNewton",
    "InteriorPoint",
    "Measure",
    "Measurements",
    "NoiseSettings",
    "Nuisance",
    "NuisanceKind",
    "Objective",
    "Observation",
    "Parameter",
    "Point",
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
    "WeightedResiduals",
    "fit",
    "fit_at",
    "fit_warnings",
    "helper_processes",
    "of_outputs",
    "problem",
    "profile",
    "step_warnings",
]
