"""A plan for the oscillator x'' = u - 2 D w x' - w^2 x, and the file that says the same."""

PLAN = """
[plan]
name = "oscillator"
description = "all kinds of tests"
system = "mass"

[signals.force]
role = "input"
unit = "kN"
variable = "u"

[signals.position]
role = "output"
unit = "mm"
variable = "x"
noise = 2.0
resolution = 0.5
low = -1500
high = 1800

[signals.v]
role = "output"
unit = "m"
rate = 25

[logging]
rates = [[1, 250.0], [4, 70.0]]

[inputs]
u_rate = 3.0

[lead]
rest = 0.25
ramp = 0.0
hold = 0.25
ramp_down = 0.0

[[tests]]
kind = "step"
outputs = ["position", "v"]
offset = 0
height = 0.004
length = 4

[[tests]]
kind = "frequency-response"
outputs = ["position"]
points = [[0.001, 0.0005], [-0.002, 0.001]]
frequencies = [0.5, 2]
periods = 2
least = 0.5
most = 3
lead = { ramp = 0.5 }

[[tests]]
kind = "chirp"
outputs = ["position"]
offset = 0
amplitude = 0.001
start_hz = 0.1
stop_hz = 5
sweep = 3
use = "validate"

[[tests]]
kind = "stochastic"
outputs = ["position"]
significant_height = 0.002
peak_period = 0.7
length = 3
seed = 4

[[tests]]
kind = "multisine"
outputs = ["v"]
rms = 0.001
period = 2
low_hz = 0.5
high_hz = 8
lines = "odd"
seed = 2
periods = 1
realisations = 2
folder = "multi"
"""
