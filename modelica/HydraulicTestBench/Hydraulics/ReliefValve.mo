within HydraulicTestBench.Hydraulics;
model ReliefValve "Pressure relief valve whose poppet has mass, spring and damping"
  extends Icons.Component;
  extends Interfaces.PartialTwoPort;
  parameter Types.Pressure p_set "Difference at which it begins to open";
  parameter Types.Pressure dp_open(min=1) "Further difference that holds it fully open";
  parameter Types.Area K_max(min=0) "Opening area when fully open, discharge coefficient included";
  parameter Types.Density rho "Density of oil";
  parameter Types.Duration T_open(min=1e-5) "Undamped opening time: period of the free poppet without damping";
  parameter Types.DampingRatio zeta(min=0) "Damping ratio of the poppet";
  parameter Types.Length x_max(min=1e-5) = 1e-3 "Lift when fully open";
  parameter Types.Mass m(min=1e-4) = 0.02 "Mass of the poppet, for its stops alone";
  parameter Types.SpringConstant k_stop = 1e8 "Stiffness of seat and upper stop";
  parameter Types.DampingConstant d_stop = 1000 "Damping of seat and upper stop";
  parameter Types.Pressure dp_smooth(min=1) = 1e4 "Width of the orifice law around zero pressure difference";
  constant Types.Length d_soft = 1e-6 "Depth over which a stop takes hold";
  final parameter Types.AngularVelocity omega_n = 2*Constants.pi/T_open "Natural frequency of the poppet";
  Types.Length x(start=0, fixed=true, stateSelect=StateSelect.always) "Lift";
  Types.Velocity v(start=0, fixed=true, stateSelect=StateSelect.always) "Velocity";
  Types.Length x_ref "Lift at rest under this pressure difference, were there no stops";
  Types.Force f_stop "Force of seat and upper stop";
  Real opening(unit="1") "Share of the full opening";
equation
  x_ref = x_max*(dp - p_set)/dp_open;
  f_stop = Functions.endStopForce(-x, -v, k_stop, d_stop, d_soft)
    - Functions.endStopForce(x - x_max, v, k_stop, d_stop, d_soft);
  der(x) = v;
  der(v) = omega_n^2*(x_ref - x) - 2*zeta*omega_n*v + f_stop/m;
  opening = min(max(x/x_max, 0), 1);
  q = Functions.orificeFlow(dp, opening*K_max, rho, dp_smooth);
  annotation(Documentation(info="<html>
<p>The poppet seeks the lift that its spring gives at the pressure difference, as an oscillator of period
T<sub>open</sub>, between its seat and its upper stop; the area follows the lift. <code>opening</code> is what thesis
Fig. 4.11 shows in percent.</p>
<p><b>Source:</b> thesis Section 4.5 for the undamped opening time; Eq. 3.6 for the flow. The thesis
publishes neither damping nor area of the valve it used.</p>
<p><b>Valid:</b> any pressure difference. Pressed on its seat the poppet goes some micrometres beyond x = 0, where the
area is exactly zero.</p>
<p><b>Leaves out:</b> flow forces, a pilot stage, cavitation.</p>
</html>"));
end ReliefValve;
