within HydraulicTestBench.Data;
record PumpGeometry "Displacement, pistons and port plate of the A4VSG 71 pump, thesis Section 3.4.4"
  extends Icons.Record;
  Types.Volume V_d_max = 71e-6 "Displacement per revolution at the largest angle";
  Integer N_p = 9 "Number of pistons";
  Types.Length D_p = 20.5e-3 "Diameter of a piston";
  Types.Angle phi_0 = 85*Constants.pi/180 "Angle between the pistons' axes and the plane they turn in";
  Types.Angle gamma = 20*Constants.pi/180 "Pressure carry over angle";
  Types.Length R = 33.1e-3 "Radius of the port plate";
  Real eta_r(unit="1") = 0.01979 "Depth of the ripple's spikes over the mean flow";
  Real psi(unit="1") = 0.8634 "Amplitude of the simplified ripple over the depth of the spikes";
  annotation(Documentation(info="<html>
<p>The thesis' numbers but for the last two, which follow from the others by Eq. 3.23 to 3.62: the flow's spikes reach
2.0374 l/min below the mean of 102.95 l/min, its smooth tops 0.6392 l/min above it, and &psi; = 0.6392/(2.0374 (1 -
2/&pi;)) = 0.8634.</p>
<p><b>Source:</b> thesis Section 3.4.4, Table 1. Eq. 3.63 prints 0.8638; its printed factors give 0.8629. Eq. 3.52
prints 2.063 l/min, which the given geometry does not have and Eq. 3.63 does not use (0.0198 there is 2.038 l/min). By
the words of Eq. 3.51 &eta;<sub>r</sub> is the largest ripple above the mean; the numbers are those of the largest below
it.</p>
<p><b>Leaves out:</b> that &eta;<sub>r</sub> changes with the number of pistons (Fig. 3.10): set both together.</p>
</html>"));
end PumpGeometry;
