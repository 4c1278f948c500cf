within HydraulicTestBench.Crane;
model Payload "Submerged mass with weight, buoyancy and drag"
  extends Icons.Component;
  parameter Types.Mass m_PL(min=1e-6) "Mass";
  parameter Types.Volume V_PL(min=0) "Submerged volume";
  parameter Types.Area A_PL(min=0) "Area seen from above";
  parameter Real C_d(final unit="1", min=0) "Drag coefficient";
  parameter Types.Density rho_s "Density of the water";
  parameter Types.Acceleration g "Gravity";
  parameter Types.Length z_start = 0 "Height at the start";
  Interfaces.TranslationFlange_a flange "Where the wire pulls"
    annotation(Placement(transformation(extent={{-10, 90}, {10, 110}})));
  Types.Length z_PL(start=z_start, fixed=true, stateSelect=StateSelect.always) "Height";
  Types.Velocity v_PL(start=0, fixed=true, stateSelect=StateSelect.always) "Velocity, upwards";
  Types.Force F_buoy "Buoyancy, Eq. 5.46";
  Types.Force F_drag "Drag, against the motion, Eq. 5.45";
equation
  flange.s = z_PL;
  der(z_PL) = v_PL;
  m_PL*der(v_PL) = flange.f + F_buoy - m_PL*g - F_drag;
  F_buoy = rho_s*g*V_PL;
  F_drag = 0.5*rho_s*C_d*A_PL*v_PL*abs(v_PL);
  annotation(Documentation(info="<html>
<p>m dv/dt = F<sub>L</sub> + &rho;gV - m g - &frac12;&rho;C<sub>d</sub>A v|v|.</p>
<p><b>Source:</b> thesis Eq. 5.44 to 5.46. As printed, Eq. 5.44 lacks the weight of the payload, and Eq. 5.45 squares
the
velocity without its sign, so that its drag would push a payload that rises and hold one that sinks, or the other way
round.</p>
<p><b>Valid:</b> fully submerged, also with the wire slack.</p>
<p><b>Leaves out:</b> added mass, currents, the sea floor.</p>
</html>"));
end Payload;
