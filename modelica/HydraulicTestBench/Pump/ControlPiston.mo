within HydraulicTestBench.Pump;
model ControlPiston "Control piston between its two chambers, with spring and end stops, thesis Eq. 3.9"
  extends Icons.Component;
  parameter Types.Area A_p "Piston area";
  parameter Types.Volume V_0 "Dead volume of each chamber";
  parameter Types.Mass m_eff "Effective mass";
  parameter Types.SpringConstant k "Spring constant";
  parameter Types.DampingConstant b "Damping";
  parameter Types.Length xpMAX "End stop at positive position";
  parameter Types.Length xpMIN "End stop at negative position";
  parameter Types.SpringConstant k_stop = 1e9 "Stiffness of the end stops";
  parameter Types.DampingConstant d_stop = 1e5 "Damping of the end stops";
  constant Types.Length d_soft = 5e-6 "Depth over which an end stop takes hold";
  Interfaces.Port_a port_1 "Displacement of chamber 1"
    annotation(Placement(transformation(extent={{-60, -110}, {-40, -90}})));
  Interfaces.Port_a port_2 "Displacement of chamber 2"
    annotation(Placement(transformation(extent={{40, -110}, {60, -90}})));
  Interfaces.RealInput f(unit="N") "Further force on the piston"
    annotation(Placement(transformation(extent={{-140, -20}, {-100, 20}})));
  Interfaces.RealOutput V_1(unit="m3") "Volume of chamber 1"
    annotation(Placement(transformation(extent={{100, 50}, {120, 70}})));
  Interfaces.RealOutput V_2(unit="m3") "Volume of chamber 2"
    annotation(Placement(transformation(extent={{100, -70}, {120, -50}})));
  Types.Length x(start=0, fixed=true, stateSelect=StateSelect.always) "Position, 0 in the middle of the stroke";
  Types.Velocity v(start=0, fixed=true, stateSelect=StateSelect.always) "Velocity";
  Types.Acceleration x_tt "Acceleration";
  Types.Force f_stop "Force of the end stops";
equation
  der(x) = v;
  der(v) = x_tt;
  m_eff*x_tt = (port_1.p - port_2.p)*A_p - k*x - b*v + f + f_stop;
  f_stop = Functions.endStopForce(xpMIN - x, -v, k_stop, d_stop, d_soft)
    - Functions.endStopForce(x - xpMAX, v, k_stop, d_stop, d_soft);
  V_1 = V_0 + A_p*x;
  V_2 = V_0 - A_p*x;
  port_1.q = A_p*v;
  port_2.q = -A_p*v;
  annotation(Documentation(info="<html>
<p>Newton's law for the piston with all that moves with it, and the oil it displaces. Chamber 1 grows with positive
x.</p>
<p><b>Source:</b> thesis Eq. 3.9; A<sub>p</sub> dx/dt and V<sub>0</sub> &plusmn; A<sub>p</sub> x<sub>p</sub> of Eq. 3.4
and 3.5. The third row of Eq. 3.15 reads x<sub>4</sub>/m<sub>eff</sub>; it has to be dx<sub>3</sub>/dt = x<sub>4</sub>.
The end stops are this library's.</p>
<p><b>Valid:</b> positions between the stops. At rest at a stop, full supply pressure presses the piston some
hundredths of a
millimetre in; an impact at full speed reaches some tenths.</p>
<p><b>Leaves out:</b> friction, preload of the springs, forces of the pump pistons on the swash plate.</p>
</html>"));
end ControlPiston;
