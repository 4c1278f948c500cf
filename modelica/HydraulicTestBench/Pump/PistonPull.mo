within HydraulicTestBench.Pump;
model PistonPull "Mean pull of the pistons on the swash plate, from the pressures at the ports"
  extends Interfaces.PartialPistonForce;
  constant Data.PumpGeometry known = Data.PumpGeometry() "Known geometry";
  parameter Real share(final unit="1", min=0, max=1) = 1 "Share of the pull that reaches the control piston, 0 = off";
  parameter Types.Length a(min=1e-3) "Distance of the piston rod from the swash plate's axis";
  parameter Types.Volume V_d_max(min=1e-9) = known.V_d_max "Displacement per revolution at the largest angle";
  parameter Types.Angle alphaMAX(min=0.01) "Largest swash plate angle";
  parameter Types.Angle phi_0 = known.phi_0 "Angle between the pistons' axes and the plane they turn in";
  parameter Types.Angle delta = known.gamma - known.D_p/(2*known.R)
    "Angle behind the dead centre where a chamber changes its port";
  final parameter Types.Angle phi_O = alphaMAX*cos(delta) "Largest angle of a piston while its chamber changes ports";
  final parameter Types.Volume V_alpha =
    V_d_max/sin(phi_0)/(sin(phi_O)/sin(phi_0 - phi_O) + sin(phi_O)/sin(phi_0 + phi_O))
    "Volume of all chambers over the angle: N_p A r_0/sin(phi_0), r_0 of Eq. 3.34";
  Interfaces.RealInput alpha(unit="rad") "Swash plate angle"
    annotation(Placement(transformation(extent={{-140, -20}, {-100, 20}})));
  Interfaces.RealInput p_A(unit="Pa") "Pressure at port A"
    annotation(Placement(transformation(extent={{-20, 20}, {20, -20}}, rotation=90, origin={-50, -120})));
  Interfaces.RealInput p_B(unit="Pa") "Pressure at port B"
    annotation(Placement(transformation(extent={{-20, 20}, {20, -20}}, rotation=90, origin={50, -120})));
  Types.Torque T "Torque on the swash plate towards larger angles, mean over a revolution";
equation
  T = V_alpha*((p_A + p_B)/2*alpha*cos(phi_0)/sin(phi_0) - (p_A - p_B)*sin(delta)/Constants.pi);
  f = share*T*cos(alpha)^2/a;
  annotation(Documentation(info="<html>
<p>Each chamber pushes the swash plate with its pressure: T = A &Sigma; p<sub>n</sub> dx<sub>n</sub>/d&alpha;, by the
work that the oil does when the plate tilts. Over a revolution two parts are left. The chambers change their port
&delta; behind the dead centre, so that the pressure difference pulls the plate back. The pistons' axes lie on a cone,
so that the mean pressure pulls it out. The two nearly cancel in the A4VSG under the thesis' load.</p>
<p><b>Source:</b> thesis Eq. 3.25, 3.29 and 3.37 to 3.44 for positions and ports, Section 3.4.4 for the numbers; the
virtual work and its mean, to first order in &alpha;, are this library's. Eq. 3.11 takes the torque to the piston.</p>
<p><b>Valid:</b> angles to 15 degrees; there within 7 percent of the mean over the whole kinematics.</p>
<p><b>Leaves out:</b> the sawtooth of 18 strokes per revolution, compression of the oil between the ports, inertia of
the pistons.</p>
</html>"));
end PistonPull;
